#include "sinew/solver/changes.h"
#include "sinew/solver/edit.h"

#include <algorithm>

/// What comes new into a world: one particle, one constraint after the other, millions of them.
namespace sinew {
namespace {

template <class Table, class Real>
void append_row(Table& table, const ConstraintSpec<Real>& spec, Interval<Real> limits) {
    constexpr auto most = limit::measure<Real>;
    table.low.push_back(clamp(limits.low, -most, most));
    table.high.push_back(clamp(limits.high, table.low.back(), most));
    table.multiplier.push_back(Real(0));
    table.compliance.push_back(clamp(spec.compliance, Real(0), most));
    table.relaxation.push_back(clamp(spec.relaxation, Real(0), Real(1)));
    table.split.push_back(clamp(spec.split, Real(0), Real(1)));
    table.max_force.push_back(clamp(spec.max_force, Real(0), most));
    table.lead.push_back(clamp(spec.lead, Real(0), limit::step<Real>));
    table.rate.push_back(Real(0));
    table.driven.push_back(0);
    table.breaking_strain.push_back(clamp(spec.breaking_strain, Real(0), most));
    table.toughness.push_back(clamp(spec.toughness, Real(0), most));
    table.fatigue.push_back(Real(0));
    table.figure.push_back(spec.figure);
    table.in_block.push_back(0);
    table.torn.push_back(0);
}

constexpr std::size_t few = 8; // members, as most constraints have: no list is made for them

bool any_twice(std::span<const Row> rows) {
    if (rows.size() <= few) {
        for (auto row = rows.begin(); row != rows.end(); ++row)
            if (std::find(rows.begin(), row, *row) != row) return true;
        return false;
    }
    std::vector<Row> sorted(rows.begin(), rows.end());
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

} // namespace

template <int D, class Real> void reserve(World<D, Real>& world, Sizes sizes) {
    reserve_rows(world.particles, world.particles.size() + sizes.particles);
    world.particles.slots.reserve(world.particles.size() + sizes.particles);
    auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    reserve_rows(distances, distances.size() + sizes.constraints);
    distances.members.rows.reserve(distances.size() + sizes.constraints);
    distances.slots.reserve(distances.size() + sizes.constraints);
}

template <int D, class Real> ParticleId add_particle(World<D, Real>& world, const ParticleSpec<D, Real>& spec) {
    auto& p = world.particles;
    const Real h = verlet_interval(world);
    p.position.push_back(spec.position);
    p.previous.push_back(spec.previous.value_or(spec.position - spec.velocity * h));
    p.velocity.push_back(spec.previous ? (spec.position - *spec.previous) * inverse_or_zero(world.settings.frame)
                                       : spec.velocity);
    p.residual.push_back({});
    p.force.push_back({});
    p.rebound.push_back({});
    p.inverse_mass.push_back(inverse_of_mass(spec.mass));
    p.mobility.push_back(p.inverse_mass.back());
    p.radius.push_back(spec.radius);
    p.figure.push_back(spec.figure);
    p.quarantined.push_back(0);
    p.in_block.push_back(0);
    world.events.reserve(events_per_step);
    const auto id = p.slots.append();
    detail::note_particle(world);
    return id;
}

template <int D, class Real>
std::optional<ConstraintId> add_constraint(World<D, Real>& world, int kind, std::span<const ParticleId> members,
                                           const ConstraintSpec<Real>& spec) {
    std::array<Row, few> in_place{};
    std::vector<Row> wide(members.size() > few ? members.size() : 0);
    const auto rows = members.size() > few ? std::span(wide) : std::span(in_place).first(members.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto row = world.particles.slots.find(members[i]);
        if (!row) return std::nullopt;
        rows[i] = *row;
    }
    if (any_twice(rows)) return std::nullopt;

    std::optional<ConstraintId> added;
    visit_table(world, kind, [&](auto& table) {
        using Kind = typename std::decay_t<decltype(table)>::Kind;
        if constexpr (Kind::arity == any_arity) {
            if (int(rows.size()) < Kind::least_arity) return;
            // the widest constraint's points, gradients and directions
            world.scratch.resize(std::max(world.scratch.size(), 3 * rows.size()));
        } else if (rows.size() != std::size_t(Kind::arity)) {
            return;
        }
        table.members.append(rows);
        append_row(table, spec, spec.limits.value_or(Interval<Real>{0, 0}));
        if (table.breaking_strain.back() < limit::measure<Real>) // and what hangs on it goes with it, in a step
            for_each_table(world, [](auto& any) { any.expect_tears(); });
        added = ConstraintId{kind, table.slots.append()};
        for (const Row member : rows) detail::note_member(world, table, kind, Row(table.size() - 1), member);
        if (!spec.limits) {
            constexpr double most = limit::measure<double>;
            const Real rest = Real(clamp(constraint_state(world, *added)->measure, -most, most));
            table.low.back() = table.high.back() = rest;
        }
        if (world.sweep.empty() || world.sweep.back().kind != kind) world.sweep.push_back({kind, 0});
        ++world.sweep.back().count;
    });
    return added;
}

#define SINEW_ADD(D, Real)                                                                                             \
    template void reserve(World<D, Real>&, Sizes);                                                                     \
    template ParticleId add_particle(World<D, Real>&, const ParticleSpec<D, Real>&);                                   \
    template std::optional<ConstraintId> add_constraint(World<D, Real>&, int, std::span<const ParticleId>,             \
                                                        const ConstraintSpec<Real>&);

SINEW_INSTANTIATE(SINEW_ADD)

} // namespace sinew
