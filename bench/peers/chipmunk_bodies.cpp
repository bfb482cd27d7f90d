#include "bench/peers/chipmunk_space.h"
#include "bench/peers/peers.h"

/// Chipmunk 7 (Lembcke): rigid bodies, pivots and contact, with 10 iterations, its default.
namespace sinew::bench {
namespace {

class ChipmunkBodies final : public BodySimulation {
  public:
    ChipmunkBodies(const ContactWork& work, const Bodies& bodies, int substeps) : substeps_(substeps) {
        cpSpaceSetGravity(space_, cpv(0, work.gravity));
        for (const auto& wall : work.walls) add_wall(wall, work.friction);
        for (const auto& body : bodies.bodies) {
            bodies_.push_back(cpSpaceAddBody(space_, cpBodyNew(body.mass, body.inertia)));
            cpBodySetPosition(bodies_.back(), of(body.center));
        }
        for (const auto& shape : bodies.shapes) {
            auto* made = make_shape(shape);
            // Shapes of one group do not touch; a group of 0 is none.
            const auto group = work.is_loose ? 0 : bodies.bodies[shape.body].figure + 1;
            cpShapeSetFilter(made, cpShapeFilterNew(group, CP_ALL_CATEGORIES, CP_ALL_CATEGORIES));
            cpShapeSetFriction(made, work.friction);
            shapes_.push_back(cpSpaceAddShape(space_, made));
        }
        for (const auto& joint : bodies.joints)
            joints_.push_back(cpSpaceAddConstraint(
                space_, cpPivotJointNew2(bodies_[joint.a], bodies_[joint.b], of(joint.on_a), of(joint.on_b))));
    }
    ChipmunkBodies(const ChipmunkBodies&) = delete;
    ChipmunkBodies& operator=(const ChipmunkBodies&) = delete;
    ~ChipmunkBodies() override {
        for (auto* joint : joints_) {
            cpSpaceRemoveConstraint(space_, joint);
            cpConstraintFree(joint);
        }
        for (auto* shape : shapes_) {
            cpSpaceRemoveShape(space_, shape);
            cpShapeFree(shape);
        }
        for (auto* body : bodies_) {
            cpSpaceRemoveBody(space_, body);
            cpBodyFree(body);
        }
        cpSpaceFree(space_);
    }

    void step() override {
        for (int i = 0; i < substeps_; ++i) cpSpaceStep(space_, frame / substeps_);
    }
    Vector position(std::uint32_t body, const Vector& from_center) const override {
        const auto at = cpBodyLocalToWorld(bodies_[body], of(from_center));
        return {{at.x, at.y}};
    }

  private:
    int substeps_;
    cpSpace* space_ = make_space();
    std::vector<cpBody*> bodies_;
    std::vector<cpShape*> shapes_;
    std::vector<cpConstraint*> joints_;

    static cpVect of(const Vector& v) { return cpv(v[0], v[1]); }

    /// A wall as a thick segment.
    void add_wall(const ContactWork::Wall& wall, double friction) {
        constexpr double thick = 1, far = 1e4;
        const auto normal = cpv(wall.normal[0], wall.normal[1]);
        const auto middle = cpvmult(normal, wall.offset - thick), along = cpvmult(cpvperp(normal), far);
        auto* shape =
            cpSegmentShapeNew(cpSpaceGetStaticBody(space_), cpvsub(middle, along), cpvadd(middle, along), thick);
        cpShapeSetFriction(shape, friction);
        shapes_.push_back(cpSpaceAddShape(space_, shape));
    }
    cpShape* make_shape(const Bodies::Shape& shape) {
        auto* body = bodies_[shape.body];
        const auto& corners = shape.corners;
        if (corners.size() == 1) return cpCircleShapeNew(body, shape.radius, of(corners[0]));
        if (corners.size() == 2) return cpSegmentShapeNew(body, of(corners[0]), of(corners[1]), shape.radius);
        std::vector<cpVect> points;
        for (const auto& corner : corners) points.push_back(of(corner));
        return cpPolyShapeNewRaw(body, int(points.size()), points.data(), shape.radius);
    }
};

} // namespace

BodySolver peer::chipmunk_bodies() {
    return body_solver<ChipmunkBodies>("chipmunk");
}

} // namespace sinew::bench
