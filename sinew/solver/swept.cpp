#include "sinew/solver/phases.h"

namespace sinew {

template <int D, class Real> void take_up(World<D, Real>& world, Real h) {
    const auto& p = world.particles;
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
    const Real furthest = furthest_move(h);
    Real largest = 0;
    bool any_force = false;
    for (Row slot = 0; slot < swept.size(); ++slot) {
        const Row row = swept.row_of[slot];
        swept.put(swept.place, slot, p.position[row]);
        swept.put(swept.move, slot, clamp_components(p.velocity[row] * h, furthest));
        swept.put(swept.residual, slot, p.residual[row]);
        swept.mobility[slot] = p.mobility[row] > Real(0) ? p.inverse_mass[row] : Real(0);
        swept.inverse_mass[slot] = swept.mobility[slot];
        largest = maximum(largest, p.radius[row]);
        any_force = any_force || p.force[row] != Vec<D, Real>{};
    }
    swept.largest_radius = largest;
    swept.any_force = any_force;
    swept.everyone_alike = swept.everyone_alike && !any_force;
}

template <int D, class Real> void put_back(World<D, Real>& world) {
    auto& p = world.particles;
    const auto& swept = world.swept;
    for (Row slot = 0; slot < swept.size(); ++slot) {
        const Row row = swept.row_of[slot];
        p.position[row] = swept.place_at(slot);
        p.velocity[row] = swept.velocity_at(slot);
        p.residual[row] = swept.residual_at(slot);
        p.mobility[row] = swept.mobility[slot];
    }
}

#define SINEW_SWEPT(D, Real)                                                                                           \
    template void take_up(World<D, Real>&, Real);                                                                      \
    template void put_back(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_SWEPT)

} // namespace sinew
