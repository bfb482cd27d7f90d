#include "sinew/solver/phases.h"
#include "sinew/solver/project.h"
#include "sinew/solver/remove.h"

namespace sinew {
namespace {

template <class Table, int D, class Real> Real strain_of(World<D, Real>& world, const Table& table, Row row) {
    using Kind = typename Table::Kind;
    const auto members = table.members[row];
    detail::Stencil<Kind, D, Real> stencil(world, members.size());
    stencil.each([&](std::size_t i) { stencil.points[i] = world.particles.position[members[i]]; });
    const Real measure = stencil.evaluate(stencil.points, stencil.gradient);
    return detail::strain<Kind>(measure, table.low[row], table.high[row]);
}

/// Whether a constraint that was overstrained for a step has had enough.
template <class Table, class Real> bool wears_out(Table& table, Row row, Real strain_times_time) {
    if (table.toughness[row] == Real(0)) return true;
    table.fatigue[row] = minimum(table.fatigue[row] + strain_times_time, limit::measure<Real>);
    return table.fatigue[row] > table.toughness[row];
}

} // namespace

template <int D, class Real> void tear(World<D, Real>& world, Real dt) {
    bool any = false;
    int kind = 0;
    for_each_table(world, [&](auto& table) {
        bool torn = false;
        for (Row row = 0; row < table.size(); ++row) {
            if (table.breaking_strain[row] >= limit::measure<Real> || world.events.size() >= events_per_step) continue;
            const Real beyond = absolute(strain_of(world, table, row)) - table.breaking_strain[row];
            if (!(beyond > Real(0)) || !wears_out(table, row, beyond * dt)) continue;
            const ConstraintId id{kind, table.slots.id_of(row)};
            const auto members = table.members[row];
            table.torn[row] = 1;
            torn = true;
            world.events.push_back(
                {.type = EventType::torn,
                 .figure = table.figure[row],
                 .constraint = id,
                 .ends = {world.particles.slots.id_of(members.front()), world.particles.slots.id_of(members.back())}});
        }
        if (torn) detail::erase_constraints(world, table, kind, table.torn);
        any = any || torn;
        ++kind;
    });
    if (any) detail::forget_the_dead(world);
}

#define SINEW_TEAR(D, Real) template void tear(World<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_TEAR)

} // namespace sinew
