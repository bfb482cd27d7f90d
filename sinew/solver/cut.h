#pragma once

#include "sinew/solver/edit.h"

/// Cutting: what a blade crosses is removed, and what hangs on it. What is cut is found in time in proportion to the
/// world; the rest takes what the parts that are cut are worth, but that rows close up.
namespace sinew {

/// A straight cut across a picture plane.
struct Blade {
    Vec2<double> from{}, to{};
    double reach = 0; ///< what comes as near to it is cut too
};

struct Cut {
    std::size_t links = 0;            ///< distances that are gone
    std::size_t doubled = 0;          ///< particles that were added, for flaps that come apart (split.h)
    std::vector<FigureIndex> figures; ///< whose they were, each once, in order; no_figure last
};

/// Where every particle is in the plane of the screen, by row: (x, y).
template <int D, class Real> std::vector<Vec2<double>> flat_places(const World<D, Real>& world);

/// Cuts every distance that crosses the blade where `places` show its ends, one place a particle, by row. What is not
/// finite is out of sight and stays whole; so does a distance that only keeps its ends apart.
template <int D, class Real> Cut cut(World<D, Real>& world, const Blade& blade, std::span<const Vec2<double>> places);
template <int D, class Real> Cut cut(World<D, Real>& world, const Blade& blade) {
    return cut(world, blade, std::span<const Vec2<double>>(flat_places(world)));
}

/// Cuts these constraints. With a distance goes what hangs on it: every constraint of another kind that both of its
/// ends belong to.
template <int D, class Real> Cut cut(World<D, Real>& world, std::span<const ConstraintId> ids);

} // namespace sinew
