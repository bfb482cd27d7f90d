#pragma once

#include "sinew/solver/plan.h"
#include "sinew/table/row_lists.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <span>
#include <vector>

/// Adjacency of a component: the rigid links of each particle. In woven cloth most particles have equal links at equal
/// slot offsets, and share a list.
namespace sinew::detail {

template <int D, class Real> class Adjacency {
  public:
    struct Spoke {
        std::uint32_t offset; ///< slot of the other end minus the particle's slot, modulo 2^32
        Real length;
        friend bool operator==(const Spoke&, const Spoke&) = default;
    };

    Adjacency(const World<D, Real>& world, const Plan<Real>& plan)
        : distances_(std::get<kind_number<Distance, D>>(world.constraints)), plan_(plan) {}

    /// Lists the links of a component's particles, numbered from the component's first slot.
    void list(const Component& component, std::size_t particles) {
        constexpr std::uint32_t cached = 1 << 12; // particles per pass, to stay in cache
        all_.clear();
        all_.reserve(2 *
                     links_of(component)); // upper bound, without sharing; growing would take up to twice the memory
        begin_.assign(1, 0);
        list_of_.resize(particles);
        const auto tiles = std::span(plan_.tiles).subspan(component.first_tile, component.tiles);
        for (std::uint32_t first = 0, last; first < tiles.size(); first = last) {
            for (last = first + 1; last < tiles.size() && tiles[last].last - tiles[first].first < cached;) ++last;
            list_bands(component, first, last);
        }
    }
    void forget() {
        all_ = std::vector<Spoke>();
        near_ = RowLists<Spoke>();
        for (auto* numbers : {&begin_, &list_of_}) *numbers = std::vector<std::uint32_t>();
    }

    /// Last spoke with a slot offset, or null.
    static const Spoke* find(std::span<const Spoke> spokes, std::uint32_t offset) {
        for (auto i = spokes.size(); i-- > 0;)
            if (spokes[i].offset == offset) return &spokes[i];
        return nullptr;
    }
    std::span<const Spoke> of(std::uint32_t s) const { return spokes(list_of(s)); }
    std::uint32_t list_of(std::uint32_t s) const { return list_of_[s]; }
    /// Number of spokes in all lists.
    std::size_t size() const { return all_.size(); }
    std::size_t number_of(const Spoke& spoke) const { return std::size_t(&spoke - all_.data()); }
    double longest() const {
        double longest = 0;
        for (const auto& spoke : all_) longest = max(longest, double(spoke.length));
        return longest;
    }

  private:
    const Constraints<Distance<D>, Real>& distances_;
    const Plan<Real>& plan_;
    std::vector<Spoke> all_;           ///< all lists, concatenated
    std::vector<std::uint32_t> begin_; ///< start of each list, and the end of the last
    std::vector<std::uint32_t> list_of_;
    RowLists<Spoke> near_; ///< of the particles of some tiles

    std::span<const Spoke> spokes(std::size_t list) const {
        return std::span(all_).subspan(begin_[list], begin_[list + 1] - begin_[list]);
    }

    std::size_t links_of(const Component& component) const {
        const auto end = plan_.end_of(component).run;
        std::size_t links = 0;
        for (auto run = component.begin.run; run < end; ++run) links += plan_.runs[run].count;
        return links;
    }

    /// Lists the particles of tiles [first, last) of the component.
    void list_bands(const Component& component, std::uint32_t first, std::uint32_t last) {
        const auto begin = plan_.tiles[component.first_tile + first].first - component.begin.slot;
        const auto count = plan_.tiles[component.first_tile + last - 1].last - component.begin.slot - begin;
        near_.fill(count, [&](auto&& visit) {
            each_rigid(component, first, last, [&](Row link, std::uint32_t a, std::uint32_t b) {
                const Real length = distances_.high(link);
                if (a - begin < count) visit(a - begin, Spoke{b - a, length});
                if (b - begin < count) visit(b - begin, Spoke{a - b, length});
            });
        });
        for (std::uint32_t s = 0; s < count; ++s) {
            all_.insert(all_.end(), near_[s].begin(), near_[s].end());
            list_of_[begin + s] = share_last_list(begin + s);
        }
    }

    /// Gives particle s the entries behind the last list: an equal list, of the particle before or among the last 64,
    /// is shared; otherwise the entries become a new list. Returns the list's number.
    std::uint32_t share_last_list(std::uint32_t s) {
        constexpr std::size_t window = 64;
        const auto lists = begin_.size() - 1;
        const auto own = std::span<const Spoke>(all_).subspan(begin_.back());
        const auto is_own = [&](std::size_t list) {
            const auto other = spokes(list);
            return std::equal(own.begin(), own.end(), other.begin(), other.end());
        };
        auto found = s > 0 && is_own(list_of_[s - 1]) ? list_of_[s - 1] : lists;
        for (auto list = lists; found == lists && list > 0 && lists - list < window;)
            if (is_own(--list)) found = list;
        if (found == lists)
            begin_.push_back(std::uint32_t(all_.size()));
        else
            all_.resize(begin_.back());
        return std::uint32_t(found);
    }

    /// Calls visit(row, a, b) for rigid links into tiles [first, last), and others of the same tiles, in the order of
    /// the plan.
    template <class Visit>
    void each_rigid(const Component& component, std::uint32_t first, std::uint32_t last, Visit&& visit) const {
        for (auto f = component.first_color; f < component.first_color + component.colors; ++f) {
            const auto* const first_batch = plan_.first_batch.data() + plan_.colors[f].first_batch;
            const auto from = first - std::min(first, plan_.colors[f].tile_span);
            for (auto run = first_batch[from]; run < first_batch[last]; ++run)
                plan_.each_link(plan_.runs[run], [&](Row link, std::uint32_t a, std::uint32_t b) {
                    if (distances_.is_rigid(link) && distances_.high(link) < limit::coordinate<Real>)
                        visit(link, a - component.begin.slot, b - component.begin.slot);
                });
        }
    }
};

} // namespace sinew::detail
