#pragma once

#include "sinew/solver/cloth/thin_room.h"

#include <algorithm>

namespace sinew::detail {

/// Truncation of displacements at planes that part the pairs which are near.
template <class Real> class Truncation {
  public:
    explicit Truncation(ThinRoom<3, Real>& room) : room_(room) {}

    /// Truncates until all pairs are parted; true if a displacement has changed.
    bool separate_all() {
        any_truncated_ = false;
        for (bool any = true; any;) {
            any = separate(room_.pairs[0]);
            any = separate(room_.pairs[1]) || any;
        }
        return any_truncated_;
    }

  private:
    ThinRoom<3, Real>& room_;
    bool any_truncated_ = false;

    /// Gap that a pair keeps.
    Real kept_gap(Real distance) const {
        constexpr Real share = Real(0.2);
        return min(max(share * distance, room_.min_gap), distance);
    }
    /// Truncates the moves of pairs that their normal would not part at the end of the substep; false if there are
    /// none. A plane that parts both ends of a linear motion parts everything between.
    bool separate(FeaturePairs<Real>& pairs) {
        room_.tail.clear();
        for (std::uint32_t i = 0; i < pairs.near.size(); ++i)
            if (const auto& pair = pairs.near[i];
                !pair.is_fixed &&
                !(pair.is_parted && gap_ahead(room_, pair, pairs.first_side) >= kept_gap(pair.distance)))
                room_.tail.push_back(i);
        std::sort(room_.tail.begin(), room_.tail.end(),
                  [&](auto a, auto b) { return pairs.near[a].vertex < pairs.near[b].vertex; });
        for (const auto i : room_.tail) {
            pairs.near[i].is_fixed = true;
            fix(pairs.near[i], pairs.first_side);
        }
        return !room_.tail.empty();
    }
    /// From now on the plane in the middle stays: each side stops before it.
    void fix(NearPair<Real>& pair, std::size_t first_side) {
        if (!pair.is_parted || gap_of(pair.height, first_side) < Real(0.5) * pair.distance)
            find_direction(pair, first_side);
        const Real distance = gap_of(pair.height, first_side);
        if (distance < Real(1e-3) * room_.min_gap) return; // in touch from the beginning: no side to stay on
        const Real half = Real(0.5) * kept_gap(distance);
        const Real low = first_side == 2 ? min(pair.height[0], pair.height[1]) : pair.height[0];
        const Real middle = low - Real(0.5) * distance;
        for (std::size_t i = 0; i < 4; ++i) {
            const Real side = i < first_side ? Real(1) : Real(-1);
            auto& displacement = room_.vertices[pair.vertex[i]].displacement;
            const Real room = side * (pair.height[i] - middle) - half, along = side * dot(pair.normal, displacement);
            if (along >= Real(0) || room + along >= Real(0)) continue;
            displacement *= clamp(Real(-0.99) * room / along, Real(0), Real(1));
            any_truncated_ = true;
        }
    }
    void find_direction(NearPair<Real>& pair, std::size_t first_side) const {
        FeatureCorners<double> corner;
        for (std::size_t i = 0; i < 4; ++i) corner[i] = cast<double>(room_.vertices[pair.vertex[i]].position);
        const auto direction = PartingDirection(corner, first_side).find();
        pair.normal = cast<Real>(direction);
        for (std::size_t i = 0; i < 4; ++i) pair.height[i] = Real(dot(direction, corner[i] - corner[0]));
    }
};

} // namespace sinew::detail
