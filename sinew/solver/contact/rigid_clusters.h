#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/rest_shape.h"
#include "sinew/table/id.h"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

namespace sinew::detail {

/// Link of a colliding figure.
struct RigidLink {
    Row row = 0;             ///< in the table of distances
    Row a = 0, b = 0;        ///< slots of the sweep
    Row root = 0;            ///< component
    std::uint32_t first = 0; ///< first column of the skyline, in the list
    bool is_rope = false;    ///< may be shorter
    bool is_active = true;   ///< holds its length at first; a rope does while it pulls
    double length = 0;
    bool moves_a = false, moves_b = false; ///< the ends

    bool is_same_as(const RigidLink& other) const {
        return row == other.row && a == other.a && b == other.b && is_rope == other.is_rope && length == other.length &&
               moves_a == other.moves_a && moves_b == other.moves_b;
    }
};

/// Particles whose links make them rigid, and more than that: crates with braces, trunks. They move as one body
/// (simd/link_clusters.h), and their links are no rows. Links that are just enough have each a force of its own, and
/// stay rows.
template <int D> class RigidClusters {
  public:
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges; ///< of members
    std::vector<Row> members;                                    ///< slots
    std::vector<Vec<D, double>> rest;                            ///< per member

    static constexpr std::uint32_t none = ~std::uint32_t(0);

    void clear(std::size_t slots) {
        ranges.clear(), members.clear(), rest.clear(), roots_.clear();
        cluster_of_.assign(slots, none);
        if (count_.size() < slots) count_.assign(slots, 0);
    }
    std::uint32_t cluster_of(Row slot) const { return cluster_of_[slot]; }
    /// The first member for all members of a cluster.
    Row node_of(Row slot) const {
        return cluster_of_[slot] == none ? slot : members[ranges[cluster_of_[slot]].first];
    }
    bool is_inner(const RigidLink& link) const {
        return cluster_of_[link.a] != none && cluster_of_[link.a] == cluster_of_[link.b];
    }
    Row root_of(std::uint32_t cluster) const { return roots_[cluster]; }

    /// Finds the clusters of a component. The sides on which particles lie follow from their places position(slot).
    /// True if there are any.
    template <class Position> bool find(std::span<const RigidLink> links, const Position& position) {
        if (links.size() <= D * (D + 1) / 2 || std::getenv("NOCLUSTERS")) return false;
        list_neighbours(links);
        const auto before = ranges.size();
        for (const auto& link : links)
            if (may_join(link.a) && may_join(link.b) && is_fixed(link)) grow(link, links, position);
        return ranges.size() > before;
    }
    /// Links of a component from the ends of limbs to clusters; those within clusters last.
    void order(std::span<RigidLink> links) {
        auto& depth = count_; // 1 + number of links to the nearest cluster; 0: not yet known
        for (const auto& link : links)
            for (const Row slot : {link.a, link.b}) depth[slot] = cluster_of_[slot] != none;
        for (bool any = true; any;) {
            any = false;
            for (const auto& link : links)
                for (const auto& [from, to] : {std::pair{link.a, link.b}, {link.b, link.a}})
                    if (depth[from] > 0 && (depth[to] == 0 || depth[to] > depth[from] + 1))
                        depth[to] = depth[from] + 1, any = true;
        }
        const auto key = [&](const RigidLink& link) {
            return std::pair(is_inner(link), -std::int64_t(std::max(depth[link.a], depth[link.b])));
        };
        sinew::sort(links.begin(), links.end(), [&](const auto& x, const auto& y) {
            const auto a = key(x), b = key(y);
            return a != b ? a < b : x.row < y.row;
        });
        for (const auto& link : links) depth[link.a] = depth[link.b] = 0;
    }

  private:
    struct Neighbour {
        Row slot = 0;
        std::uint32_t link = 0; ///< of the component
        friend bool operator<(const Neighbour& a, const Neighbour& b) {
            return std::pair(a.slot, a.link) < std::pair(b.slot, b.link);
        }
    };
    std::vector<std::uint32_t> cluster_of_; ///< per slot
    std::vector<Row> roots_;                ///< per cluster: of its component
    std::vector<std::uint32_t> count_;      ///< scratch, per slot
    std::vector<Neighbour> neighbours_;     ///< links by ends
    std::vector<Row> grown_, touched_;
    std::vector<RestLink> inner_;
    RestShape<D> shape_;

    static bool is_fixed(const RigidLink& link) { return link.moves_a && link.moves_b && !link.is_rope; }
    bool may_join(Row slot) const { return cluster_of_[slot] == none; }
    void list_neighbours(std::span<const RigidLink> links) {
        neighbours_.clear();
        for (std::uint32_t k = 0; k < links.size(); ++k)
            if (is_fixed(links[k])) neighbours_.push_back({links[k].a, k}), neighbours_.push_back({links[k].b, k});
        sinew::sort(neighbours_.begin(), neighbours_.end());
    }
    /// Calls visit(slot at the other end) for each link of a particle.
    template <class Visit> void each_neighbour(Row slot, std::span<const RigidLink> links, const Visit& visit) const {
        auto at = std::lower_bound(neighbours_.begin(), neighbours_.end(), Neighbour{slot, 0});
        for (; at != neighbours_.end() && at->slot == slot; ++at)
            visit(links[at->link].a == slot ? links[at->link].b : links[at->link].a);
    }

    /// Grows a cluster from a link by particles with D links to it; the third in space needs two.
    template <class Position>
    void grow(const RigidLink& seed, std::span<const RigidLink> links, const Position& position) {
        constexpr std::uint32_t is_in = none;
        grown_.clear();
        touched_.clear();
        const auto take = [&](Row slot) {
            grown_.push_back(slot), touched_.push_back(slot);
            count_[slot] = is_in;
            each_neighbour(slot, links, [&](Row other) {
                if (count_[other] == is_in || !may_join(other)) return;
                if (count_[other]++ == 0) touched_.push_back(other);
            });
        };
        take(seed.a), take(seed.b);
        for (bool any = true; any;) {
            any = false;
            for (std::size_t i = 0; i < touched_.size(); ++i) {
                const Row slot = touched_[i];
                const std::uint32_t enough = D == 3 && grown_.size() == 2 ? 2 : D;
                if (count_[slot] != is_in && count_[slot] >= enough) take(slot), any = true;
            }
        }
        for (const Row slot : touched_) count_[slot] = 0;
        accept(links, position, seed.root);
    }
    template <class Position> void accept(std::span<const RigidLink> links, const Position& position, Row root) {
        const auto number = std::uint32_t(ranges.size());
        for (std::uint32_t i = 0; i < grown_.size(); ++i) cluster_of_[grown_[i]] = number, count_[grown_[i]] = i;
        inner_.clear();
        for (const auto& link : links)
            if (is_fixed(link) && is_inner(link) && cluster_of_[link.a] == number)
                inner_.push_back({count_[link.a], count_[link.b], link.length});
        for (const Row slot : grown_) count_[slot] = 0;
        const bool is_braced = grown_.size() > D && inner_.size() > D * grown_.size() - D * (D + 1) / 2;
        if (!is_braced || !shape_.find(inner_, grown_.size(), [&](std::uint32_t i) { return position(grown_[i]); })) {
            for (const Row slot : grown_) cluster_of_[slot] = none;
            return;
        }
        const auto first = std::uint32_t(members.size());
        members.insert(members.end(), grown_.begin(), grown_.end());
        rest.insert(rest.end(), shape_.places.begin(), shape_.places.end());
        ranges.push_back({first, std::uint32_t(members.size())});
        roots_.push_back(root);
    }
};

} // namespace sinew::detail
