#pragma once

#include "sinew/world/world.h"

namespace sinew {

template <int D, class Real> bool any_asleep(const Particles<D, Real>& particles) {
    return particles.asleep.any_of([](char flag) { return flag != 0; });
}

template <int D, class Real> bool any_near(const Particles<D, Real>& particles) {
    return particles.near.any_of([](char flag) { return flag != 0; });
}

/// True if the particle of a slot is asleep.
template <int D, class Real> bool is_asleep(const Particles<D, Real>& particles, std::uint32_t slot) {
    return particles.handles.in_use(slot) && particles.asleep[particles.handles.row_at(slot)] != 0;
}

} // namespace sinew
