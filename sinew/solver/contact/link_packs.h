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

    void build(const RigidLinks<D, Real>& links) {
        list.clear(), rows_.clear(), slots_.clear(), moves_.clear(), parts_.clear();
        ranges_.clear(), particles_.clear();
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
        std::size_t rows = 0, moves = 0, slots = 0, numbers = 0, ranges = 0, particles = 0;
    };
    std::vector<LinkRow> rows_;
    std::vector<char> moves_;
    std::vector<std::uint32_t> slots_;
    std::vector<double> numbers_;
    std::vector<Part> parts_;
    std::vector<Place> places_;         ///< per component
    std::vector<Numbered> order_;       ///< components by structure
    std::vector<std::uint32_t> number_; ///< per slot: number in its component
    std::vector<LinkRow> found_;        ///< rows of a component
    std::vector<LinkCluster> ranges_, found_ranges_;        ///< of clusters
    std::vector<std::uint32_t> particles_, found_particles_; ///< of members
    std::uint32_t found_count_ = 0; ///< particles of a component
    std::vector<std::uint32_t> member_; ///< per slot: number among the members of its component, or no_member

    static std::span<const Row> slots_of(const Links& links, const LinkComponent& component) {
        return std::span(links.slots).subspan(component.first_slot, component.last_slot - component.first_slot);
    }

    void find_rows(const Links& links, std::uint32_t index) {
        const auto& component = links.components[index];
        std::uint32_t number = 0, entries = 0;
        for (const Row slot : slots_of(links, component)) number_[slot] = number++;
        found_count_ = number;
        find_members(links, component);
        const auto cluster = [&](Row slot) {
            const auto at = links.clusters.cluster_of(slot);
            return at == Links::none ? no_member : at - component.first_cluster;
        };
        found_.clear();
        for (auto k = component.first_link; k < component.last_link; ++k) {
            const auto& link = links.list[k];
            const auto moves = [&](Row slot) { return std::uint32_t(links.component_of[slot] != Links::none); };
            found_.push_back({.a = number_[link.a],
                              .b = number_[link.b],
                              .first = link.first - component.first_link,
                              .start = entries,
                              .is_rope = link.is_rope,
                              .moves = moves(link.a) + 2 * moves(link.b),
                              .member_a = member_[link.a],
                              .member_b = member_[link.b],
                              .cluster_a = cluster(link.a),
                              .cluster_b = cluster(link.b)});
            entries += k - link.first;
        }
    }
    /// Members of the clusters, numbered one after the other, by their particles.
    void find_members(const Links& links, const LinkComponent& component) {
        member_.resize(links.component_of.size(), no_member);
        for (const Row slot : slots_of(links, component)) member_[slot] = no_member;
        found_ranges_.clear(), found_particles_.clear();
        for (auto i = component.first_cluster; i < component.last_cluster; ++i) {
            const auto [first, last] = links.clusters.ranges[i];
            const auto begin = std::uint32_t(found_particles_.size());
            for (auto k = first; k < last; ++k) {
                const Row slot = links.clusters.members[k];
                member_[slot] = std::uint32_t(found_particles_.size());
                found_particles_.push_back(number_[slot]);
            }
            found_ranges_.push_back({begin, std::uint32_t(found_particles_.size())});
        }
    }
    std::uint64_t hash_of_rows() const {
        std::uint64_t hash = found_.size();
        const auto add = [&](std::uint32_t number) { hash = (hash ^ number) * 1099511628211ULL; };
        for (const auto& row : found_)
            for (const auto number : {row.a, row.b, row.is_rope, row.moves}) add(number);
        for (const auto particle : found_particles_) add(particle);
        return hash;
    }
    void sort_by_structure(const Links& links) {
        order_.clear();
        for (std::uint32_t i = 0; i < links.components.size(); ++i) {
            find_rows(links, i);
            order_.push_back({hash_of_rows(), i});
        }
        sinew::sort(order_.begin(), order_.end());
    }
    bool joins_last() const {
        const auto& pack = list.back();
        const auto first = rows_.begin() + std::ptrdiff_t(parts_.back().rows);
        return pack.count < max_link_lanes && pack.particles == found_count_ &&
               std::equal(first, rows_.end(), found_.begin(), found_.end()) &&
               std::equal(ranges_.begin() + std::ptrdiff_t(parts_.back().ranges), ranges_.end(), found_ranges_.begin(),
                          found_ranges_.end()) &&
               std::equal(particles_.begin() + std::ptrdiff_t(parts_.back().particles), particles_.end(),
                          found_particles_.begin(), found_particles_.end());
    }
    void begin_pack(const Links& links, std::uint32_t index) {
        const auto& component = links.components[index];
        parts_.push_back({.rows = rows_.size(),
                          .moves = moves_.size(),
                          .ranges = ranges_.size(),
                          .particles = particles_.size()});
        rows_.insert(rows_.end(), found_.begin(), found_.end());
        ranges_.insert(ranges_.end(), found_ranges_.begin(), found_ranges_.end());
        particles_.insert(particles_.end(), found_particles_.begin(), found_particles_.end());
        LinkPack<D> pack{.links = component.last_link - component.first_link,
                         .particles = component.last_slot - component.first_slot,
                         .clusters = std::uint32_t(found_ranges_.size()),
                         .members = std::uint32_t(found_particles_.size())};
        for (const Row slot : slots_of(links, component)) moves_.push_back(links.component_of[slot] != Links::none);
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
            list[i].ranges = ranges_.data() + parts_[i].ranges;
            list[i].particle_of = particles_.data() + parts_[i].particles;
            list[i].slots = slots_.data() + parts_[i].slots;
            list[i].numbers = numbers_.data() + parts_[i].numbers - off;
        }
        fill(links);
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
            fill_shapes(links, links.components[i], pack, std::size_t(lane));
            if (lane == 0)
                for (std::size_t at = pack.count; at < pack.stride; ++at)
                    put(at), fill_shapes(links, links.components[i], pack, at);
        }
        each_link(links, [](const RigidLink& link, const LinkPack<D>& pack, std::size_t k, std::size_t lane) {
            using Fields = LinkFields<D>;
            pack.of_link(k, Fields::length)[lane] = link.length;
            pack.of_link(k, Fields::per_length)[lane] = inverse_or_zero(link.length);
        });
        set_active(links);
    }
    static void fill_shapes(const Links& links, const LinkComponent& component, const LinkPack<D>& pack,
                            std::size_t lane) {
        if (pack.clusters == 0) return;
        const auto first = links.clusters.ranges[component.first_cluster].first;
        for (std::uint32_t k = 0; k < pack.members; ++k)
            for (int c = 0; c < D; ++c)
                pack.of_member(k, LinkFields<D>::rest + std::size_t(c))[lane] = links.clusters.rest[first + k][c];
    }
};

} // namespace sinew::detail
