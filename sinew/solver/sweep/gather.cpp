#include "sinew/solver/phases.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/sweep/crumpling.h"
#include "sinew/world/slack_links.h"
#include "sinew/world/world.h"

#include <algorithm>

namespace sinew {

namespace {

/// True if an external force acts on a swept particle.
template <int D, class Real> bool any_force(const World<D, Real>& world, const SweepState<D, Real>& sweep_state) {
    const auto& p = world.particles;
    return p.any_force && std::any_of(sweep_state.row_of.begin(), sweep_state.row_of.end(),
                                      [&](Row row) { return p.force[row] != Vec<D, Real>{}; });
}

template <int D, class Real>
Transposition<D, Real> turning(const SweepState<D, Real>& sweep_state, std::vector<Vec<D, Real>>& rows, Real* columns) {
    static_assert(sizeof rows[0] == D * sizeof(Real));
    Transposition<D, Real> all{};
    all.rows = rows.data()->component.data();
    all.columns = columns, all.stride = sweep_state.stride();
    all.row_of = sweep_state.row_of.data(), all.slot_of_last = sweep_state.slot_of.back();
    return all;
}

/// Fading lengths of the legs of springs, by their present limits.
template <int D, class Real> void measure_bend_legs(const World<D, Real>& world, SweepState<D, Real>& sweep_state) {
    const auto& links = std::get<kind_number<Distance, D>>(world.constraints);
    const auto& bends = std::get<kind_number<Angle, D>>(world.constraints);
    const auto& bend_links = sweep_state.plan.bend_links;
    sweep_state.bend_legs.resize(bend_links.size());
    for (Row row = 0; row < bend_links.size(); ++row)
        for (std::size_t i = 0; i < 2; ++i) {
            const bool shrinks = !bends.is_rigid(row) && bend_links[row][i] != Plan<Real>::no_link;
            sweep_state.bend_legs[row][i] = shrinks ? Real(fading_length(links, bend_links[row][i])) : Real(0);
        }
}

} // namespace

template <int D, class Real> void begin_sweep(World<D, Real>& world, Solver<D, Real>& solver, Real h) {
    auto& sweep_state = solver.sweep_state;
    sweep_state.per_h = Real(1) / h;
    sweep_state.gravity = {};
    sweep_state.everyone_alike = true;
    for (const auto& force : world.forces)
        if (const auto* gravity = std::get_if<Gravity<D, Real>>(&force))
            sweep_state.gravity += clamp_components(gravity->acceleration, largest_acceleration<Real>);
        else if (!std::holds_alternative<RandomPush<D, Real>>(force))
            sweep_state.everyone_alike = false;
    sweep_state.gravity = clamp_components(sweep_state.gravity, largest_acceleration<Real>);
    sweep_state.any_force = any_force(world, sweep_state);
    sweep_state.everyone_alike = sweep_state.everyone_alike && !sweep_state.any_force;
    sweep_state.any_pin_moves = sweep_state.any_pin_soft = false;
    for (const auto& pin : world.pins) {
        sweep_state.any_pin_moves = sweep_state.any_pin_moves || pin.from != pin.target;
        sweep_state.any_pin_soft = sweep_state.any_pin_soft || !pin.hard();
    }
    detail::Crumpling<D, Real>(world, sweep_state).find();
    measure_bend_legs(world, sweep_state);
    auto& bodies = sweep_state.bodies;
    for (auto& body : bodies.list)
        body.meets = body.near && meets_others(solver, sweep_state.row_of[bodies.first_of(body)]);
    bodies.touched.assign(!has_walls(world) || bodies.list.empty() ? 0 : sweep_state.size(), 0);
    sweep_state.largest_radius = 0;
    if (!has_walls(world)) return;
    sweep_state.blows.resize(sweep_state.size());
    for (const Row row : sweep_state.row_of)
        sweep_state.largest_radius = max(sweep_state.largest_radius, world.particles.radius[row]);
}

template <int D, class Real> void gather(World<D, Real>& world, Solver<D, Real>& solver, Real h, Row first, Row last) {
    auto& p = world.particles;
    auto& sweep_state = solver.sweep_state;
    if (first == last) return;
    const auto& kernel = kernels<D, Real>(solver.options.simd);
    kernel.to_columns(turning(sweep_state, p.position, sweep_state.position[0]), first, last);
    kernel.to_columns(turning(sweep_state, p.residual, sweep_state.residual[0]), first, last);
    auto moves = turning(sweep_state, p.velocity, sweep_state.displacement[0]);
    moves.by = h, moves.max = max_displacement(h);
    kernel.to_columns(moves, first, last);
    const Row* const row_of = sweep_state.row_of.data();
    const Real* const from = p.mobility.data();
    Real* const to = sweep_state.mobility;
#pragma GCC unroll 4
    for (Row slot = first; slot < last; ++slot) to[slot] = from[row_of[slot]];
}

template <int D, class Real> void scatter(World<D, Real>& world, Solver<D, Real>& solver, Row first, Row last) {
    auto& p = world.particles;
    auto& sweep_state = solver.sweep_state;
    const auto& kernel = kernels<D, Real>(solver.options.simd);
    kernel.to_rows(turning(sweep_state, p.position, sweep_state.position[0]), first, last);
    kernel.to_rows(turning(sweep_state, p.residual, sweep_state.residual[0]), first, last);
    auto moves = turning(sweep_state, p.velocity, sweep_state.displacement[0]);
    moves.by = sweep_state.per_h, moves.max = limit::speed<Real>; // rebounds come after displacements are bounded
    kernel.to_rows(moves, first, last);
}

#define SINEW_SWEPT(D, Real)                                                                                           \
    template void begin_sweep(World<D, Real>&, Solver<D, Real>&, Real);                                                \
    template void gather(World<D, Real>&, Solver<D, Real>&, Real, Row, Row);                                           \
    template void scatter(World<D, Real>&, Solver<D, Real>&, Row, Row);
SINEW_INSTANTIATE(SINEW_SWEPT)

} // namespace sinew
