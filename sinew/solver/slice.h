#pragma once

#include "sinew/solver/blade.h"
#include "sinew/solver/sever.h"

namespace sinew {

/// Slices the cells of a cloth along a blade. Each part between its edges becomes a fragment: it keeps the corners on
/// its side and those that intact sides join to them; its other corners become virtual nodes, which bind() ties to what
/// the part hangs on. A part without a corner of its own is lost.
template <int D, class Real> class Slicer {
  public:
    /// All three are kept by reference; the bonds of the world are listed when cells are sliced.
    Slicer(const World<D, Real>& world, const Blade& blade, const Projection<D>& see);

    /// Whether the blade runs through a fragment, whatever it does to the links around.
    bool runs_through(const Figure& figure, const Piece& piece) const;
    /// Appends what is left of a cell.
    void slice(const Figure& figure, const Piece& cell, PiecesLeft& left) const;

  private:
    const World<D, Real>& world_;
    const Blade& blade_;
    const Projection<D>& see_;
    Vec2<double> along_; ///< direction of the blade
    double length_ = 0;
};

/// A fragment with its virtual nodes where they are now, bound to nothing.
template <int D, class Real>
void add_unbound(const World<D, Real>& world, const Figure& figure, const Piece& piece, PiecesLeft& left);

/// Binds the virtual nodes of all fragments to the particles around them.
template <int D, class Real> void bind(World<D, Real>& world);

} // namespace sinew
