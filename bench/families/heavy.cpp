#include "sinew/prefab/rope.h"

#include "bench/cases.h"

namespace sinew::bench {
namespace {

constexpr int links = 100;

/// 10 m of rope, 1 kg per link, and a weight of `weight` links at the end.
template <class Real> void hang(World<3, Real>& world, int weight) {
    build(world, Rope{.length = 10, .segments = links, .mass = links, .weight = double(weight), .links = "exact"},
          "rope");
}

} // namespace

CaseFamily family::heavy() {
    return {.name = "heavy",
            .about = "a rope of 100 links that hangs, a weight of SIZE links on its end",
            .sizes = {},
            .max = 1e9,
            .has_direct = true,
            .build_float = hang<float>,
            .build_double = hang<double>};
}

} // namespace sinew::bench
