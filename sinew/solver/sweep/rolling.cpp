#include "sinew/solver/phases.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

/// Turns of particles that roll, before and after a sweep.
namespace sinew {
namespace {

/// Marks the particles that some constraint holds.
template <int D, class Real> void mark_held(const World<D, Real>& world, std::vector<char>& is_held) {
    is_held.assign(world.particles.size(), 0);
    for_each_table(world, [&](const auto& table) {
        for (Row row = 0; row < table.size(); ++row)
            for (const Row member : table.members[row]) is_held[member] = 1;
    });
}

/// The vector times a factor, components within +-max: nothing overflows on the way.
template <class Vector, class Real> Vector product(const Vector& vector, Real factor, Real max) {
    return clamp_components(vector, max / factor) * factor;
}

template <class Real> constexpr Real most_turned = Real(1e6); ///< radians a step, whose square is finite

template <int D, class Real> void turn_on(Particles<D, Real>& p, Row row, const Vec<spins<D>, Real>& angle) {
    if (angle == Vec<spins<D>, Real>{}) return;
    p.turn.set(row, (collide::Rotation<D, Real>::by(angle) * p.turn[row]).normalized());
}

/// Particles that do not roll, or no longer, have no spin.
template <int D, class Real> void stop_others(Particles<D, Real>& p, std::span<const Row> rolling) {
    auto next = rolling.begin();
    for (Row row = 0; row < p.size(); ++row)
        if (next != rolling.end() && *next == row)
            ++next;
        else if (p.spin[row] != Vec<spins<D>, Real>{})
            p.spin.set(row, {});
}

} // namespace

template <int D, class Real> void find_rollers(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& p = world.particles;
    auto& [rows, is_held] = solver.sweep_state.rolling;
    rows.clear();
    rows.reserve(p.size()); // a particle torn away may roll
    SINEW_ASSERT(p.spin.size() == p.size() && p.turn.size() == p.size(), "the columns of a table have one length");
    for (Row row = 0; row < p.size(); ++row)
        if (p.radius[row] > Real(0) && p.inverse_mass[row] > Real(0) && p.rolls[row] != Rolls::never)
            rows.push_back(row);
    if (!rows.empty()) {
        mark_held(world, is_held);
        std::erase_if(rows, [&](Row row) { return p.rolls[row] == Rolls::loose && is_held[row]; });
    }
    stop_others(p, rows);
    if (rows.empty()) return;
    p.spin.set_apart(), p.turn.set_apart();
    solver.sweep_state.rollers.reserve(p.size());
}

template <int D, class Real> void begin_rolling(World<D, Real>& world, Solver<D, Real>& solver, Real h) {
    auto& state = solver.sweep_state;
    const auto& p = world.particles;
    state.rollers.clear();
    if (state.rolling.rows.empty()) return;
    state.rollers.resize(state.size());
    for (const Row row : state.rolling.rows)
        if (const Row slot = state.slot_of[row]; slot < state.size() && p.mobility[row] > Real(0))
            state.rollers[slot] = {.rim = clamp_components(p.spin[row] * (p.radius[row] * h), max_displacement(h)),
                                   .per_inertia = Real(1) / p.inertia[row]};
}

template <int D, class Real> void end_rolling(World<D, Real>& world, Solver<D, Real>& solver, Real dt) {
    auto& state = solver.sweep_state;
    auto& p = world.particles;
    for (const Row row : state.rolling.rows) {
        if (p.quarantined[row] || p.asleep[row]) continue;
        const Row slot = state.slot_of[row];
        if (slot >= state.size() || p.mobility[row] == Real(0)) {
            turn_on(p, row, product(p.spin[row], dt, most_turned<Real>));
            continue;
        }
        const auto& roller = state.rollers[slot];
        constexpr Real most = std::numeric_limits<Real>::max(); // per radius, of one that is nearly nothing
        const Real spins = min(state.per_h / p.radius[row], most), turns = min(Real(1) / p.radius[row], most);
        p.spin.set(row, product(roller.rim, spins, limit::speed<Real>));
        turn_on(p, row, product(roller.rolled, turns, most_turned<Real>));
    }
}

#define SINEW_ROLLING(D, Real)                                                                                         \
    template void find_rollers(World<D, Real>&, Solver<D, Real>&);                                                     \
    template void begin_rolling(World<D, Real>&, Solver<D, Real>&, Real);                                              \
    template void end_rolling(World<D, Real>&, Solver<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_ROLLING)

} // namespace sinew
