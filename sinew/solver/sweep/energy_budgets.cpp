#include "sinew/solver/phases.h"

#include <algorithm>

/// Angle limits must not add energy to a figure. The sweep corrects each limit at the cost of the neighbours, and a
/// whip can come out faster than at the start. Therefore, while an angle is at a limit, the constraints of the figure
/// may dissipate kinetic energy but not add any. For particles going from velocity u to v under impulses J,
///
///     T_after - T_before = sum J . (u + v)/2
///
/// where all terms but the pins' belong to the constraints. Energy added by the constraints is removed from the motion
/// relative to the mean velocity of a free figure, or from all motion of a held figure; positions stay as solved.
namespace sinew {
namespace {

template <class Table> bool limits_turn(const Table& table, Row row) {
    return Table::Kind::length_power == 0 && table.low(row) < table.high(row);
}

template <int D, class Real> double inertia_of(const SweepState<D, Real>& sweep_state, Row slot) {
    return inverse_or_zero(double(sweep_state.mobility[slot]));
}

template <int D, class Real> bool find_limited(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& figures = solver.budgets.figures;
    const auto count = world.figures.size();
    bool any = false;
    for_each_table(world, [&](const auto& table) {
        for (Row row = 0; row < table.size(); ++row)
            // Blows of others give a figure energy; direct blocks never accept added energy.
            if (limits_turn(table, row) && table.figure[row] < count && !world.figures[table.figure[row]].collides &&
                !moves_any(solver.blocks, world, table.members[row])) {
                if (!any) figures.assign(count, {});
                any = figures[table.figure[row]].passive = true;
            }
    });
    return any;
}

} // namespace

/// Allocates only in worlds with angles.
template <int D, class Real> void make_room_for_budgets(World<D, Real>& world, Solver<D, Real>& solver) {
    bool any = false;
    for_each_table(world, [&]<class Table>(const Table& table) {
        any = any || (Table::Kind::length_power == 0 && table.size() > 0);
    });
    if (!any) return;
    solver.budgets.figures.resize(world.figures.size());
    solver.budgets.carried.reserve(world.pins.size());
}

template <int D, class Real> void find_passive(World<D, Real>& world, Solver<D, Real>& solver) {
    const auto& p = world.particles;
    auto& [figures, carried, any] = solver.budgets;
    any = find_limited(world, solver);
    if (!any) return;
    const auto is_not = [&](FigureIndex figure) {
        if (figure < figures.size()) figures[figure].passive = false;
    };
    for_each_table(world, [&](const auto& table) {
        for (Row row = 0; row < table.size(); ++row) {
            if (table.compliance[row] > Real(0) || table.gives(row) || table.motorized[row]) is_not(table.figure[row]);
            for (const Row member : table.members[row]) {
                if (p.figure[member] == table.figure[row]) continue;
                is_not(p.figure[member]);
                is_not(table.figure[row]);
            }
        }
    });
    for (const auto& pin : world.pins) // moving pins do an unknown amount of work
        if (const auto row = p.slots.find(pin.particle); row && pin.hard() && !(pin.from == pin.target))
            is_not(p.figure[*row]);
}

template <int D, class Real> void note_energy(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& [figures, carried, any] = solver.budgets;
    if (!any) return;
    const auto& p = world.particles;
    const auto& sweep_state = solver.sweep_state;
    for (auto& budget : figures) budget.before = 0;
    for (Row slot = 0; slot < sweep_state.size(); ++slot) {
        const auto figure = p.figure[sweep_state.row_of[slot]];
        const auto v = sweep_state.velocity_at(slot);
        if (figure < figures.size()) figures[figure].before += 0.5 * inertia_of(sweep_state, slot) * double(dot(v, v));
    }
    carried.clear();
    for (const auto& pinned : sweep_state.plan.pins) carried.push_back(sweep_state.velocity_at(pinned.slot));
}

namespace {

template <int D, class Real> void add_up(World<D, Real>& world, Solver<D, Real>& solver, Real h) {
    const auto& p = world.particles;
    const auto& sweep_state = solver.sweep_state;
    auto& figures = solver.budgets.figures;
    for (auto& budget : figures) {
        budget.after = budget.mass = 0;
        budget.momentum = {};
        budget.struck = budget.held = false;
    }
    for (Row slot = 0; slot < sweep_state.size(); ++slot) {
        const auto figure = p.figure[sweep_state.row_of[slot]];
        if (figure >= figures.size()) continue;
        auto& budget = figures[figure];
        const double m = inertia_of(sweep_state, slot);
        const auto v = cast<double>(sweep_state.velocity_at(slot));
        budget.held = budget.held || m == 0;
        budget.mass += m;
        budget.momentum += v * m;
        budget.after += 0.5 * m * dot(v, v);
    }
    for (std::size_t i = 0; i < sweep_state.plan.pins.size(); ++i) {
        const auto& pinned = sweep_state.plan.pins[i];
        const auto& pin = world.pins[pinned.pin];
        const auto figure = p.figure[sweep_state.row_of[pinned.slot]];
        if (pin.hard() || figure >= figures.size()) continue;
        auto& budget = figures[figure];
        budget.held = true;
        const auto impulse = pin.multiplier * inverse_or_zero(h);
        budget.before +=
            double(dot(impulse, (solver.budgets.carried[i] + sweep_state.velocity_at(pinned.slot)) * Real(0.5)));
    }
    for_each_table(world, [&](const auto& table) {
        for (Row row = 0; row < table.size(); ++row)
            if (table.multiplier[row] != Real(0) && limits_turn(table, row) && table.figure[row] < figures.size())
                figures[table.figure[row]].struck = true;
    });
}

} // namespace

template <int D, class Real> void take_back_gains(World<D, Real>& world, Solver<D, Real>& solver, Real h) {
    auto& [figures, carried, any] = solver.budgets;
    if (!any) return;
    add_up(world, solver, h);
    for (auto& budget : figures) {
        if (!budget.passive || !budget.struck || budget.after <= budget.before) continue;
        budget.drift = budget.held ? Vec<D, double>{} : budget.momentum * inverse_or_zero(budget.mass);
        const double drifting = 0.5 * budget.mass * dot(budget.drift, budget.drift);
        budget.keep = square_root(maximum(0.0, budget.before - drifting) * inverse_or_zero(budget.after - drifting));
    }
    auto& sweep_state = solver.sweep_state;
    for (Row slot = 0; slot < sweep_state.size(); ++slot) {
        const auto figure = world.particles.figure[sweep_state.row_of[slot]];
        if (figure >= figures.size() || !(figures[figure].keep < 1)) continue;
        const auto drift = cast<Real>(figures[figure].drift) * h;
        sweep_state.set_move(slot, drift + (sweep_state.move_at(slot) - drift) * Real(figures[figure].keep));
    }
    for (auto& budget : figures) budget.keep = 1;
}

#define SINEW_PASSIVE(D, Real)                                                                                         \
    template void make_room_for_budgets(World<D, Real>&, Solver<D, Real>&);                                            \
    template void find_passive(World<D, Real>&, Solver<D, Real>&);                                                     \
    template void note_energy(World<D, Real>&, Solver<D, Real>&);                                                      \
    template void take_back_gains(World<D, Real>&, Solver<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_PASSIVE)

} // namespace sinew
