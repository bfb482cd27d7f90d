#pragma once

#include "sinew/math/sort.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sinew {

/// A piece with a depth and an outline group. Pieces of one group are consecutive and share one outline.
struct DrawItem {
    const Piece* piece = nullptr;
    float depth = 0;
    std::uint32_t group = 0;
};

/// Painter's order of a figure's visible pieces. 3D: back to front by depth; consecutive pieces of one part with the
/// same particles form a group. 2D: in the order of construction; connected pieces of one part form a group.
template <class WorldT> class DrawOrder {
  public:
    /// Keeps a reference to the world.
    explicit DrawOrder(const WorldT& world) : world_(world) {}

    /// `is_hidden(piece)` and `depth_of(piece)` classify a piece; `depth_of` is called in 3D only.
    template <class Hidden, class Depth>
    const std::vector<DrawItem>& of(const Figure& figure, Hidden&& is_hidden, Depth&& depth_of) {
        pieces_.clear();
        for (const auto& piece : figure.pieces)
            if (!is_hidden(piece))
                pieces_.push_back(
                    {&piece, WorldT::dimension == 3 ? depth_of(piece) : 0, std::uint32_t(pieces_.size())});
        if (WorldT::dimension == 3) {
            sinew::stable_sort(pieces_.begin(), pieces_.end(),
                               [](const DrawItem& a, const DrawItem& b) { return a.depth > b.depth; });
            group_alike();
        } else {
            group();
        }
        return pieces_;
    }

  private:
    void group_alike() {
        for (std::size_t i = 1; i < pieces_.size(); ++i) {
            const Piece &piece = *pieces_[i].piece, &before = *pieces_[i - 1].piece;
            if (piece.part == before.part && piece.particles == before.particles)
                pieces_[i].group = pieces_[i - 1].group;
        }
    }

    void group() {
        constexpr auto none = std::uint32_t(-1);
        group_of_row_.assign(world_.particles.size(), none);
        for (std::size_t i = 0, run = 0; i < pieces_.size(); ++i) {
            if (pieces_[i].piece->part != pieces_[run].piece->part) run = i;
            for (const auto id : pieces_[i].piece->particles) {
                const auto row = row_of(world_, id);
                if (!row) continue;
                auto& known = group_of_row_[*row];
                if (known != none && known >= run) join(run, i, pieces_[i].group, known);
                known = pieces_[i].group;
            }
        }
        sinew::stable_sort(pieces_.begin(), pieces_.end(),
                           [](const DrawItem& a, const DrawItem& b) { return a.group < b.group; });
    }

    /// Merges two groups of a run.
    void join(std::size_t run, std::size_t i, std::uint32_t a, std::uint32_t b) {
        if (a == b) return;
        const auto into = std::min(a, b), gone = std::max(a, b);
        for (std::size_t k = run; k <= i; ++k) {
            if (pieces_[k].group != gone) continue;
            pieces_[k].group = into;
            for (const auto id : pieces_[k].piece->particles)
                if (const auto row = row_of(world_, id); row && group_of_row_[*row] == gone) group_of_row_[*row] = into;
        }
    }

    const WorldT& world_;
    std::vector<DrawItem> pieces_;
    std::vector<std::uint32_t> group_of_row_;
};

} // namespace sinew
