#pragma once

#include "sinew/topology/blade.h"
#include "sinew/topology/split_pieces.h"
#include "sinew/world/edit.h"

/// Cutting: removes the distances crossed by a blade, with their dependents. Crossed distances are found in time
/// proportional to the world; the rest is proportional to the parts cut, except for the compaction of rows and the
/// splitting of cloth (topology/vertex_split.h).
namespace sinew {

struct Cut {
    std::size_t links = 0;            ///< distances removed
    std::size_t new_particles = 0;    ///< particles added where flaps come apart (topology/vertex_split.h)
    std::vector<FigureIndex> figures; ///< figures of the distances removed, sorted and unique; no_figure last
};

/// Cuts every distance across the blade, or within radius of the blade, in the picture plane. Links with an end out of
/// sight stay, and so do distances without an upper limit. Cells of cloth are sliced along the blade.
template <int D, class Real> Cut cut(World<D, Real>& world, const Blade& blade, const Projection<D>& see = along_z<D>);

/// Cuts the given constraints. With a distance go its dependents: constraints of other kinds with both of its ends
/// among their members.
template <int D, class Real> Cut cut(World<D, Real>& world, std::span<const ConstraintId> ids);

/// Separates drawn pieces and cloth at removed links. Returns the number of particles added.
template <int D, class Real>
std::size_t come_apart(World<D, Real>& world, std::span<const Ends> gone, const Slicer<D, Real>* slicer = nullptr);

} // namespace sinew
