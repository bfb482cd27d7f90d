#include "sinew/solver/step/internal_damping.h"

#include "sinew/math/decay.h"
#include "sinew/math/moments.h"
#include "sinew/solver/phases.h"

#include <algorithm>

/// Internal damping of figures: the velocities of a body decay towards those of a rigid body with the same momentum and
/// angular momentum (Müller et al., "Position Based Dynamics", 2007, section 3.5), at a rate that does not depend on
/// the step.
namespace sinew {
namespace {

template <int D, class Real> class InternalDamping {
  public:
    InternalDamping(World<D, Real>& world, DampedBodies& bodies)
        : world_(world), p_(world.particles), bodies_(bodies) {}

    void find_bodies() {
        bodies_.sets.reset(p_.size());
        for_each_table(world_, [&](const auto& table) {
            for (Row row = 0; row < table.size(); ++row) join(table.members[row]);
        });
        bodies_.number_of.resize(p_.size());
        Row count = 0;
        for (Row row = 0; row < p_.size(); ++row) {
            const Row first = bodies_.sets.first_of(row);
            bodies_.number_of[row] = first == row ? count++ : bodies_.number_of[first];
        }
        bodies_.rows.fill(count, [&](auto&& visit) {
            for (Row row = 0; row < p_.size(); ++row)
                if (is_member(row)) visit(bodies_.number_of[row], row);
        });
    }

    void damp(Real dt) const {
        for (std::size_t i = 0; i < bodies_.rows.size(); ++i) {
            const auto rows = bodies_.rows[i];
            if (rows.size() < 2 || p_.asleep[rows.front()]) continue;
            const double rate = world_.figures[p_.figure[rows.front()]].internal_damping;
            if (rate > 0) damp(rows, Decay<double>::of(min(rate, limit::measure<double>), double(dt)).keep);
        }
    }

  private:
    World<D, Real>& world_;
    Particles<D, Real>& p_;
    DampedBodies& bodies_;

    bool is_member(Row row) const { return p_.mobility[row] > Real(0) && p_.figure[row] < world_.figures.size(); }

    void join(std::span<const Row> members) {
        for (const Row a : members)
            for (const Row b : members)
                if (a < b && is_member(a) && is_member(b) && p_.figure[a] == p_.figure[b]) bodies_.sets.join(a, b);
    }

    /// Keeps a share of the velocities relative to the rigid motion.
    void damp(std::span<const Row> rows, double keep) const {
        const auto origin = cast<double>(p_.position[rows.front()]);
        Moments<D> sums;
        for (const Row row : rows) {
            const double mass = 1 / double(p_.inverse_mass[row]);
            const auto arm = cast<double>(p_.position[row]) - origin, momentum = cast<double>(p_.velocity[row]) * mass;
            sums.mass += mass;
            sums.position += arm * mass;
            sums.momentum += momentum;
            sums.spin += moment(arm, momentum);
            sums.second += outer(arm * mass, arm);
        }
        const CentralMoments<D> body(sums);
        const auto rate = body.rate_of(body.spin);
        for (const Row row : rows) {
            const auto arm = cast<double>(p_.position[row]) - origin - body.center;
            const auto rigid = body.velocity + turning(rate, arm);
            p_.velocity[row] = cast<Real>(rigid + (cast<double>(p_.velocity[row]) - rigid) * keep);
        }
    }
};

} // namespace

template <int D, class Real> void damp_internally(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    const auto is_damped = [](const Figure& figure) { return figure.internal_damping > 0; };
    if (world.settings.mode != Mode::physical || std::none_of(world.figures.begin(), world.figures.end(), is_damped))
        return solver.damped.reset();
    if (!solver.damped) solver.damped = std::make_shared<DampedBodies>();
    InternalDamping<D, Real> damping(world, *solver.damped);
    if (std::exchange(solver.damped->edits, world.journal.edits) != world.journal.edits) damping.find_bodies();
    damping.damp(dt);
}

#define SINEW_INTERNAL_DAMPING(D, Real) template void damp_internally(World<D, Real>&, Solver<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_INTERNAL_DAMPING)

} // namespace sinew
