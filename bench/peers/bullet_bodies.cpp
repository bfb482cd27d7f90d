#include "bench/peers/peers.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <btBulletDynamicsCommon.h>
#include <deque>

/// Bullet 3 (Coumans): rigid bodies in a plane, point-to-point joints and contact, with 10 iterations, its default.
namespace sinew::bench {
namespace {

/// Bodies of one figure do not touch each other: their index.
struct OtherFigures final : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
        const auto figure = [](const btBroadphaseProxy* proxy) {
            return static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex();
        };
        return figure(a) < 0 || figure(a) != figure(b);
    }
};

class BulletBodies final : public BodySimulation {
  public:
    BulletBodies(const ContactWork& work, const Bodies& bodies, int substeps) : substeps_(substeps) {
        world_.setGravity({0, work.gravity, 0});
        broadphase_.getOverlappingPairCache()->setOverlapFilterCallback(&filter_);
        for (const auto& wall : work.walls) add_wall(wall, work.friction);
        std::vector<btCompoundShape*> compounds;
        for (std::size_t i = 0; i < bodies.bodies.size(); ++i) compounds.push_back(&compounds_.emplace_back());
        for (const auto& shape : bodies.shapes) add_shape(*compounds[shape.body], shape);
        for (std::size_t i = 0; i < bodies.bodies.size(); ++i) {
            const auto& body = bodies.bodies[i];
            const auto inertia = btScalar(body.inertia);
            btRigidBody::btRigidBodyConstructionInfo info(btScalar(body.mass), nullptr, compounds[i],
                                                          {inertia, inertia, inertia});
            info.m_startWorldTransform = btTransform(btQuaternion::getIdentity(), of(body.center));
            info.m_friction = work.friction;
            auto& made = bodies_.emplace_back(info);
            made.setLinearFactor({1, 1, 0});
            made.setAngularFactor({0, 0, 1});
            made.setActivationState(DISABLE_DEACTIVATION);
            made.setUserIndex(work.is_loose ? -1 : int(body.figure));
            world_.addRigidBody(&made);
        }
        for (const auto& joint : bodies.joints)
            world_.addConstraint(
                &joints_.emplace_back(bodies_[joint.a], bodies_[joint.b], of(joint.on_a), of(joint.on_b)));
    }
    BulletBodies(const BulletBodies&) = delete;
    BulletBodies& operator=(const BulletBodies&) = delete;
    ~BulletBodies() override {
        for (auto& joint : joints_) world_.removeConstraint(&joint);
        for (auto* bodies : {&bodies_, &walls_})
            for (auto& body : *bodies) world_.removeRigidBody(&body);
    }

    void step() override {
        for (int i = 0; i < substeps_; ++i) world_.stepSimulation(btScalar(frame / substeps_), 0);
    }
    Vector position(std::uint32_t body, const Vector& from_center) const override {
        const auto at = bodies_[body].getWorldTransform() * of(from_center);
        return {{at.x(), at.y()}};
    }

  private:
    int substeps_;
    OtherFigures filter_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::deque<btCompoundShape> compounds_; // which stay where they are
    std::deque<btRigidBody> bodies_, walls_;
    std::deque<btPoint2PointConstraint> joints_;

    static btVector3 of(const Vector& v) { return {btScalar(v[0]), btScalar(v[1]), 0}; }

    void add_wall(const ContactWork::Wall& wall, float friction) {
        shapes_.push_back(
            std::make_unique<btStaticPlaneShape>(btVector3(wall.normal[0], wall.normal[1], 0), wall.offset));
        btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shapes_.back().get());
        info.m_friction = friction;
        auto& made = walls_.emplace_back(info);
        made.setUserIndex(-1);
        world_.addRigidBody(&made);
    }
    void add_shape(btCompoundShape& compound, const Bodies::Shape& shape) {
        std::vector<btVector3> corners;
        for (const auto& corner : shape.corners) corners.push_back(of(corner));
        const btScalar radius = btScalar(shape.radius);
        if (corners.size() <= 2) {
            const btVector3 along = corners.back() - corners.front();
            std::unique_ptr<btCollisionShape> made;
            if (corners.size() == 1)
                made = std::make_unique<btSphereShape>(radius);
            else
                made = std::make_unique<btCapsuleShape>(radius, along.length()); // along y
            const btScalar turn = corners.size() == 1 ? 0 : std::atan2(along.y(), along.x()) - SIMD_HALF_PI;
            const btTransform at(btQuaternion({0, 0, 1}, turn), (corners.front() + corners.back()) / 2);
            compound.addChildShape(at, made.get());
            shapes_.push_back(std::move(made));
            return;
        }
        // The margin around a hull is its radius.
        auto made = std::make_unique<btConvexHullShape>();
        for (const auto& corner : corners)
            for (const btScalar depth : {btScalar(-0.5), btScalar(0.5)})
                made->addPoint(corner + btVector3(0, 0, depth), false);
        made->recalcLocalAabb();
        made->setMargin(radius);
        compound.addChildShape(btTransform::getIdentity(), made.get());
        shapes_.push_back(std::move(made));
    }
};

} // namespace

BodySolver peer::bullet_bodies() {
    return body_solver<BulletBodies>("bullet");
}

} // namespace sinew::bench
