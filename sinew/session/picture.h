#pragma once

#include "sinew/math/color.h"
#include "sinew/math/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew {

enum class Shape : std::uint8_t {
    polyline, ///< `count` points joined by a stroke of `width` pixels, round caps and joins
    loop,     ///< the same, closed
    disc,     ///< one point, filled, `width` pixels in diameter
    polygon,  ///< `count` points, filled (even-odd)
};

/// A display list: what a session looks like now, in pixels of the target (x right, y down, origin at the top left
/// corner). Items are painted in order. All points lie in one column, so that a picture can be refilled without
/// allocating.
struct Picture {
    struct Item {
        Shape shape = Shape::polyline;
        std::uint32_t first = 0; ///< index of its first point
        std::uint32_t count = 0;
        float width = 1; ///< pixels
        Color color;
    };

    int width = 0;  ///< pixels
    int height = 0; ///< pixels
    Color background{1, 1, 1, 1};
    std::vector<Vec2<float>> points;
    std::vector<Item> items;

    void clear() {
        points.clear();
        items.clear();
    }

    void add(Shape shape, std::span<const Vec2<float>> outline, float width_px, Color color) {
        items.push_back({shape, std::uint32_t(points.size()), std::uint32_t(outline.size()), width_px, color});
        points.insert(points.end(), outline.begin(), outline.end());
    }

    std::span<const Vec2<float>> points_of(const Item& item) const {
        return std::span(points).subspan(item.first, item.count);
    }
};

} // namespace sinew
