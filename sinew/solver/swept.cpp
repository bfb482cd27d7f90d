#include "sinew/solver/phases.h"
#include "sinew/solver/swept_rows.h"

namespace sinew {

namespace {

/// Whether a force acts on one of the particles of the sweep.
template <int D, class Real> bool any_force(const World<D, Real>& world) {
    const auto& forces = world.particles.force;
    if (!any_strikes(forces)) return false;
    return std::any_of(world.swept.row_of.begin(), world.swept.row_of.end(),
                       [&](Row row) { return forces[row] != Vec<D, Real>{}; });
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
    swept.largest_radius = 0;
    if (world.bounds.empty()) return;
    for (const Row row : swept.row_of)
        swept.largest_radius = maximum(swept.largest_radius, world.particles.radius[row]);
}

template <int D, class Real> void take_up(World<D, Real>& world, Real h, Row first, Row last) {
    const auto& p = world.particles;
    auto& swept = world.swept;
    const Real furthest = furthest_move(h);
    each_row(swept, first, last, [&](Row row, Row slot) {
        swept.put(swept.place, slot, p.position[row]);
        swept.put(swept.move, slot, clamp_components(p.velocity[row] * h, furthest));
        swept.put(swept.residual, slot, p.residual[row]);
        swept.mobility[slot] = p.mobility[row] > Real(0) ? p.inverse_mass[row] : Real(0);
        swept.inverse_mass[slot] = swept.mobility[slot];
    });
}

template <int D, class Real> void put_back(World<D, Real>& world, Row first, Row last) {
    auto& p = world.particles;
    const auto& swept = world.swept;
    each_row(swept, first, last, [&](Row row, Row slot) {
        p.position[row] = swept.place_at(slot);
        p.velocity[row] = swept.velocity_at(slot);
        p.residual[row] = swept.residual_at(slot);
        if (p.mobility[row] != swept.mobility[slot]) p.mobility[row] = swept.mobility[slot];
    });
}

#define SINEW_SWEPT(D, Real)                                                                                           \
    template void begin_sweep(World<D, Real>&, Real);                                                                  \
    template void take_up(World<D, Real>&, Real, Row, Row);                                                            \
    template void put_back(World<D, Real>&, Row, Row);
SINEW_INSTANTIATE(SINEW_SWEPT)

} // namespace sinew
