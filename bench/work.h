#pragma once

#include "sinew/solver/world.h"

#include <cstdint>
#include <span>
#include <vector>

/// What there is to solve, said in a way that every solver understands: points, and distances between them. Taken from
/// a world, so that whoever is compared with the engine gets the same particles and the same constraints.
namespace sinew::bench {

using Place = Vec<3, float>;  ///< given, to everyone alike
using Found = Vec<3, double>; ///< where a solver has brought it, as exact as it has it

struct Stick {
    std::uint32_t a = 0, b = 0;
    float rest = 0;
};

/// A distance of at least `least`: what keeps a limb from folding further.
struct Strut {
    std::uint32_t a = 0, b = 0;
    float least = 0;
};

struct Work {
    std::vector<Place> places, velocities;
    std::vector<float> inverse_masses; ///< 0: held where it is
    std::vector<Stick> sticks;         ///< in the order in which they were added
    std::vector<Strut> struts;
    Place gravity{};

    std::size_t constraints() const { return sticks.size() + struts.size(); }
};

/// Of a world of distances that are exact, at most (they count as exact: the textbook knows no slack) or at least.
/// To be asked before its first step.
template <class Real> Work work_of(const World<3, Real>& world);

/// How far sticks are from their lengths, as a fraction of them. Not a number if any place is none.
struct Strain {
    double max = 0;  ///< of a run: after any step
    double last = 0; ///< the worst after the last
    double mean = 0; ///< after the last
};
Strain strain_of(const Work& work, std::span<const Found> places);

} // namespace sinew::bench
