#include "bench/peers/peers.h"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

/// Bullet 3 (Coumans): a soft body of nodes and links, at maximal stiffness, undamped, without collisions.
namespace sinew::bench {
namespace {

class Bullet final : public Simulation {
  public:
    Bullet(const Work& work, const Effort& effort) : effort_(effort) {
        const auto vector = [](const Position& position) { return btVector3(position[0], position[1], position[2]); };
        const btVector3 gravity = vector(work.gravity);
        world_.setGravity(gravity);
        info_.m_gravity = gravity;
        info_.air_density = 0;
        info_.m_dispatcher = &dispatcher_;
        info_.m_broadphase = &broadphase_;
        btAlignedObjectArray<btVector3> positions;
        btAlignedObjectArray<btScalar> masses;
        for (std::size_t i = 0; i < work.positions.size(); ++i) {
            positions.push_back(vector(work.positions[i]));
            masses.push_back(work.inverse_masses[i] > 0 ? 1 / work.inverse_masses[i] : 0);
        }
        body_ = new btSoftBody(&info_, positions.size(), &positions[0], &masses[0]);
        body_->m_materials[0]->m_kLST = 1;
        body_->m_cfg.piterations = effort.iterations;
        body_->m_cfg.kDP = 0;
        body_->m_cfg.kDF = 0;
        body_->m_cfg.collisions = 0;
        for (const auto& stick : work.sticks) body_->appendLink(int(stick.a), int(stick.b));
        for (std::size_t i = 0; i < work.positions.size(); ++i) body_->m_nodes[int(i)].m_v = vector(work.velocities[i]);
        body_->setActivationState(DISABLE_DEACTIVATION);
        world_.addSoftBody(body_);
    }
    Bullet(const Bullet&) = delete;
    Bullet& operator=(const Bullet&) = delete;
    ~Bullet() override {
        world_.removeSoftBody(body_);
        delete body_;
    }

    void step() override {
        for (int i = 0; i < effort_.substeps; ++i) world_.stepSimulation(btScalar(frame / effort_.substeps), 0);
    }
    Found position(std::size_t particle) const override {
        const auto& at = body_->m_nodes[int(particle)].m_x;
        return {{at.x(), at.y(), at.z()}};
    }

  private:
    Effort effort_;
    btSoftBodyRigidBodyCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btSoftRigidDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    btSoftBodyWorldInfo info_;
    btSoftBody* body_ = nullptr;
};

} // namespace

Solver peer::bullet() {
    return {.name = "bullet",
            .about = "Bullet's soft body; it knows no limits of joints and leaves them out",
            .takes = [](const Work& work) { return work.constraints() <= 300'000; },
            .make = [](const Work& work, const Effort& effort) -> std::unique_ptr<Simulation> {
                return std::make_unique<Bullet>(work, effort);
            }};
}

} // namespace sinew::bench
