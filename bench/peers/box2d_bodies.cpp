#include "bench/peers/peers.h"

#include <box2d/box2d.h>

/// Box2D 2.4 (Catto): rigid bodies, revolute joints and contact, with 8 velocity and 3 position iterations, as its
/// manual has it.
namespace sinew::bench {
namespace {

class Box2DBodies final : public BodySimulation {
  public:
    Box2DBodies(const ContactWork& work, const Bodies& bodies, int substeps)
        : substeps_(substeps), world_({0, work.gravity}) {
        world_.SetAllowSleeping(false);
        world_.SetContinuousPhysics(false); // walls are thick, and it multiplies the time of a pile
        for (const auto& wall : work.walls) add_wall(wall, work.friction);
        for (const auto& body : bodies.bodies) {
            b2BodyDef definition;
            definition.type = b2_dynamicBody;
            definition.position = of(body.center);
            bodies_.push_back(world_.CreateBody(&definition));
        }
        for (const auto& shape : bodies.shapes) add_shape(work, bodies, shape);
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            const b2MassData mass{float(bodies.bodies[i].mass), b2Vec2_zero, float(bodies.bodies[i].inertia)};
            bodies_[i]->SetMassData(&mass);
        }
        for (const auto& joint : bodies.joints) {
            b2RevoluteJointDef definition;
            definition.bodyA = bodies_[joint.a], definition.bodyB = bodies_[joint.b];
            definition.localAnchorA = of(joint.on_a), definition.localAnchorB = of(joint.on_b);
            world_.CreateJoint(&definition);
        }
    }

    void step() override {
        constexpr int for_velocities = 8, for_positions = 3;
        for (int i = 0; i < substeps_; ++i) world_.Step(float(frame / substeps_), for_velocities, for_positions);
    }
    Vector position(std::uint32_t body, const Vector& from_center) const override {
        const auto at = bodies_[body]->GetWorldPoint(of(from_center));
        return {{at.x, at.y}};
    }

  private:
    int substeps_;
    b2World world_;
    std::vector<b2Body*> bodies_;

    static b2Vec2 of(const Vector& v) { return {float(v[0]), float(v[1])}; }

    /// A wall as a long box.
    void add_wall(const ContactWork::Wall& wall, float friction) {
        constexpr float thick = 1, far = 1e4F;
        const b2Vec2 normal(wall.normal[0], wall.normal[1]);
        b2BodyDef definition;
        auto* body = world_.CreateBody(&definition);
        b2PolygonShape box;
        box.SetAsBox(far, thick, (wall.offset - thick) * normal, std::atan2(normal.y, normal.x) - b2_pi / 2);
        b2FixtureDef fixture;
        fixture.shape = &box;
        fixture.friction = friction;
        body->CreateFixture(&fixture);
    }

    /// Box2D 2.4 has no capsule: a box with a disc at each end.
    void add_shape(const ContactWork& work, const Bodies& bodies, const Bodies::Shape& shape) {
        b2FixtureDef fixture;
        fixture.density = 1; // masses are set afterwards
        fixture.friction = work.friction;
        fixture.filter.groupIndex =
            work.is_loose ? std::int16_t(0) : std::int16_t(-1 - int(bodies.bodies[shape.body].figure));
        const auto add = [&](const b2Shape& part) {
            fixture.shape = &part;
            bodies_[shape.body]->CreateFixture(&fixture);
        };
        if (shape.corners.size() < 3)
            for (const auto& corner : shape.corners) {
                b2CircleShape disc;
                disc.m_radius = float(shape.radius);
                disc.m_p = of(corner);
                add(disc);
            }
        if (shape.corners.size() == 1) return;
        b2PolygonShape polygon;
        if (shape.corners.size() == 2) {
            const auto a = of(shape.corners[0]), b = of(shape.corners[1]), along = b - a;
            polygon.SetAsBox(along.Length() / 2, float(shape.radius), 0.5F * (a + b), std::atan2(along.y, along.x));
        } else {
            std::vector<b2Vec2> points;
            for (const auto& corner : shape.corners) points.push_back(of(corner));
            polygon.Set(points.data(), int(points.size()));
            polygon.m_radius = float(shape.radius);
        }
        add(polygon);
    }
};

} // namespace

BodySolver peer::box2d_bodies() {
    return body_solver<Box2DBodies>("box2d 2.4");
}

} // namespace sinew::bench
