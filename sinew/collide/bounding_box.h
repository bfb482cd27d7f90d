#pragma once

#include "sinew/math/vec.h"

#include <limits>

namespace sinew::collide {

/// Axis-aligned box around something. Default-constructed: around nothing.
template <int D, class Real> struct BoundingBox {
    using Vector = Vec<D, Real>;
    static constexpr Real huge = std::numeric_limits<Real>::max() / Real(4);

    Vector low = Vector::map([](int) { return huge; });
    Vector high = Vector::map([](int) { return -huge; });

    static BoundingBox everything() {
        return {Vector::map([](int) { return -huge; }), Vector::map([](int) { return huge; })};
    }

    void include(const Vector& point) {
        for (int i = 0; i < D; ++i) low[i] = min(low[i], point[i]), high[i] = max(high[i], point[i]);
    }
    BoundingBox grown(Real by) const {
        const auto margin = Vector::map([by](int) { return by; });
        return {low - margin, high + margin};
    }
    bool overlaps(const BoundingBox& other) const {
        for (int i = 0; i < D; ++i)
            if (other.high[i] < low[i] || high[i] < other.low[i]) return false;
        return true;
    }
    bool contains(const Vector& point) const {
        for (int i = 0; i < D; ++i)
            if (point[i] < low[i] || high[i] < point[i]) return false;
        return true;
    }
};

} // namespace sinew::collide
