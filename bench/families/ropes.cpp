#include "sinew/prefab/rope.h"

#include "bench/cases.h"

#include <string>

namespace sinew::bench {
namespace {

constexpr int links = 20;

/// Ropes of 2 m released level, 1 kg per link, which swing down.
template <class Real> void hang(World<3, Real>& world, int ropes) {
    reserve(world, {.particles = std::size_t(ropes) * (links + 1), .constraints = std::size_t(ropes) * links});
    for (int i = 0; i < ropes; ++i)
        build(world, Rope{.segments = links, .angle = pi<double> / 2, .mass = links, .links = "exact"},
              "rope_" + std::to_string(i), {.at = {{0, 0, Real(0.1 * i)}}});
}

} // namespace

CaseFamily family::ropes() {
    return {.name = "ropes",
            .about = "SIZE ropes of 20 links, held at one end, released level",
            .sizes = {"10000"},
            .max = 1e6,
            .has_direct = true,
            .build_float = hang<float>,
            .build_double = hang<double>};
}

} // namespace sinew::bench
