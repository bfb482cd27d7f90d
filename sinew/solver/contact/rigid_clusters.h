#pragma once

#include "sinew/math/scalar.h"
#include "sinew/math/vec.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::detail {

/// Rigid clusters of a graph of lengths, by trilateration: in the plane a particle joins the two ends of a link, and
/// then every one that two lengths to members place; in 3D three. Lengths decide who joins, and positions on which
/// side: while `has_same_sides`, a cluster does not depend on the time at which it is found. What is rigid otherwise is
/// left to its links.
template <int D> class RigidClusters {
  public:
    using Vector = Vec<D, double>;
    static constexpr std::uint32_t none = ~std::uint32_t(0);

    struct Member {
        std::uint32_t particle = 0;
        Vector rest{}; ///< the first at the origin, the second on the first axis, in 3D the third in the first plane
    };
    struct Cluster {
        std::uint32_t first = 0, last = 0; ///< of `members`
    };
    std::vector<Member> members;
    std::vector<Cluster> clusters;

    /// Forgets everything. `particles`: their number; `exact`: error of a length that counts as none, as a share of it.
    void begin(std::size_t particles, double exact) {
        members.clear(), clusters.clear(), lengths_.clear(), sides_.clear();
        cluster_of_.assign(particles, none), member_of_.assign(particles, none);
        exact_ = exact;
    }
    void add_length(std::uint32_t a, std::uint32_t b, double length) {
        if (length > 0) lengths_.push_back({a, b, length});
    }
    /// `position_of(particle)`: decides on which side of others a particle is.
    template <class PositionOf> void find(const PositionOf& position_of) {
        list_neighbours();
        for (const auto& seed : lengths_)
            if (is_free(seed.from) && is_free(seed.to)) grow(seed, position_of);
    }
    /// True if every particle is on the side of others on which it was found.
    template <class PositionOf> bool has_same_sides(const PositionOf& position_of) const {
        return std::all_of(sides_.begin(), sides_.end(), [&](const Side& side) {
            return is_above(side.particle, side.of, position_of) == side.is_above;
        });
    }
    /// `none` outside of clusters.
    std::uint32_t cluster_of(std::uint32_t particle) const { return cluster_of_[particle]; }
    /// Place of a member in its cluster.
    const Vector& rest_of(std::uint32_t particle) const { return members[member_of_[particle]].rest; }

  private:
    struct Edge {
        std::uint32_t from = 0, to = 0;
        double length = 0;
    };
    /// Place of a particle by lengths to D members.
    struct Placing {
        double quality = 0; ///< height over the members, as a share of the longest length; `flattest` in their midst
        Vector rest{};
        std::array<std::uint32_t, D> of{}; ///< these members
        bool has_side = false, is_above = false;
    };
    /// Side of a particle: to the left of two others; in 3D above three.
    struct Side {
        std::uint32_t particle = 0;
        std::array<std::uint32_t, D> of{};
        bool is_above = false;
    };
    static constexpr double flattest = 3e-3; ///< quality with which a side is certain

    std::vector<Edge> lengths_;
    std::vector<Edge> edges_;               ///< both ways, by `from`
    std::vector<std::uint32_t> first_edge_; ///< per particle, and the end
    std::vector<std::uint32_t> cluster_of_, member_of_;
    std::vector<std::uint32_t> waiting_; ///< particles next to members, in order
    std::vector<Edge> known_;            ///< from a particle to members
    std::vector<Side> sides_;            ///< of all particles that lengths left two places, whether they fitted or not
    double exact_ = 0;

    bool is_free(std::uint32_t particle) const { return cluster_of_[particle] == none; }
    void list_neighbours() {
        first_edge_.assign(cluster_of_.size() + 2, 0);
        for (const auto& edge : lengths_) ++first_edge_[edge.from + 2], ++first_edge_[edge.to + 2];
        for (std::size_t i = 2; i < first_edge_.size(); ++i) first_edge_[i] += first_edge_[i - 1];
        edges_.resize(2 * lengths_.size());
        for (const auto& edge : lengths_) {
            edges_[first_edge_[edge.from + 1]++] = edge;
            edges_[first_edge_[edge.to + 1]++] = {edge.to, edge.from, edge.length};
        }
    }
    std::span<const Edge> edges_of(std::uint32_t particle) const {
        return std::span(edges_).subspan(first_edge_[particle], first_edge_[particle + 1] - first_edge_[particle]);
    }

    template <class PositionOf> void grow(const Edge& seed, const PositionOf& position_of) {
        const auto first = std::uint32_t(members.size());
        waiting_.clear();
        add(seed.from, Vector{});
        add(seed.to, Vector::axis(0) * seed.length);
        if constexpr (D == 3) add_third(seed);
        for (std::size_t i = 0; i < waiting_.size(); ++i) // grows meanwhile
            if (const auto particle = waiting_[i]; is_free(particle))
                if (const auto placing = place(particle, first, position_of); placing.quality >= flattest) {
                    if (placing.has_side) sides_.push_back({particle, placing.of, placing.is_above});
                    if (fits(placing.rest)) add(particle, placing.rest);
                }
        const auto last = std::uint32_t(members.size());
        if (last - first > 2) {
            clusters.push_back({first, last});
            return;
        }
        for (auto i = first; i < last; ++i) cluster_of_[members[i].particle] = member_of_[members[i].particle] = none;
        members.resize(first);
    }
    void add(std::uint32_t particle, const Vector& rest) {
        cluster_of_[particle] = std::uint32_t(clusters.size());
        member_of_[particle] = std::uint32_t(members.size());
        members.push_back({particle, rest});
        for (const auto& edge : edges_of(particle))
            if (is_free(edge.to)) waiting_.push_back(edge.to);
    }
    /// The particle that makes the best triangle with a link.
    void add_third(const Edge& seed) {
        double best = flattest;
        std::uint32_t third = none;
        Vector rest{};
        for (const auto& one : edges_of(seed.from))
            for (const auto& other : edges_of(seed.to)) {
                if (one.to != other.to || !is_free(one.to)) continue;
                const double along = along_base(seed.length, one.length, other.length);
                const double height = square_root(std::max(square(one.length) - square(along), 0.0));
                const double quality = height / std::max({seed.length, one.length, other.length});
                if (!(quality > best)) continue;
                best = quality, third = one.to;
                rest = Vector::axis(0) * along + Vector::axis(1) * height;
            }
        if (third != none) add(third, rest);
    }
    /// Distance along a base from its first end.
    static double along_base(double base, double from_first, double from_second) {
        return (square(base) + square(from_first) - square(from_second)) / (2 * base);
    }

    template <class PositionOf>
    Placing place(std::uint32_t particle, std::uint32_t first, const PositionOf& position_of) {
        constexpr std::size_t most = 6; // lengths tried with each other
        known_.clear();
        for (const auto& edge : edges_of(particle))
            if (!is_free(edge.to) && member_of_[edge.to] >= first) known_.push_back(edge);
        const auto count = std::min(known_.size(), most);
        Placing best;
        const auto consider = [&](auto... i) {
            const auto placing = place_by({known_[i]...}, position_of);
            if (placing.quality > best.quality) best = placing;
        };
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = i + 1; j < count; ++j) {
                if constexpr (D == 2)
                    consider(i, j);
                else
                    for (std::size_t k = j + 1; k < count; ++k) consider(i, j, k);
            }
        return best;
    }
    const Vector& rest_of(const Edge& edge) const { return members[member_of_[edge.to]].rest; }

    /// Zero where lengths leave no side to choose: a point between two others, on their line.
    double height_of(double squared, double longest) const {
        return squared > exact_ * square(longest) ? square_root(squared) : 0;
    }
    static double quality_of(double height, double longest) { return height == 0 ? flattest : height / longest; }

    template <class PositionOf>
    static bool is_above(std::uint32_t particle, const std::array<std::uint32_t, D>& of,
                         const PositionOf& position_of) {
        const auto from = position_of(of[0]);
        if constexpr (D == 2)
            return cross(position_of(of[1]) - from, position_of(particle) - from) > 0;
        else
            return dot(cross(position_of(of[1]) - from, position_of(of[2]) - from), position_of(particle) - from) > 0;
    }
    /// Intersection of two circles, or of three spheres.
    template <class PositionOf> Placing place_by(const std::array<Edge, D>& by, const PositionOf& position_of) const {
        const Vector origin = rest_of(by[0]), base = rest_of(by[1]) - origin;
        const double length = norm(base), longest = std::max({by[0].length, by[1].length, length});
        if (!(length > flattest * longest)) return {};
        const Vector x = base * (1 / length);
        const double along = along_base(length, by[0].length, by[1].length);
        Placing placing;
        for (std::size_t i = 0; i < D; ++i) placing.of[i] = by[i].to;
        placing.is_above = is_above(by[0].from, placing.of, position_of);
        double height = 0;
        if constexpr (D == 2) {
            height = height_of(square(by[0].length) - square(along), longest);
            placing.rest = origin + x * along + Vector{{-x[1], x[0]}} * (placing.is_above ? height : -height);
        } else {
            const Vector aside = rest_of(by[2]) - origin, across = aside - x * dot(aside, x);
            const double width = norm(across);
            if (!(width > flattest * longest)) return {};
            const Vector y = across * (1 / width), z = cross(x, y);
            const double third = (square(by[0].length) - square(by[2].length) + dot(aside, aside)) / 2;
            const double up = (third - along * dot(aside, x)) / width;
            height = height_of(square(by[0].length) - square(along) - square(up), longest);
            placing.rest = origin + x * along + y * up + z * (placing.is_above ? height : -height);
        }
        placing.quality = quality_of(height, longest);
        placing.has_side = height > 0;
        return placing;
    }
    /// True if all lengths to members agree.
    bool fits(const Vector& rest) const {
        return std::all_of(known_.begin(), known_.end(), [&](const Edge& edge) {
            return absolute(norm(rest - rest_of(edge)) - edge.length) <= exact_ * edge.length;
        });
    }
};

} // namespace sinew::detail
