#pragma once

#include "sinew/assert/assert.h"
#include "sinew/world/changes.h"

#include <algorithm>

namespace sinew::detail {

/// Updates the mobility of a particle: 0 if pinned hard or quarantined, otherwise the inverse mass.
template <int D, class Real> void refresh_mobility(World<D, Real>& world, Row row) {
    auto& particles = world.particles;
    SINEW_ASSERT(row < particles.size(), "the row is in the table");
    const auto id = particles.handles.id_of(row);
    const bool pinned = std::any_of(world.pins.begin(), world.pins.end(),
                                    [&](const auto& pin) { return pin.particle == id && pin.hard(); });
    const Real mobility = pinned || particles.quarantined[row] ? Real(0) : particles.inverse_mass[row];
    if ((mobility > Real(0)) != (particles.mobility[row] > Real(0))) note_mobility(world, row);
    particles.mobility[row] = mobility;
}

} // namespace sinew::detail
