#pragma once

#include "sinew/sinew.h"

#include <array>
#include <string>
#include <string_view>

/// Cases of `sinew bench rope`: 10 m of rope, 1 kg per link, weights counted in links.
namespace sinew::cli {

struct RopeCase {
    std::string name = "rope"; ///< "rope", or a name in rope_cases
    int links = 0;
    double weight = 0; ///< in links; for the ragdoll in masses of the ragdoll
    std::string start; ///< hang or level
    std::string precision;
    int threads = 1;
};

inline constexpr int many_ropes = 1000; ///< number of ropes in the case `ropes`

/// Cases beside the plain rope.
struct RopeExample {
    std::string_view name;
    int links;
    double weight;
    std::string_view start, about;
};
inline constexpr std::array<RopeExample, 6> rope_cases = {{
    {"pinned", 100, 1000, "level", "both ends held, the weight in the middle"},
    {"tree", 100, 1000, "level", "a Y of three arms, a weight on two of them"},
    {"necklace", 100, 1000, "level", "a closed ring, held at one link, the weight opposite"},
    {"bridge", 50, 1000, "level", "planks between two banks, the load in the middle"},
    {"ragdoll", 0, 1000, "hang", "on one hand, a weight in the other"},
    {"ropes", 50, 100000, "level", "a thousand ropes, weights from 1 to this"},
}};

/// World of a case. `scale` is set to total weight times length, the unit of energies.
template <class Real> World<2, Real> world_of(const RopeCase& rope, double& scale);

} // namespace sinew::cli
