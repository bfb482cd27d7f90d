#pragma once

#include "sinew/topology/blade.h"
#include "sinew/topology/split_pieces.h"

namespace sinew {

/// Slices the cells of a cloth along a blade. The part on each side becomes a fragment, with the particle corners on
/// this side and any particle joined to one of them by an intact side of the cell; the other corners become virtual
/// nodes, bound to particles by bind(). A part without any particle corner is lost.
template <int D, class Real> class Slicer {
  public:
    /// Keeps references to all three; slice() requires listed bonds.
    Slicer(const World<D, Real>& world, const Blade& blade, const Projection<D>& see);

    /// True if the blade runs through a fragment, even without cutting links.
    bool runs_through(const Figure& figure, const Piece& piece) const;
    /// Appends the remaining parts of a cell.
    void slice(const Figure& figure, const Piece& cell, PiecesLeft& left) const;

  private:
    const World<D, Real>& world_;
    const Blade& blade_;
    const Projection<D>& see_;
    Vec2<double> along_; ///< direction of the blade
    double length_ = 0;
};

/// Appends a fragment with unbound virtual nodes at the present positions.
template <int D, class Real>
void add_unbound(const World<D, Real>& world, const Figure& figure, const Piece& piece, PiecesLeft& left);

/// Binds the virtual nodes of all fragments to the particles around.
template <int D, class Real> void bind(World<D, Real>& world);

} // namespace sinew
