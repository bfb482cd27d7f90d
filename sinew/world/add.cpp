#include "sinew/assert/assert.h"
#include "sinew/math/sort.h"
#include "sinew/world/changes.h"
#include "sinew/world/edit.h"
#include "sinew/world/stencil.h"

#include <algorithm>

/// Adding particles and constraints, singly or in bulk.
namespace sinew {
namespace {

/// no_figure for an unused index: a figure added later must not own the row.
template <class WorldT> FigureIndex known(const WorldT& world, FigureIndex figure) {
    return has_figure(world, figure) ? figure : no_figure;
}

/// Appends `count` equal rows.
template <class Table, class Real>
void append_rows(Table& table, std::size_t count, const ConstraintSpec<Real>& spec, Interval<Real> limits,
                 FigureIndex figure) {
    constexpr auto max = limit::measure<Real>;
    const Real low = clamp(limits.low, -max, max);
    table.limits.append(count, low, clamp(limits.high, low, max));
    table.multiplier.resize(table.multiplier.size() + count);
    table.compliance.append(count, clamp(spec.compliance, Real(0), max));
    table.relaxation.append(count, clamp(spec.relaxation, Real(0), Real(1)));
    table.split.append(count, clamp(spec.split, Real(0), Real(1)));
    table.max_force.append(count, clamp(spec.max_force, Real(0), max));
    table.damping_time.append(count, clamp(spec.damping_time, Real(0), limit::step<Real>));
    table.motor_speed.append(count, Real(0));
    table.motorized.append(count, 0);
    table.breaking_strain.append(count, clamp(spec.breaking_strain, Real(0), max));
    table.break_force.append(count, clamp(spec.break_force, Real(0), max));
    table.damage_limit.append(count, clamp(spec.damage_limit, Real(0), max));
    table.damage.append(count, Real(0));
    table.figure.append(count, figure);
}

constexpr std::size_t few = 8; // members: most constraints need no heap allocation

bool any_twice(std::span<const Row> rows) {
    if (rows.size() <= few) {
        for (auto row = rows.begin(); row != rows.end(); ++row)
            if (std::find(rows.begin(), row, *row) != row) return true;
        return false;
    }
    std::vector<Row> sorted(rows.begin(), rows.end());
    sinew::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

template <class Table> bool has_equal_columns(const Table& table) {
    bool equal = table.members.size() == table.size();
    Table::columns(table, [&](const auto& column) { equal = equal && column.size() == table.size(); });
    return equal;
}

/// Completes rows of a table of which only the members exist. Calls named(id) for each.
template <int D, class Real, class Table, class Named>
void complete(World<D, Real>& world, Table& table, const ConstraintSpec<Real>& spec, Named&& named) {
    constexpr int kind = Kinds<D>::template index_of<typename Table::Kind>;
    const auto first = Row(table.size()), last = Row(table.members.size());
    SINEW_ASSERT(first <= last && last <= limit::rows, "members are appended first, within the limit");
    if (first == last) return;
    append_rows(table, last - first, spec, spec.limits.value_or(Interval<Real>{0, 0}), known(world, spec.figure));
    if (table.may_tear(last - 1)) // dependents of every kind tear along, within a step
        for_each_table(world, [](auto& any) { any.expect_tears(); });
    for (Row row = first; row < last; ++row) {
        const ConstraintId id{kind, table.handles.append()};
        for (const Row member : std::as_const(table).members[row]) detail::note_member(world, table, kind, row, member);
        if (!spec.limits) {
            constexpr double max = limit::measure<double>;
            const auto measure = Real(clamp(constraint_state(world, id)->measure, -max, max));
            table.limits.set(row, measure, measure);
        }
        named(id);
    }
    if (world.sweep.empty() || world.sweep.back().kind != kind) world.sweep.push_back({kind, 0});
    world.sweep.back().count += last - first;
    SINEW_ASSERT(has_equal_columns(table), "the columns of a table have one length");
}

/// Velocity of the spec, or the one implied by the position a frame ago.
template <int D, class Real> Vec<D, Real> velocity_of(const World<D, Real>& world, const ParticleSpec<D, Real>& spec) {
    if (!spec.previous) return spec.velocity;
    const auto within = [](const Vec<D, Real>& position) { return clamp_finite(position, limit::coordinate<Real>); };
    const Real frame = world.settings.frame;
    const Real per_frame = frame > limit::shortest_step<Real> ? inverse_or_zero(frame) : Real(0);
    return (within(spec.position) - within(*spec.previous)) * per_frame;
}

} // namespace

template <int D, class Real> void reserve(World<D, Real>& world, Sizes sizes) {
    reserve_rows(world.particles, world.particles.size() + sizes.particles);
    world.particles.handles.reserve(world.particles.size() + sizes.particles);
    auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    reserve_rows(distances, distances.size() + sizes.constraints);
    distances.members.rows.reserve(distances.size() + sizes.constraints);
    distances.handles.reserve(distances.size() + sizes.constraints);
}

template <int D, class Real> ParticleId add_particle(World<D, Real>& world, const ParticleSpec<D, Real>& spec) {
    auto& p = world.particles;
    constexpr auto furthest = limit::coordinate<Real>;
    const auto position = clamp_finite(spec.position, furthest);
    const auto velocity = clamp_finite(velocity_of(world, spec), limit::speed<Real>);
    p.position.push_back(position);
    p.previous.push_back(clamp_finite(spec.previous.value_or(position - velocity * verlet_interval(world)), furthest));
    p.velocity.push_back(velocity);
    p.residual.push_back({});
    p.force.push_back({});
    p.inverse_mass.push_back(inverse_of_mass(spec.mass));
    p.mobility.push_back(p.inverse_mass.back());
    p.radius.push_back(is_finite(spec.radius) ? clamp(spec.radius, Real(0), furthest) : spec.radius);
    p.figure.push_back(known(world, spec.figure));
    p.quarantined.push_back(0);
    p.rest_time.push_back(Real(0));
    p.asleep.push_back(char(0));
    p.energy_debt.push_back(0);
    p.rolls.push_back(spec.rolls);
    p.inertia.push_back(is_finite(spec.inertia) ? clamp(spec.inertia, Real(0.001), Real(1000)) : Real(1));
    p.spin.push_back(is_finite(spec.spin) ? clamp_components(spec.spin, limit::speed<Real>) : Vec<spins<D>, Real>{});
    p.turn.push_back({});
    p.near.push_back(char(0));
    p.at_end.push_back(0);
    world.events.reserve(events_per_step);
    SINEW_ASSERT(p.at_end.size() == p.size(), "the columns of a table have one length");
    const auto id = p.handles.append();
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
        const auto row = world.particles.handles.find(members[i]);
        if (!row) return std::nullopt;
        rows[i] = *row;
    }
    if (any_twice(rows)) return std::nullopt;

    std::optional<ConstraintId> added;
    visit_table(world, kind, [&](auto& table) {
        using Kind = typename std::decay_t<decltype(table)>::Kind;
        if constexpr (Kind::arity == any_arity) {
            if (int(rows.size()) < Kind::min_arity) return;
        } else if (rows.size() != std::size_t(Kind::arity)) {
            return;
        }
        if (table.size() == limit::rows) return;
        if (spec.limits && !detail::are_possible<Kind>(spec.limits->low, spec.limits->high)) return;
        table.members.append(rows);
        complete(world, table, spec, [&](const ConstraintId& id) { added = id; });
    });
    return added;
}

template <int D, class Real>
void add_distances(World<D, Real>& world, std::span<const std::array<ParticleId, 2>> ends,
                   const ConstraintSpec<Real>& spec, IdList<ConstraintId>& added) {
    if (spec.limits && !detail::are_possible<Distance<D>>(spec.limits->low, spec.limits->high)) return;
    auto& table = std::get<kind_number<Distance, D>>(world.constraints);
    const auto& handles = world.particles.handles;
    for (const auto& [a, b] : ends)
        if (const auto from = handles.find(a), to = handles.find(b);
            from && to && from != to && table.members.size() < limit::rows)
            table.members.rows.push_back({*from, *to});
    complete(world, table, spec, [&](const ConstraintId& id) { added.push_back(id); });
}

#define SINEW_ADD(D, Real)                                                                                             \
    template void reserve(World<D, Real>&, Sizes);                                                                     \
    template ParticleId add_particle(World<D, Real>&, const ParticleSpec<D, Real>&);                                   \
    template std::optional<ConstraintId> add_constraint(World<D, Real>&, int, std::span<const ParticleId>,             \
                                                        const ConstraintSpec<Real>&);                                  \
    template void add_distances(World<D, Real>&, std::span<const std::array<ParticleId, 2>>,                           \
                                const ConstraintSpec<Real>&, IdList<ConstraintId>&);

SINEW_INSTANTIATE(SINEW_ADD)

} // namespace sinew
