#pragma once

#include "sinew/solver/blade.h"
#include "sinew/solver/edit.h"
#include "sinew/solver/sever.h"

/// Cutting: what a blade crosses is removed, and what hangs on it. What is cut is found in time in proportion to the
/// world; the rest takes what the parts that are cut are worth, but that rows close up.
namespace sinew {

struct Cut {
    std::size_t links = 0;            ///< distances that are gone
    std::size_t doubled = 0;          ///< particles that were added, for flaps that come apart (split.h)
    std::vector<FigureIndex> figures; ///< whose they were, each once, in order; no_figure last
};

/// Cuts every distance that crosses the blade where its ends are seen. What is out of sight stays whole; so does a
/// distance that only keeps its ends apart. Cells of cloth are sliced along the blade.
template <int D, class Real> Cut cut(World<D, Real>& world, const Blade& blade, const Projection<D>& see = along_z<D>);

/// Cuts these constraints. With a distance goes what hangs on it: every constraint of another kind that both of its
/// ends belong to.
template <int D, class Real> Cut cut(World<D, Real>& world, std::span<const ConstraintId> ids);

/// What is drawn and what hangs together comes apart where links are gone. Returns how many particles were added.
template <int D, class Real>
std::size_t come_apart(World<D, Real>& world, std::span<const Ends> gone, const Slicer<D, Real>* slicer = nullptr);

} // namespace sinew
