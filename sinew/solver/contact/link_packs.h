#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/rigid_links.h"
#include "sinew/solver/simd/link_pack.h"

#include <array>
#include <span>
#include <vector>

namespace sinew::detail {

/// Components of rigid links by packs of equal structure (simd/link_pack.h). Components share no movable particle, so
/// their order is of no consequence.
template <int D, class Real> class LinkPacks {
  public:
    std::vector<LinkPack<D>> list;

    /// Lane of a component.
    struct Place {
        std::uint32_t pack = 0;
        int lane = 0;
    };
    Place place_of(std::uint32_t component) const { return places_[component]; }
    /// Number of a particle that can move in its component.
    std::uint32_t number_of(Row slot) const { return number_[slot]; }

    void build(const RigidLinks<D, Real>& links) {
        list.clear(), rows_.clear(), clusters_.clear(), members_.clear();
        slots_.clear(), moves_.clear(), parts_.clear();
        number_.resize(links.component_of.size());
        places_.resize(links.components.size());
        sort_by_structure(links);
        for (std::size_t i = 0; i < order_.size(); ++i) {
            find_rows(links, order_[i].component);
            if (i == 0 || !joins_last()) begin_pack(links, order_[i].component);
            places_[order_[i].component] = {std::uint32_t(list.size() - 1), int(list.back().count++)};
        }
        lay_out(links);
    }
    /// Takes hold of the ropes that pull at first.
    void set_active(const RigidLinks<D, Real>& links) const {
        each_link(links, [](const RigidLink& link, const LinkPack<D>& pack, std::size_t k, std::size_t lane) {
            pack.of_link(k, LinkFields<D>::active)[lane] = link.is_active ? 1 : 0;
        });
    }

    /// Displacements by the links of clusters are noted in a substep, or not.
    void note_held(bool notes) {
        for (auto& pack : list) pack.notes_held = notes;
    }
    /// Calls visit(link, pack, number of the link in its component, lane).
    template <class Visit> void each_link(const RigidLinks<D, Real>& links, Visit&& visit) const {
        for (std::uint32_t i = 0; i < links.components.size(); ++i) {
            const auto& component = links.components[i];
            const auto& pack = list[places_[i].pack];
            for (auto k = component.first_link; k < component.last_link; ++k)
                visit(links.list[k], pack, k - component.first_link, std::size_t(places_[i].lane));
        }
    }

  private:
    using Links = RigidLinks<D, Real>;
    struct Numbered {
        std::uint64_t structure = 0;
        std::uint32_t component = 0;
        friend constexpr auto operator<=>(const Numbered&, const Numbered&) = default;
    };
    /// Offsets of a pack's arrays, while these grow.
    struct Part {
        std::size_t rows = 0, clusters = 0, members = 0, moves = 0, slots = 0, numbers = 0;
    };
    std::vector<LinkRow> rows_;
    std::vector<LinkCluster> clusters_;
    std::vector<std::uint32_t> members_;
    std::vector<char> moves_;
    std::vector<std::uint32_t> slots_;
    std::vector<double> numbers_;
    std::vector<Part> parts_;
    std::vector<Place> places_;         ///< per component
    std::vector<Numbered> order_;       ///< components by structure
    std::vector<std::uint32_t> number_; ///< per slot: number in its component
    std::vector<LinkRow> found_;        ///< rows of a component
    std::vector<LinkCluster> found_clusters_;
    std::vector<std::uint32_t> found_members_;

    static std::span<const Row> slots_of(const Links& links, const LinkComponent& component) {
        return std::span(links.slots).subspan(component.first_slot, component.last_slot - component.first_slot);
    }

    static char motion_of(const Links& links, Row slot) {
        if (links.component_of[slot] == Links::none) return 0;
        return links.clusters.cluster_of(slot) == Links::none ? LinkPack<D>::moves_alone
                                                              : LinkPack<D>::moves_with_cluster;
    }
    void find_rows(const Links& links, std::uint32_t index) {
        const auto& component = links.components[index];
        std::uint32_t number = 0, entries = 0;
        for (const Row slot : slots_of(links, component)) number_[slot] = number++;
        found_.clear();
        for (auto k = component.first_link; k < component.last_link; ++k) {
            const auto& link = links.list[k];
            const auto moves = [&](Row slot) { return std::uint32_t(links.component_of[slot] != Links::none); };
            const auto cluster_at = [&](Row slot) {
                const auto cluster = links.clusters.cluster_of(slot);
                return cluster == Links::none ? LinkRow::none : cluster - component.first_cluster;
            };
            found_.push_back({.a = number_[link.a],
                              .b = number_[link.b],
                              .cluster_a = cluster_at(link.a),
                              .cluster_b = cluster_at(link.b),
                              .first = link.first - component.first_link,
                              .start = entries,
                              .is_rope = link.is_rope,
                              .moves = moves(link.a) + 2 * moves(link.b)});
            entries += k - link.first;
        }
        find_members(links, component);
    }
    void find_members(const Links& links, const LinkComponent& component) {
        found_clusters_.clear(), found_members_.clear();
        for (auto c = component.first_cluster; c < component.last_cluster; ++c) {
            const auto& cluster = links.clusters.clusters[c];
            const auto first = std::uint32_t(found_members_.size());
            for (auto m = cluster.first; m < cluster.last; ++m)
                found_members_.push_back(number_[links.clusters.members[m].particle]);
            found_clusters_.push_back({first, std::uint32_t(found_members_.size())});
        }
    }
    std::uint64_t hash_of_structure() const {
        std::uint64_t hash = found_.size();
        const auto add = [&](std::uint32_t number) { hash = (hash ^ number) * 1099511628211ULL; };
        for (const auto& row : found_)
            for (const auto number : {row.a, row.b, row.is_rope, row.moves}) add(number);
        for (const auto& cluster : found_clusters_) add(cluster.last);
        for (const auto member : found_members_) add(member);
        return hash;
    }
    void sort_by_structure(const Links& links) {
        order_.clear();
        for (std::uint32_t i = 0; i < links.components.size(); ++i) {
            find_rows(links, i);
            order_.push_back({hash_of_structure(), i});
        }
        sinew::sort(order_.begin(), order_.end());
    }
    bool joins_last() const {
        const auto is_last = [](const auto& all, std::size_t from, const auto& found) {
            return std::equal(all.begin() + std::ptrdiff_t(from), all.end(), found.begin(), found.end());
        };
        const auto& part = parts_.back();
        return list.back().count < max_link_lanes && is_last(rows_, part.rows, found_) &&
               is_last(clusters_, part.clusters, found_clusters_) && is_last(members_, part.members, found_members_);
    }
    void begin_pack(const Links& links, std::uint32_t index) {
        const auto& component = links.components[index];
        parts_.push_back(
            {.rows = rows_.size(), .clusters = clusters_.size(), .members = members_.size(), .moves = moves_.size()});
        rows_.insert(rows_.end(), found_.begin(), found_.end());
        clusters_.insert(clusters_.end(), found_clusters_.begin(), found_clusters_.end());
        members_.insert(members_.end(), found_members_.begin(), found_members_.end());
        LinkPack<D> pack{.links = component.last_link - component.first_link,
                         .clusters = component.last_cluster - component.first_cluster,
                         .particles = component.last_slot - component.first_slot};
        for (const Row slot : slots_of(links, component)) moves_.push_back(motion_of(links, slot));
        for (auto k = component.first_link; k < component.last_link; ++k) {
            pack.entries += k - links.list[k].first;
            pack.has_ropes = pack.has_ropes || links.list[k].is_rope;
        }
        list.push_back(pack);
    }

    void lay_out(const Links& links) {
        constexpr std::size_t line = 64 / sizeof(double);
        std::size_t slots = 0, numbers = line;
        for (std::size_t i = 0; i < list.size(); ++i) {
            list[i].stride = list[i].count == 1 ? 1 : max_link_lanes;
            parts_[i].slots = slots, parts_[i].numbers = numbers;
            slots += list[i].particles * list[i].stride;
            numbers += (list[i].size() + line - 1) / line * line;
        }
        slots_.resize(slots);
        numbers_.assign(numbers, 0);
        const auto off = reinterpret_cast<std::uintptr_t>(numbers_.data()) % 64 / sizeof(double);
        for (std::size_t i = 0; i < list.size(); ++i) {
            list[i].rows = rows_.data() + parts_[i].rows, list[i].moves = moves_.data() + parts_[i].moves;
            list[i].cluster = clusters_.data() + parts_[i].clusters;
            list[i].members = members_.data() + parts_[i].members;
            list[i].slots = slots_.data() + parts_[i].slots;
            list[i].numbers = numbers_.data() + parts_[i].numbers - off;
        }
        fill(links);
    }
    void fill_rest(const Links& links, std::uint32_t index) {
        const auto& component = links.components[index];
        if (component.first_cluster == component.last_cluster) return;
        const auto& pack = list[places_[index].pack];
        auto member = links.clusters.clusters[component.first_cluster].first;
        for (std::uint32_t m = 0; m < pack.cluster[pack.clusters - 1].last; ++m, ++member)
            for (int k = 0; k < D; ++k)
                pack.of_particle(pack.members[m], LinkFields<D>::rest + std::size_t(k))[places_[index].lane] =
                    links.clusters.members[member].rest[k];
    }
    void fill(const Links& links) {
        for (std::uint32_t i = 0; i < links.components.size(); ++i) {
            const auto [number, lane] = places_[i];
            const auto& pack = list[number];
            const auto slots = slots_of(links, links.components[i]);
            const auto put = [&](std::size_t at) {
                for (std::size_t k = 0; k < slots.size(); ++k)
                    slots_[parts_[number].slots + k * pack.stride + at] = slots[k];
            };
            put(std::size_t(lane));
            list[number].first_cluster[std::size_t(lane)] = links.components[i].first_cluster;
            if (lane == 0)
                for (std::size_t at = pack.count; at < pack.stride; ++at) put(at);
        }
        each_link(links, [](const RigidLink& link, const LinkPack<D>& pack, std::size_t k, std::size_t lane) {
            using Fields = LinkFields<D>;
            pack.of_link(k, Fields::length)[lane] = link.length;
            pack.of_link(k, Fields::per_length)[lane] = inverse_or_zero(link.length);
        });
        for (std::uint32_t i = 0; i < links.components.size(); ++i) fill_rest(links, i);
        set_active(links);
    }
};

} // namespace sinew::detail
