#pragma once

#include "sinew/solver/phases.h"

#include <span>

namespace sinew::detail {

/// Velocities of a body that changes hands. Those of blocks are at the end of a substep, those of the sweep in its
/// middle: the body would gain or lose half of what the forces add in a substep. What holds a body does no work: its
/// kinetic energy changes by that of the forces. `near`: the sweep takes over.
template <int D, class Real> void hand_over(World<D, Real>& world, std::span<const Row> rows, bool near, bool is_held) {
    auto& p = world.particles;
    const Real time = world.last_substep * Real(near ? -0.5 : 0.5);
    const auto each = [&](auto&& visit) {
        for (const Row row : rows)
            if ((p.near[row] != 0) != near && p.mobility[row] > Real(0))
                visit(p.velocity[row], forcing_on(world, row).acceleration, 1 / double(p.inverse_mass[row]));
    };
    if (!is_held)
        return each([&](auto& velocity, const auto& acceleration, double) { velocity += acceleration * time; });
    double kinetic = 0, power = 0;
    each([&](const auto& velocity, const auto& acceleration, double mass) {
        kinetic += 0.5 * mass * double(dot(velocity, velocity));
        power += mass * double(dot(acceleration, velocity));
    });
    const double share = square_root(max(1 + power * double(time) * inverse_or_zero(kinetic), 0.0));
    each([&](auto& velocity, const auto&, double) { velocity *= Real(share); });
}

} // namespace sinew::detail
