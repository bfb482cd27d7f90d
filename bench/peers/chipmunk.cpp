#include "bench/peers/chipmunk_space.h"
#include "bench/peers/peers.h"

#include <limits>

/// Chipmunk 7 (Lembcke): bodies, pin joints, and slide joints for limits, in the xy plane.
namespace sinew::bench {
namespace {

class Chipmunk final : public Simulation {
  public:
    Chipmunk(const Work& work, const Effort& effort) : effort_(effort) {
        cpSpaceSetGravity(space_, cpv(work.gravity[0], work.gravity[1]));
        cpSpaceSetIterations(space_, effort.iterations);
        for (std::size_t i = 0; i < work.positions.size(); ++i) {
            const bool moves = work.inverse_masses[i] > 0;
            auto* body = moves ? cpBodyNew(1 / work.inverse_masses[i], std::numeric_limits<double>::infinity())
                               : cpBodyNewStatic();
            cpBodySetPosition(body, cpv(work.positions[i][0], work.positions[i][1]));
            if (moves) cpBodySetVelocity(body, cpv(work.velocities[i][0], work.velocities[i][1]));
            bodies_.push_back(moves ? cpSpaceAddBody(space_, body) : body);
        }
        for (const auto& stick : work.sticks) {
            auto* joint = cpPinJointNew(bodies_[stick.a], bodies_[stick.b], cpvzero, cpvzero);
            cpPinJointSetDist(joint, stick.rest);
            add(joint);
        }
        for (const auto& strut : work.struts)
            add(cpSlideJointNew(bodies_[strut.a], bodies_[strut.b], cpvzero, cpvzero, strut.min,
                                std::numeric_limits<double>::infinity()));
    }
    Chipmunk(const Chipmunk&) = delete;
    Chipmunk& operator=(const Chipmunk&) = delete;
    ~Chipmunk() override {
        for (auto* joint : joints_) {
            cpSpaceRemoveConstraint(space_, joint);
            cpConstraintFree(joint);
        }
        for (auto* body : bodies_) {
            if (cpBodyGetType(body) == CP_BODY_TYPE_DYNAMIC) cpSpaceRemoveBody(space_, body);
            cpBodyFree(body);
        }
        cpSpaceFree(space_);
    }

    void step() override {
        for (int i = 0; i < effort_.substeps; ++i) cpSpaceStep(space_, frame / effort_.substeps);
    }
    Found position(std::size_t particle) const override {
        const auto at = cpBodyGetPosition(bodies_[particle]);
        return {{at.x, at.y, 0}};
    }

  private:
    Effort effort_;
    cpSpace* space_ = make_space();
    std::vector<cpBody*> bodies_;
    std::vector<cpConstraint*> joints_;

    void add(cpConstraint* joint) { joints_.push_back(cpSpaceAddConstraint(space_, joint)); }
};

} // namespace

Solver peer::chipmunk() {
    return {.name = "chipmunk",
            .about = "Chipmunk's bodies, pin joints and slide joints, in its plane",
            .takes = [](const Work& work) { return work.constraints() <= 300'000; },
            .make = [](const Work& work, const Effort& effort) -> std::unique_ptr<Simulation> {
                return std::make_unique<Chipmunk>(work, effort);
            }};
}

} // namespace sinew::bench
