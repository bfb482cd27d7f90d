#include "sinew/solver/phases.h"
#include "sinew/solver/project.h"

#include <algorithm>

/// Winches and motors: moving limits and slipping lengths.
namespace sinew {
namespace {

template <class Real> constexpr bool is_limit(Real limit) {
    return absolute(limit) < limit::measure<Real>;
}

/// Slip of a limit: the part of the error beyond the give of a spring at max_force.
template <class Table, int D, class Real> Real slipped(Solver<D, Real>& solver, const Table& table, Row row) {
    const auto members = table.members[row];
    detail::Stencil<typename Table::Kind, D, Real> stencil(solver.scratch, members.size());
    stencil.each([&](std::size_t i) {
        stencil.points[i] = solver.sweep_state.position_at(solver.sweep_state.slot_of[members[i]]);
    });
    const Real measure = detail::unwrap<typename Table::Kind>(stencil.evaluate(stencil.points, stencil.gradient),
                                                              table.low(row), table.high(row));
    const Real error = measure - clamp(measure, table.low(row), table.high(row));
    const Real spring = table.max_stretch(row);
    return error - clamp(error, -spring, spring);
}

template <class Table> bool is_driven(const Table& table) {
    return table.motorized.any_of([](char driven) { return driven != 0; }) || table.any_gives();
}

} // namespace

template <int D, class Real> bool any_driven(const World<D, Real>& world) {
    bool any = false;
    for_each_table(world, [&](const auto& table) { any = any || is_driven(table); });
    return any;
}

template <int D, class Real> void move_limits(World<D, Real>& world, Real h) {
    for_each_table(world, [&](auto& table) {
        constexpr bool is_length = std::decay_t<decltype(table)>::Kind::length_power == 1;
        for (Row row = 0; row < table.size(); ++row) {
            if (table.motor_speed[row] == Real(0)) continue;
            const auto moved = [&](Real end) {
                if (!is_limit(end)) return end;
                const Real next = end + table.motor_speed[row] * h;
                return is_length ? max(next, Real(0)) : next;
            };
            table.limits.change(row, moved);
        }
    });
}

template <int D, class Real> void slip(World<D, Real>& world, Solver<D, Real>& solver, Real h) {
    for_each_table(world, [&](auto& table) {
        constexpr bool is_length = std::decay_t<decltype(table)>::Kind::length_power == 1;
        if (is_length || table.motorized.any_of([](char driven) { return driven != 0; }))
            for (Row row = 0; row < table.size(); ++row) {
                if (!table.gives(row) || !(is_length || table.motorized[row])) continue;
                if (moves_any(solver.blocks, world, std::as_const(table).members[row])) continue;
                if (absolute(table.multiplier[row]) < Real(slipping_share) * table.max_force[row] * h * h) continue;
                const Real by = slipped(solver, table, row);
                const auto moved = [&](Real end) {
                    if (!is_limit(end)) return end;
                    return is_length ? max(end + by, Real(0)) : end + by;
                };
                table.limits.change(row, moved);
            }
    });
}

#define SINEW_DRIVE(D, Real)                                                                                           \
    template bool any_driven(const World<D, Real>&);                                                                   \
    template void move_limits(World<D, Real>&, Real);                                                                  \
    template void slip(World<D, Real>&, Solver<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_DRIVE)

} // namespace sinew
