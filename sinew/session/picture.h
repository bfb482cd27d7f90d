#pragma once

#include "sinew/math/color.h"
#include "sinew/math/vec.h"
#include "sinew/scene/image.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

enum class Shape : std::uint8_t {
    polyline, ///< `count` points joined by a stroke of `width` pixels, round caps and joins
    loop,     ///< the same, closed
    disc,     ///< one point, filled, `width` pixels in diameter
    polygon,  ///< `count` points, filled (even-odd)
    image,    ///< an image stretched evenly over a grid of points, rows of `across`; `color` lies over it where it is
    text,     ///< a line of text, its middle at one point, letters `width` pixels high
    pane      ///< the rectangle between two corners covered with the colour; later items are seen within it only
};

/// A display list: what a session looks like now, in pixels of the target (x right, y down, origin at the top left
/// corner). Items are painted in order. All points lie in one column, so that a picture can be refilled without
/// allocating.
struct Picture {
    static constexpr double nominal_height = 480; ///< pixels: sizes of letters, shadows and the like are told for it

    struct Item {
        Shape shape = Shape::polyline;
        std::uint32_t first = 0; ///< index of its first point
        std::uint32_t count = 0;
        float width = 1; ///< pixels
        Color color;
        std::uint32_t number = 0; ///< of the image or the text in its list
        std::uint32_t across = 0; ///< points in a row of an image's grid, from left to right
    };

    int width = 0;  ///< pixels
    int height = 0; ///< pixels
    Color background{1, 1, 1, 1};
    std::vector<Vec2<float>> points;
    std::vector<Item> items;
    std::vector<std::shared_ptr<const Image>> images; ///< those of the scene, whether or not they are seen
    std::vector<std::string> texts;

    void clear() {
        points.clear();
        items.clear();
        texts.clear();
    }

    void add(Shape shape, std::span<const Vec2<float>> outline, float width_px, Color color) {
        items.push_back({shape, std::uint32_t(points.size()), std::uint32_t(outline.size()), width_px, color});
        points.insert(points.end(), outline.begin(), outline.end());
    }

    /// Rows from the image's top to its bottom. A transparent colour leaves it as it is.
    void add_image(std::uint32_t number, std::span<const Vec2<float>> grid, std::uint32_t across, Color over) {
        add(Shape::image, grid, 0, over);
        items.back().number = number;
        items.back().across = across;
    }

    void add_text(std::string text, Vec2<float> middle, float height_px, Color color) {
        add(Shape::text, std::span(&middle, 1), height_px, color);
        items.back().number = std::uint32_t(texts.size());
        texts.push_back(std::move(text));
    }

    /// A picture within the picture: up to the next pane, items are seen within it only, letters on its paper.
    void add_pane(Vec2<float> corner, Vec2<float> opposite, Color paper) {
        const std::array corners = {corner, opposite};
        add(Shape::pane, corners, 0, paper);
    }

    std::span<const Vec2<float>> points_of(const Item& item) const {
        return std::span(points).subspan(item.first, item.count);
    }
};

} // namespace sinew
