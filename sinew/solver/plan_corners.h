#pragma once

#include "sinew/solver/plan_spokes.h"

/// The triangles of a sheet's rigid links, laid flat: what lies beyond an edge of two particles. Where particles share
/// lists of their links they share these, too, up to a certain number.
namespace sinew::detail {

/// Where something is that is so far from both ends of an edge: along it, and beside it.
struct Beside {
    double along, beside;

    static Beside of(double to_a, double to_b, double length) {
        const double along = (to_a * to_a - to_b * to_b + length * length) / (2 * length);
        return {along, square_root(maximum(to_a * to_a - along * along, 0.0))};
    }
    /// How far it is from what is on the other side of the edge, and in its plane.
    double across(const Beside& other, double length) const {
        constexpr double nowhere = 1e300;
        if (!(beside + other.beside > 0)) return nowhere;
        const double crossing = along + (other.along - along) * beside / (beside + other.beside);
        if (!(crossing >= 0 && crossing <= length)) return nowhere;
        return square_root(square(other.along - along) + square(beside + other.beside));
    }
};

template <int D, class Real> class Corners {
  public:
    struct Corner {
        std::uint32_t spoke; ///< to it, of the first end of the edge
        Beside place;
    };

    explicit Corners(const Spokes<D, Real>& spokes) : spokes_(spokes) {}

    /// After the spokes have been listed.
    void begin() {
        known_.clear();
        first_.assign(std::min(spokes_.size(), most), none);
        shared_.clear();
    }
    /// Beyond the edge from particle s along its spoke `spoke`. Good until the next are asked for.
    std::span<const Corner> beyond(std::uint32_t s, std::size_t spoke) {
        const auto near = spokes_.of(s);
        const auto edge = s + near[spoke].apart;
        const auto at = spokes_.number_of(near[spoke]);
        const auto other = spokes_.list_of(edge);
        if (at < first_.size())
            for (auto i = first_[at]; i != none; i = known_[i].next)
                if (known_[i].other == other) return std::span(shared_).subspan(known_[i].first, known_[i].count);
        found_.clear();
        for (const auto& [further, side] : spokes_.of(edge))
            if (const auto* third = Spokes<D, Real>::find(near, near[spoke].apart + further))
                found_.push_back({std::uint32_t(third - near.data()),
                                  Beside::of(double(third->length), double(side), double(near[spoke].length))});
        if (at >= first_.size() || shared_.size() + found_.size() > most) return found_;
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
    static constexpr std::size_t most = 1 << 12;

    struct Known {
        std::uint32_t other; ///< the list of the edge's far end
        std::uint32_t next;  ///< of the same spoke
        std::uint32_t first, count;
    };
    const Spokes<D, Real>& spokes_;
    std::vector<std::uint32_t> first_; ///< of each spoke of the lists
    std::vector<Known> known_;
    std::vector<Corner> shared_, found_;
};

} // namespace sinew::detail
