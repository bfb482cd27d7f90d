#pragma once

#include "sinew/collide/point_grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::detail {

/// Balls of unequal radius around points, for search by boxes. The few of far more than the mean radius are kept apart,
/// else all searches would be as wide as theirs.
template <int D, class Real> class FeatureGrid {
  public:
    using Vector = Vec<D, Real>;

    void fill(std::span<const Vector> points, std::span<const Real> radii) {
        constexpr Real far_more = 4;
        Real sum = 0;
        for (const Real radius : radii) sum += radius;
        const Real mean = radii.empty() ? Real(1) : sum / Real(radii.size());
        usual_.clear(), numbers_.clear(), large_.clear();
        widest_ = 0;
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            if (radii[i] > far_more * mean) {
                large_.push_back(i);
                continue;
            }
            usual_.push_back(points[i]);
            numbers_.push_back(i);
            widest_ = maximum(widest_, radii[i]);
        }
        constexpr Real cell = 3; // mean radii: a search visits few cells, and few points in vain
        grid_.fill(usual_, mean > Real(0) ? cell * mean : Real(1));
    }

    /// Calls visit(number) for all points whose balls may meet the box, in no useful order.
    template <class Visit> void each_near(const collide::BoundingBox<D, Real>& box, Visit&& visit) const {
        grid_.each_near(box.grown(widest_), [&](std::uint32_t i) { visit(numbers_[i]); });
        for (const auto number : large_) visit(number);
    }

  private:
    collide::PointGrid<D, Real> grid_;
    std::vector<Vector> usual_;
    std::vector<std::uint32_t> numbers_, large_; ///< of the usual points; of the others
    Real widest_ = 0;                            ///< of the usual points
};

} // namespace sinew::detail
