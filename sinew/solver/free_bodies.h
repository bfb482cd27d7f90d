#pragma once

#include "sinew/math/moments.h"

#include <cstdint>
#include <vector>

namespace sinew {

/// Connected swept particles without pins, ports or immovable particles.
template <int D> struct FreeBody {
    std::uint32_t first = 0, members = 0; ///< slots from the first on; scattered: range of FreeBodies::slots
    bool scattered = false;
    bool lossless = true; ///< neither springs nor motors: constraints never add energy
    bool near = false;    ///< contacts may act on it
    // Room for a step.
    bool meets = false;           ///< near enough to touch something in this step
    bool held = false;            ///< touches a plane, or an immovable particle
    Vec<spins<D>, double> spin{}; ///< angular momentum about the centre due at the end, per mass
    double square = 0;            ///< largest mean square of the velocity about the centre due at the end
};

/// Derived from the rest of the world.
template <int D> struct FreeBodies {
    std::vector<FreeBody<D>> list;    ///< by the first slot
    std::vector<std::uint32_t> slots; ///< of scattered bodies
    std::vector<char> touched;        ///< by slot: met a plane in this step; empty without planes

    std::uint32_t first_of(const FreeBody<D>& body) const { return body.scattered ? slots[body.first] : body.first; }
    void clear() {
        list.clear();
        slots.clear();
    }
    void reserve(std::size_t particles) {
        list.reserve(particles / 2 + 1);
        slots.reserve(particles);
        touched.reserve(particles);
    }
};

} // namespace sinew
