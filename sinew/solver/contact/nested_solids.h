#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/candidate_search.h"
#include "sinew/solver/contact/solids.h"

namespace sinew::detail {

/// Pairs of convex solids that overlap by more than their radii at the start of a step: figures that begin inside each
/// other. All their corners and sides are listed, however far inside. The pairs follow from the places alone.
template <int D, class Real> class NestedSolids {
  public:
    NestedSolids(World<D, Real>& world, ContactRoom<D, Real>& room, const SweepState<D, Real>& state)
        : room_(room), search_(world, room), solids_(room, state) {}

    /// Sorts the solids along the first axis and looks at those whose boxes overlap.
    void find() {
        auto& list = room_.list;
        list.boxes.clear();
        for (std::uint32_t i = 0; i < room_.segments.size(); ++i)
            if (room_.segments[i].side != 0 && room_.segments[i].first == i) add(i);
        sinew::sort(list.boxes.begin(), list.boxes.end(), [](const auto& a, const auto& b) {
            return a.box.low[0] != b.box.low[0] ? a.box.low[0] < b.box.low[0] : a.solid < b.solid;
        });
        list.found_nested.clear();
        for (std::size_t i = 0; i < list.boxes.size(); ++i)
            for (auto k = i + 1; k < list.boxes.size() && list.boxes[k].box.low[0] < list.boxes[i].box.high[0]; ++k)
                look_at(list.boxes[i], list.boxes[k]);
        sinew::sort(list.found_nested.begin(), list.found_nested.end());
        list.is_valid = list.is_valid && list.nested == list.found_nested;
        list.nested.swap(list.found_nested);
    }

  private:
    ContactRoom<D, Real>& room_;
    CandidateSearch<D, Real> search_;
    Solids<D, Real> solids_;

    void add(std::uint32_t solid) { room_.list.boxes.push_back({solids_.box_of(solid), solid}); }
    void look_at(const SolidBox<D, Real>& a, const SolidBox<D, Real>& b) {
        if (!(a.box.low[1] < b.box.high[1] && b.box.low[1] < a.box.high[1])) return;
        const auto &one = room_.segments[a.solid], &other = room_.segments[b.solid];
        if (search_.may_meet(one.number_a, other) && solids_.overlap(a.solid, b.solid))
            room_.list.found_nested.push_back({std::min(a.solid, b.solid), std::max(a.solid, b.solid)});
    }
};

} // namespace sinew::detail
