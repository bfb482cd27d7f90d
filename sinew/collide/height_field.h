#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/pose.h"
#include "sinew/collide/triangle.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace sinew::collide {

/// Landscape over a grid in the x-z plane, solid below: y = height[row * columns + column] at x = column * spacing,
/// z = row * spacing. A cell is two triangles.
template <int D, class Real> struct HeightField {
    static_assert(D == 3);
    static constexpr std::string_view name = "height_field";
    using Vector = Vec<3, Real>;
    using Part = Triangle<Real>;
    std::uint32_t columns = 0;
    Real spacing = 1;
    std::vector<Real> height;

    std::uint32_t rows() const { return columns ? std::uint32_t(height.size()) / columns : 0; }
    Vector corner(std::uint32_t column, std::uint32_t row) const {
        return {{Real(column) * spacing, height[row * columns + column], Real(row) * spacing}};
    }

    BoundingBox<3, Real> bounds(const Pose<3, Real>& pose) const {
        BoundingBox<3, Real> box;
        for (std::uint32_t row = 0; row < rows(); ++row)
            for (std::uint32_t column = 0; column < columns; ++column) box.include(pose.to_world(corner(column, row)));
        return box;
    }

    template <class Visit> void parts_near(const BoundingBox<3, Real>& near, Visit&& visit) const {
        const auto [first_column, last_column] = cells(near.low[0], near.high[0], columns);
        const auto [first_row, last_row] = cells(near.low[2], near.high[2], rows());
        for (auto row = first_row; row < last_row; ++row)
            for (auto column = first_column; column < last_column; ++column) {
                const auto number = 2 * (row * columns + column);
                const auto a = corner(column, row), b = corner(column + 1, row), c = corner(column, row + 1),
                           d = corner(column + 1, row + 1);
                visit(Part{a, c, b, number});
                visit(Part{b, c, d, number + 1});
            }
    }

  private:
    struct Range {
        std::uint32_t first, last;
    };
    /// Cells between the grid lines 0 to lines - 1 that [low, high] touches, and cells beside a near line: on
    /// an edge or a corner all triangles around it count.
    Range cells(Real low, Real high, std::uint32_t lines) const {
        low -= share_behind<Real> * spacing, high += share_behind<Real> * spacing;
        const Real max = lines > 0 ? Real(lines - 1) : Real(0);
        const auto first = clamp(std::floor(low / spacing), Real(0), max);
        const auto last = clamp(std::floor(high / spacing) + Real(1), Real(0), max);
        return {std::uint32_t(first), std::uint32_t(last)};
    }
};

} // namespace sinew::collide
