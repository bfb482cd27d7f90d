#pragma once

#include "sinew/solver/changes.h"

#include <algorithm>

namespace sinew::detail {

/// Pinned hard and quarantined particles are immovable to the solver; the others weigh what they weigh.
template <int D, class Real> void refresh_mobility(World<D, Real>& world, Row row) {
    auto& particles = world.particles;
    const auto id = particles.slots.id_of(row);
    const bool pinned = std::any_of(world.pins.begin(), world.pins.end(),
                                    [&](const auto& pin) { return pin.particle == id && pin.hard(); });
    const Real mobility = pinned || particles.quarantined[row] ? Real(0) : particles.inverse_mass[row];
    if ((mobility > Real(0)) != (particles.mobility[row] > Real(0))) note_mobility(world, row);
    particles.mobility[row] = mobility;
}

} // namespace sinew::detail
