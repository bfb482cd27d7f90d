#pragma once

#include "sinew/world/world.h"

#include <cstdint>
#include <span>
#include <vector>

/// A solver-neutral description of a world: points, and distances between points. Taken from a world of the engine, so
/// that every solver gets the same particles and constraints.
namespace sinew::bench {

using Position = Vec<3, float>; ///< initial position, identical for all solvers
using Found = Vec<3, double>;   ///< position found by a solver, in full precision

struct Stick {
    std::uint32_t a = 0, b = 0;
    double rest = 0; ///< in full precision: a stretch is measured against it
};

/// A distance of at least `min`: limits the folding of a limb.
struct Strut {
    std::uint32_t a = 0, b = 0;
    double min = 0;
};

struct Work {
    std::vector<Position> positions, velocities;
    std::vector<float> inverse_masses; ///< 0: pinned
    std::vector<Stick> sticks;         ///< in the order of addition
    std::vector<Strut> struts;
    Position gravity{};

    std::size_t constraints() const { return sticks.size() + struts.size(); }
};

/// Extracts the work from a world of exact distances, upper limits (treated as exact, because the textbook has no
/// inequality for slack) and lower limits. Call before the first step.
template <class Real> Work work_of(const World<3, Real>& world);

/// Relative deviation of sticks from the rest length: |length / rest - 1|. NaN if any position is not finite.
struct Strain {
    double max = 0;  ///< over a run: after any step
    double last = 0; ///< largest after the last step
    double mean = 0; ///< mean after the last step
};
Strain strain_of(const Work& work, std::span<const Found> positions);

} // namespace sinew::bench
