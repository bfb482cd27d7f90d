#pragma once

#include "sinew/solver/batch/adjacency.h"

/// Triangles of a component's rigid links, unfolded into the plane: the third corners beyond an edge. Particles with a
/// common list of links share the corners, too, up to a limit.
namespace sinew::detail {

/// Point given by its distances from both ends of an edge: coordinates along the edge and perpendicular.
struct Beside {
    double along, beside;

    static Beside of(double to_a, double to_b, double length) {
        const double along = (to_a * to_a - to_b * to_b + length * length) / (2 * length);
        return {along, square_root(max(to_a * to_a - along * along, 0.0))};
    }
    /// Distance to a point on the other side of the edge, in the plane; huge if the line misses the edge.
    double across(const Beside& other, double length) const {
        constexpr double nowhere = 1e300;
        if (!(beside + other.beside > 0)) return nowhere;
        const double crossing = along + (other.along - along) * beside / (beside + other.beside);
        if (!(crossing >= 0 && crossing <= length)) return nowhere;
        return square_root(square(other.along - along) + square(beside + other.beside));
    }
};

template <int D, class Real> class UnfoldedTriangles {
  public:
    struct Corner {
        std::uint32_t spoke; ///< index of the spoke to the corner, at the edge's first end
        Beside position;
    };

    explicit UnfoldedTriangles(const Adjacency<D, Real>& spokes) : spokes_(spokes) {}

    /// Starts over; call after listing the spokes.
    void begin() {
        known_.clear();
        first_.assign(std::min(spokes_.size(), max), none);
        shared_.clear();
    }
    /// UnfoldedTriangles beyond the edge from particle s along spoke number `spoke`. Valid until the next call.
    std::span<const Corner> beyond(std::uint32_t s, std::size_t spoke) {
        const auto near = spokes_.of(s);
        const auto edge = s + near[spoke].offset;
        const auto at = spokes_.number_of(near[spoke]);
        const auto other = spokes_.list_of(edge);
        if (at < first_.size())
            for (auto i = first_[at]; i != none; i = known_[i].next)
                if (known_[i].other == other) return std::span(shared_).subspan(known_[i].first, known_[i].count);
        found_.clear();
        for (const auto& [further, side] : spokes_.of(edge))
            if (const auto* third = Adjacency<D, Real>::find(near, near[spoke].offset + further))
                found_.push_back({std::uint32_t(third - near.data()),
                                  Beside::of(double(third->length), double(side), double(near[spoke].length))});
        if (at >= first_.size() || shared_.size() + found_.size() > max) return found_;
        known_.push_back({.other = other,
                          .next = first_[at],
                          .first = std::uint32_t(shared_.size()),
                          .count = std::uint32_t(found_.size())});
        first_[at] = std::uint32_t(known_.size() - 1);
        shared_.insert(shared_.end(), found_.begin(), found_.end());
        return found_;
    }

  private:
    static constexpr auto none = ~std::uint32_t(0);
    static constexpr std::size_t max = 1 << 12;

    struct Known {
        std::uint32_t other; ///< list of the edge's second end
        std::uint32_t next;  ///< next entry with the same spoke, or none
        std::uint32_t first, count;
    };
    const Adjacency<D, Real>& spokes_;
    std::vector<std::uint32_t> first_; ///< first entry by spoke
    std::vector<Known> known_;
    std::vector<Corner> shared_, found_;
};

} // namespace sinew::detail
