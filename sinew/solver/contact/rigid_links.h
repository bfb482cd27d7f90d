#pragma once

#include "sinew/math/sort.h"
#include "sinew/math/union_find.h"
#include "sinew/solver/contact/rigid_clusters.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace sinew::detail {

/// True for a constraint that is neither soft, nor driven, nor able to slip or tear.
template <class Table> bool is_plain(const Table& table, Row row) {
    using Real = std::decay_t<decltype(table.relaxation[row])>;
    return table.is_rigid(row) && table.relaxation[row] == Real(1) && table.split[row] == Real(0.5) &&
           !table.gives(row) && !table.motorized[row] && !table.may_tear(row);
}

/// True for a plain distance of one length, or a rope that is only held from getting longer.
template <int D, class Real> bool is_link(const Constraints<Distance<D>, Real>& table, Row row) {
    return is_plain(table, row) &&
           (table.low(row) == table.high(row) || (table.low(row) <= Real(0) && table.high(row) < limit::measure<Real>));
}

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

/// Connected component of rigid links.
struct LinkComponent {
    std::uint32_t first_link = 0, last_link = 0;
    std::uint32_t first_slot = 0, last_slot = 0; ///< range of RigidLinks::slots
    std::uint32_t first_cluster = 0, last_cluster = 0;
};

/// Rigid links of the figures that collide, by components, with a skyline for G M^-1 G^T; links within a rigid cluster
/// are apart. Components whose skyline is too wide (meshes) are left to the sweep.
template <int D, class Real> struct RigidLinks {
    std::vector<RigidLink> list;
    std::vector<RigidLink> inner; ///< links within clusters; their `root` is the cluster
    RigidClusters<D> clusters;    ///< their particles are slots
    std::vector<LinkComponent> components;
    std::vector<Row> slots;                  ///< by components, in order
    std::vector<std::uint32_t> component_of; ///< per slot that can move; `none` without rigid links
    std::vector<char> is_swept; ///< per slot: a distance that is not plain, or part of a mesh, is at the particle

    static constexpr std::uint32_t none = ~std::uint32_t(0);
    bool is_rod(std::uint32_t component) const {
        return components[component].last_slot - components[component].first_slot == 2;
    }

    /// `is_exact` receives 1 per slot of the sweep held exactly, or by no distance at all. False if all links are those
    /// of the last search: then only the ropes that pull are found anew.
    bool find(const World<D, Real>& world, const Solver<D, Real>& solver, std::span<const char> takes_part,
              std::vector<char>& is_exact) {
        const auto& state = solver.sweep_state;
        collect(world, solver, takes_part);
        const bool is_same = found_ == last_ && clusters.has_same_sides(places(world, state));
        if (is_same) {
            const auto& table = std::get<kind_number<Distance, D>>(world.constraints);
            for (auto& link : list) link.is_active = pulls(table, link);
        } else {
            std::swap(found_, last_);
            list = last_.links, is_swept = last_.is_swept, is_exact_ = last_.is_exact;
            order_by_component();
            find_clusters(world, state);
            keep_narrow(state);
            list_slots(state.size());
        }
        is_exact = is_exact_;
        return !is_same;
    }

    /// The links within clusters, a component to a cluster.
    void list_inner(RigidLinks& to) const {
        to.list = inner;
        to.clusters.begin(component_of.size(), 0);
        const auto key = [](const RigidLink& link) { // by places of particles: a grid of links has a narrow skyline
            return std::tuple(link.root, std::max(link.a, link.b), std::min(link.a, link.b), link.row);
        };
        sinew::sort(to.list.begin(), to.list.end(), [&](const auto& x, const auto& y) { return key(x) < key(y); });
        to.first_at_.assign(component_of.size(), none);
        to.components.clear();
        for (std::uint32_t begin = 0, end = 0; begin < to.list.size(); begin = end) {
            for (; end < to.list.size() && to.list[end].root == to.list[begin].root; ++end) {
                to.width_of(end);
                if (to.list[end].is_rope) to.list[end].is_active = false; // as long as the cluster lets it be
            }
            to.components.push_back({.first_link = begin, .last_link = end});
        }
        to.list_slots(component_of.size());
    }

  private:
    /// Result of a search in the tables.
    struct Found {
        std::vector<RigidLink> links;
        std::vector<char> is_swept, is_exact; ///< per slot
        friend bool operator==(const Found& one, const Found& other) {
            return one.is_swept == other.is_swept && one.is_exact == other.is_exact &&
                   std::ranges::equal(one.links, other.links, [](auto& a, auto& b) { return a.is_same_as(b); });
        }
    };
    Found found_, last_;
    std::vector<char> is_exact_;
    UnionFind sets_;                      ///< of slots
    std::vector<std::uint32_t> first_at_; ///< per slot: the first link there

    template <class Table> static bool pulls(const Table& table, const RigidLink& link) {
        return !link.is_rope || table.multiplier[link.row] < Real(0);
    }
    void collect(const World<D, Real>& world, const Solver<D, Real>& solver, std::span<const char> takes_part) {
        const auto& state = solver.sweep_state;
        const auto& table = std::get<kind_number<Distance, D>>(world.constraints);
        const auto moves = [&](Row slot) { return world.particles.mobility[state.row_of[slot]] > Real(0); };
        auto& [links, swept, exact] = found_;
        links.clear();
        swept.assign(state.size(), 0), exact.assign(state.size(), 1);
        for (Row row = 0; row < table.size(); ++row) {
            if (solver.blocks.holds(table, row)) continue;
            const auto ends = table.members[row];
            const Row a = state.slot_of[ends[0]], b = state.slot_of[ends[1]];
            if (a >= state.size() || b >= state.size() || !(takes_part[a] || takes_part[b])) continue;
            const bool moves_a = moves(a), moves_b = moves(b);
            if (!moves_a && !moves_b) continue;
            if (!is_link(table, row)) {
                swept[a] |= !is_plain(table, row), swept[b] |= !is_plain(table, row);
                if (table.may_tear(row)) exact[a] = exact[b] = 0;
                continue;
            }
            links.push_back({.row = row,
                             .a = a,
                             .b = b,
                             .is_rope = table.low(row) < table.high(row),
                             .length = double(table.high(row)),
                             .moves_a = moves_a,
                             .moves_b = moves_b});
            links.back().is_active = pulls(table, links.back());
        }
    }
    void order_by_component() {
        sets_.reset(is_swept.size());
        for (const auto& link : list)
            if (link.moves_a && link.moves_b) sets_.join(link.a, link.b);
        for (auto& link : list) link.root = sets_.first_of(link.moves_a ? link.a : link.b);
        sinew::sort(list.begin(), list.end(),
                    [](const auto& x, const auto& y) { return x.root != y.root ? x.root < y.root : x.row < y.row; });
    }

    void find_clusters(const World<D, Real>& world, const SweepState<D, Real>& state) {
        constexpr double exact = sizeof(Real) == sizeof(float) ? 1e-6 : 1e-9;
        clusters.begin(state.size(), exact);
        for (const auto& link : list)
            if (!link.is_rope && link.moves_a && link.moves_b) clusters.add_length(link.a, link.b, link.length);
        clusters.find(places(world, state));
    }
    static auto places(const World<D, Real>& world, const SweepState<D, Real>& state) {
        return [&](std::uint32_t slot) { return cast<double>(world.particles.position[state.row_of[slot]]); };
    }
    bool is_inner(const RigidLink& link) const {
        const auto cluster = clusters.cluster_of(link.a);
        return link.moves_a && link.moves_b && cluster != none && cluster == clusters.cluster_of(link.b);
    }

    void keep_narrow(const SweepState<D, Real>& state) {
        constexpr std::size_t max_per_link = 100, max_with_ropes = 16; // each change of the ropes that pull is a factor
        first_at_.assign(state.size(), none);
        components.clear(), inner.clear();
        std::size_t kept = 0;
        std::uint32_t cluster = 0;
        for (std::size_t begin = 0, end = 0; begin < list.size(); begin = end) {
            const Row root = list[begin].root;
            const auto kept_before = kept, inner_before = inner.size();
            const auto cluster_before = cluster;
            std::size_t size = 0;
            bool has_ropes = false;
            for (; end < list.size() && list[end].root == root; ++end) {
                has_ropes = has_ropes || list[end].is_rope;
                if (is_inner(list[end])) {
                    inner.push_back(list[end]);
                    inner.back().root = clusters.cluster_of(list[end].a);
                    continue;
                }
                list[kept] = list[end];
                size += width_of(std::uint32_t(kept++));
            }
            while (cluster < clusters.clusters.size() && sets_.first_of(first_of(cluster)) == root) ++cluster;
            if (size > (has_ropes ? max_with_ropes : max_per_link) * (kept - kept_before)) {
                for (auto i = kept_before; i < kept; ++i) leave_to_sweep(list[i]);
                for (auto i = inner_before; i < inner.size(); ++i) leave_to_sweep(inner[i]);
                kept = kept_before, inner.resize(inner_before);
                continue;
            }
            components.push_back({.first_link = std::uint32_t(kept_before),
                                  .last_link = std::uint32_t(kept),
                                  .first_cluster = cluster_before,
                                  .last_cluster = cluster});
        }
        list.resize(kept);
    }
    Row first_of(std::uint32_t cluster) const { return clusters.members[clusters.clusters[cluster].first].particle; }
    /// A particle that stands for all that move together.
    Row body_of(Row slot) const {
        const auto cluster = clusters.cluster_of(slot);
        return cluster == none ? slot : first_of(cluster);
    }
    void leave_to_sweep(const RigidLink& link) {
        is_exact_[link.a] = is_exact_[link.b] = 0;
        is_swept[link.a] = is_swept[link.b] = 1;
    }
    /// Sets the first column that couples with a link, through a movable end; returns the number of entries.
    std::size_t width_of(std::uint32_t k) {
        auto& link = list[k];
        link.first = k;
        for (const auto& [slot, moves] : {std::pair{link.a, link.moves_a}, {link.b, link.moves_b}}) {
            if (!moves) continue;
            auto& first = first_at_[body_of(slot)];
            if (first == none) first = k;
            link.first = std::min(link.first, first);
        }
        return k - link.first;
    }

    void list_slots(std::size_t count) {
        slots.clear();
        component_of.assign(count, none);
        for (std::uint32_t i = 0; i < components.size(); ++i) {
            auto& component = components[i];
            component.first_slot = std::uint32_t(slots.size());
            for (auto k = component.first_link; k < component.last_link; ++k) {
                slots.push_back(list[k].a), slots.push_back(list[k].b);
                if (list[k].moves_a) component_of[list[k].a] = i;
                if (list[k].moves_b) component_of[list[k].b] = i;
            }
            for (auto c = component.first_cluster; c < component.last_cluster; ++c)
                for (auto m = clusters.clusters[c].first; m < clusters.clusters[c].last; ++m) {
                    slots.push_back(clusters.members[m].particle);
                    component_of[slots.back()] = i;
                }
            const auto first = slots.begin() + component.first_slot;
            sinew::sort(first, slots.end());
            slots.erase(std::unique(first, slots.end()), slots.end());
            component.last_slot = std::uint32_t(slots.size());
        }
    }
};

} // namespace sinew::detail
