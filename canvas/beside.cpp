#include "canvas/beside.h"

#include "sinew/picture/theme.h"

#include <algorithm>
#include <array>

namespace sinew::canvas {
namespace {

/// Sizes beside pictures of the nominal height, nominal pixels; proportional to the height.
constexpr double space_between = 4, caption = 26, letters = 14;

int scaled(double nominal, int height) {
    return std::max(1, int(nominal * height / Picture::nominal_height + 0.5));
}

bool is_light(const Color& color) {
    return 0.30F * color.red + 0.59F * color.green + 0.11F * color.blue > 0.5F;
}

/// Appends the items of `part`, shifted by `offset`; indices of points, images and texts are renumbered.
void append(const Picture& part, Vec2<float> offset, Picture& whole) {
    const auto first_point = std::uint32_t(whole.points.size());
    const auto first_image = std::uint32_t(whole.images.size()), first_text = std::uint32_t(whole.texts.size());
    for (auto item : part.items) {
        item.first += first_point;
        if (item.shape == Shape::image) item.number += first_image;
        if (item.shape == Shape::text) item.number += first_text;
        whole.items.push_back(item);
    }
    for (const auto& point : part.points) whole.points.push_back(point + offset);
    whole.images.insert(whole.images.end(), part.images.begin(), part.images.end());
    whole.texts.insert(whole.texts.end(), part.texts.begin(), part.texts.end());
}

} // namespace

BesideSize size_beside(std::size_t count, int width, int height) {
    return {int(count) * width + int(count - 1) * scaled(space_between, height), height + scaled(caption, height)};
}

void put_beside(std::span<const Labelled> parts, Picture& whole) {
    const auto& first = *parts.front().picture;
    const auto& theme = theme_called(is_light(first.background) ? "light" : "dark");
    const auto size = size_beside(parts.size(), first.width, first.height);
    const float above = float(size.height - first.height);
    whole.clear();
    whole.images.clear();
    whole.width = size.width, whole.height = size.height;
    whole.background = theme.ground;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const float left = float(i) * float(first.width + scaled(space_between, first.height));
        const Vec2<float> corner{{left, above}}, opposite{{left + float(first.width), above + float(first.height)}};
        whole.add_pane({{left, 0}}, {{opposite[0], above}}, theme.ground);
        whole.add_text(parts[i].label, {{(left + opposite[0]) / 2, above / 2}}, float(scaled(letters, first.height)),
                       theme.pen);
        whole.add_pane(corner, opposite, parts[i].picture->background);
        append(*parts[i].picture, corner, whole);
    }
}

void join(std::span<const Picture> parts, Picture& whole) {
    whole.clear();
    whole.images.clear();
    whole.width = 0, whole.height = parts.front().height;
    whole.background = parts.front().background;
    for (const auto& part : parts) {
        const Vec2<float> corner{{float(whole.width), 0}};
        whole.add_pane(corner, corner + Vec2<float>{{float(part.width), float(part.height)}}, part.background);
        append(part, corner, whole);
        whole.width += part.width;
    }
}

} // namespace sinew::canvas
