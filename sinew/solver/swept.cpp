#include "sinew/solver/kernel.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/world.h"

#include <algorithm>

namespace sinew {

namespace {

/// True if an external force acts on a swept particle.
template <int D, class Real> bool any_force(const World<D, Real>& world) {
    const auto& p = world.particles;
    return p.any_force && std::any_of(world.swept.row_of.begin(), world.swept.row_of.end(),
                                      [&](Row row) { return p.force[row] != Vec<D, Real>{}; });
}

/// Prefetch. Copies of a shape are contiguous in memory but gathered across copies, a pattern no prefetcher foresees;
/// so the rows are first touched in memory order, a byte per cache line.
template <int D, class Real, class... T>
void read_through(const Swept<D, Real>& swept, Row first, Row last, const std::vector<T>&... columns) {
    constexpr Row near = 4;
    constexpr std::size_t line = 64;
    if (last - first < 2 || swept.row_of[first + 1] <= swept.row_of[first] + near) return;
    const Row begin = swept.row_of[first], end = swept.row_of[last - 1] + 1;
    if (end - begin != last - first) return;
    const auto read = [&](const auto& column) {
        const volatile char* const bytes = reinterpret_cast<const char*>(column.data() + begin);
        for (std::size_t at = 0; at < (end - begin) * sizeof column[0]; at += line) (void)bytes[at];
    };
    (read(columns), ...);
}

template <int D, class Real>
Turning<D, Real> turning(const Swept<D, Real>& swept, std::vector<Vec<D, Real>>& rows, Real* columns) {
    static_assert(sizeof rows[0] == D * sizeof(Real));
    Turning<D, Real> all{};
    all.rows = rows.data()->component.data();
    all.columns = columns, all.apart = swept.apart();
    all.row_of = swept.row_of.data(), all.slot_of_last = swept.slot_of.back();
    return all;
}

} // namespace

template <int D, class Real> void begin_sweep(World<D, Real>& world, Real h) {
    auto& swept = world.swept;
    swept.per_h = Real(1) / h;
    swept.gravity = {};
    swept.everyone_alike = true;
    for (const auto& force : world.forces)
        if (const auto* gravity = std::get_if<Gravity<D, Real>>(&force))
            swept.gravity += clamp_components(gravity->acceleration, largest_acceleration<Real>);
        else if (!std::holds_alternative<RandomPush<D, Real>>(force))
            swept.everyone_alike = false;
    swept.gravity = clamp_components(swept.gravity, largest_acceleration<Real>);
    swept.any_force = any_force(world);
    swept.everyone_alike = swept.everyone_alike && !swept.any_force;
    swept.any_pin_moves = swept.any_pin_soft = false;
    for (const auto& pin : world.pins) {
        swept.any_pin_moves = swept.any_pin_moves || pin.from != pin.target;
        swept.any_pin_soft = swept.any_pin_soft || !pin.hard();
    }
    swept.largest_radius = 0;
    if (!has_walls(world)) return;
    for (const Row row : swept.row_of)
        swept.largest_radius = maximum(swept.largest_radius, world.particles.radius[row]);
}

template <int D, class Real> void take_up(World<D, Real>& world, Real h, Row first, Row last) {
    auto& p = world.particles;
    auto& swept = world.swept;
    if (first == last) return;
    const auto& kernel = kernels<D, Real>();
    read_through(swept, first, last, p.position, p.residual, p.velocity, p.mobility);
    kernel.to_columns(turning(swept, p.position, swept.place[0]), first, last);
    kernel.to_columns(turning(swept, p.residual, swept.residual[0]), first, last);
    auto moves = turning(swept, p.velocity, swept.move[0]);
    moves.by = h, moves.most = furthest_move(h);
    kernel.to_columns(moves, first, last);
    const Row* const row_of = swept.row_of.data();
    const Real* const from = p.mobility.data();
    Real* const to = swept.mobility;
#pragma GCC unroll 4
    for (Row slot = first; slot < last; ++slot) to[slot] = from[row_of[slot]];
}

template <int D, class Real> void put_back(World<D, Real>& world, Row first, Row last) {
    auto& p = world.particles;
    auto& swept = world.swept;
    const auto& kernel = kernels<D, Real>();
    kernel.to_rows(turning(swept, p.position, swept.place[0]), first, last);
    kernel.to_rows(turning(swept, p.residual, swept.residual[0]), first, last);
    auto moves = turning(swept, p.velocity, swept.move[0]);
    moves.by = swept.per_h;
    kernel.to_rows(moves, first, last);
}

#define SINEW_SWEPT(D, Real)                                                                                           \
    template void begin_sweep(World<D, Real>&, Real);                                                                  \
    template void take_up(World<D, Real>&, Real, Row, Row);                                                            \
    template void put_back(World<D, Real>&, Row, Row);
SINEW_INSTANTIATE(SINEW_SWEPT)

} // namespace sinew
