#include "sinew/solver/phases.h"
#include "sinew/solver/project.h"
#include "sinew/world/remove.h"

#include <algorithm>

namespace sinew {
namespace {

template <class Table, int D, class Real>
Real strain_of(const World<D, Real>& world, std::span<Vec<D, Real>> scratch, const Table& table, Row row) {
    using Kind = typename Table::Kind;
    const auto members = table.members[row];
    detail::Stencil<Kind, D, Real> stencil(scratch, members.size());
    stencil.each([&](std::size_t i) { stencil.points[i] = world.particles.position[members[i]]; });
    const Real measure = stencil.evaluate(stencil.points, stencil.gradient);
    return detail::strain<Kind>(measure, table.low(row), table.high(row));
}

/// True if the force of a constraint in the last substep is more than the constraint bears. Multipliers of classic mode
/// are no forces.
template <class Table, int D, class Real> bool is_overloaded(const World<D, Real>& world, const Table& table, Row row) {
    if (table.break_force[row] >= limit::measure<Real> || world.settings.mode == Mode::classic) return false;
    return absolute(table.multiplier[row]) > table.break_force[row] * square(world.last_substep);
}

/// Adds the damage of a step; true when the constraint fails.
template <class Table, class Real> bool wears_out(Table& table, Row row, Real strain_times_time) {
    if (table.damage_limit[row] == Real(0)) return true;
    table.damage.set(row, min(table.damage[row] + strain_times_time, limit::measure<Real>));
    return table.damage[row] > table.damage_limit[row];
}

/// True if both ends of a distance torn in this step are among the members.
template <int D, class Real> bool lost_a_link(const World<D, Real>& world, std::span<const Row> members) {
    return std::any_of(world.events.begin(), world.events.end(), [&](const Event& event) {
        return event.type == EventType::torn && event.constraint.kind == kind_number<Distance, D> &&
               std::all_of(event.ends.begin(), event.ends.end(), [&](ParticleId end) {
                   const auto row = world.particles.handles.find(end);
                   return row && std::find(members.begin(), members.end(), *row) != members.end();
               });
    });
}

template <class Table, int D, class Real>
bool tears(const World<D, Real>& world, std::span<Vec<D, Real>> scratch, Table& table, Row row, Real dt) {
    if (world.events.size() >= events_per_step) return false;
    if (is_overloaded(world, table, row)) return true;
    if (table.breaking_strain[row] >= limit::measure<Real>) return false;
    const Real beyond = absolute(strain_of(world, scratch, table, row)) - table.breaking_strain[row];
    return beyond > Real(0) && wears_out(table, row, beyond * dt);
}

template <class Table, int D, class Real> void report(World<D, Real>& world, const Table& table, int kind, Row row) {
    const auto members = table.members[row];
    const auto& handles = world.particles.handles;
    world.events.push_back({.type = EventType::torn,
                            .figure = table.figure[row],
                            .constraint = {kind, table.handles.id_of(row)},
                            .ends = {handles.id_of(members.front()), handles.id_of(members.back())}});
}

} // namespace

template <int D, class Real> void tear(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    static_assert(kind_number<Distance, D> == 0, "what hangs on a distance is looked at after it");
    if (world.settings.mode == Mode::physical && !solver.sweep_state.plan.may_tear) return;
    bool any_link = false, any = false;
    int kind = 0;
    for_each_table(world, [&](auto& table) {
        auto& torn = solver.torn;
        torn.clear();
        for (Row row = 0; row < table.size(); ++row) {
            const bool attached = kind > 0 && any_link && lost_a_link(world, table.members[row]);
            if (!attached && !tears(world, std::span(solver.scratch), table, row, dt)) continue;
            if (!attached) report(world, table, kind, row);
            torn.resize(table.size(), 0);
            torn[row] = 1;
        }
        if (!torn.empty()) detail::erase_constraints(world, table, kind, torn);
        any = any || !torn.empty();
        if (kind++ == 0) any_link = !torn.empty();
    });
    if (any) detail::forget_constraints(world);
}

#define SINEW_TEAR(D, Real) template void tear(World<D, Real>&, Solver<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_TEAR)

} // namespace sinew
