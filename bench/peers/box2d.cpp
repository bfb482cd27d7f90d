#include "bench/peers/peers.h"

#include <box2d/box2d.h>

/// Box2D 2.4 (Catto): bodies and distance joints, in the xy plane.
namespace sinew::bench {
namespace {

class Box2D final : public Simulation {
  public:
    Box2D(const Work& work, const Effort& effort) : effort_(effort), world_({work.gravity[0], work.gravity[1]}) {
        world_.SetAllowSleeping(false);
        for (std::size_t i = 0; i < work.positions.size(); ++i) {
            const bool moves = work.inverse_masses[i] > 0;
            b2BodyDef def;
            def.type = moves ? b2_dynamicBody : b2_staticBody;
            def.position.Set(work.positions[i][0], work.positions[i][1]);
            def.linearVelocity.Set(work.velocities[i][0], work.velocities[i][1]);
            bodies_.push_back(world_.CreateBody(&def));
            if (!moves) continue;
            b2MassData mass; // a point: no inertia
            mass.mass = 1 / work.inverse_masses[i];
            mass.center.SetZero();
            mass.I = 0;
            bodies_.back()->SetMassData(&mass);
        }
        for (const auto& stick : work.sticks) tie(stick.a, stick.b, float(stick.rest), float(stick.rest));
        for (const auto& strut : work.struts) tie(strut.a, strut.b, float(strut.min), b2_maxFloat);
    }

    void step() override {
        for (int i = 0; i < effort_.substeps; ++i)
            world_.Step(float(frame / effort_.substeps), effort_.iterations, effort_.iterations);
    }
    Found position(std::size_t particle) const override {
        const auto& at = bodies_[particle]->GetPosition();
        return {{at.x, at.y, 0}};
    }

  private:
    Effort effort_;
    b2World world_;
    std::vector<b2Body*> bodies_;

    void tie(std::uint32_t a, std::uint32_t b, float min, float max) {
        b2DistanceJointDef def;
        def.bodyA = bodies_[a];
        def.bodyB = bodies_[b];
        def.collideConnected = true;
        def.length = min;
        def.minLength = min;
        def.maxLength = max;
        world_.CreateJoint(&def);
    }
};

} // namespace

Solver peer::box2d() {
    return {.name = "box2d",
            .about = "Box2D's bodies and distance joints, in its plane",
            .takes = [](const Work& work) { return work.constraints() <= 300'000; },
            .make = [](const Work& work, const Effort& effort) -> std::unique_ptr<Simulation> {
                return std::make_unique<Box2D>(work, effort);
            }};
}

} // namespace sinew::bench
