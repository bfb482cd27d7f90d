#include "sinew/picture/piece_renderer.h"

#include "sinew/math/trig.h"

#include <algorithm>
#include <array>

namespace sinew {
namespace {

/// Longest straight part of a flattened band, nominal pixels.
constexpr float longest_part = 4;

/// Width of a band as a function of the arc length's fraction in [0, 1], pixels.
struct Thickness {
    const ProjectedPiece& piece;
    std::span<const double> profile;
    float thicker = 0;

    float operator()(float share) const {
        return (piece.width + (piece.end_width - piece.width) * share) * thickness_at(profile, share) + thicker;
    }
};

Vec2<float> turned(Vec2<float> v, double angle) {
    const auto c = float(cosine(angle)), s = float(-sine(angle)); // counter-clockwise on screen, where y points down
    return {{c * v[0] - s * v[1], s * v[0] + c * v[1]}};
}

float distance_to_segment(Vec2<float> point, Vec2<float> a, Vec2<float> b) {
    const float share = dot(point - a, b - a) * inverse_or_zero(dot(b - a, b - a));
    return distance(point, a + (b - a) * clamp(share, 0.0F, 1.0F));
}

/// Even-odd rule: a ray to the right crosses the outline an odd number of times.
bool is_inside(Vec2<float> point, std::span<const Vec2<float>> outline) {
    bool inside = false;
    for (std::size_t i = 0, last = outline.size() - 1; i < outline.size(); last = i++) {
        const auto &a = outline[i], &b = outline[last];
        if ((a[1] > point[1]) == (b[1] > point[1])) continue;
        if (point[0] < a[0] + (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1])) inside = !inside;
    }
    return inside;
}

} // namespace

void PieceRenderer::paint(const ProjectedPiece& piece, const Style& style, float thicker, const Color& color) {
    const auto& points = piece.points;
    const float width = piece.width + thicker;
    switch (piece.mark) {
    case Mark::stroke:
        if (piece.end_width != piece.width) return paint_tapered(piece, thicker, color);
        return picture_.add(Shape::polyline, points, width, color);
    case Mark::curve:
        smooth(points, shape_);
        return picture_.add(Shape::polyline, shape_, width, color);
    case Mark::limb:
        return paint_band(piece, style.profile, thicker, color);
    case Mark::tip:
        if (!points.empty()) picture_.add(Shape::disc, std::span(&points.back(), 1), width, color);
        return;
    case Mark::loop:
        return picture_.add(Shape::loop, points, width, color);
    case Mark::ring: {
        if (points.size() != 2) return;
        constexpr float wire = 0.3F; // fraction of the ring's width
        ring(points[0], points[1], piece.width, piece.width * wire, shape_);
        return picture_.add(Shape::loop, shape_, piece.width * wire + thicker, color);
    }
    case Mark::dot:
        for (const auto& point : points) picture_.add(Shape::disc, std::span(&point, 1), width, color);
        return;
    case Mark::face:
        return;
    case Mark::fill:
    case Mark::surface:
    case Mark::fragment:
        shape_ = points;
        widen(shape_, thicker / 2);
        return picture_.add(Shape::polygon, shape_, 0, color);
    }
}

void PieceRenderer::paint_tapered(const ProjectedPiece& piece, float thicker, const Color& color) {
    const Thickness width{piece, {}, thicker};
    const auto last = float(piece.points.size() - 1);
    for (std::size_t i = 0; i + 1 < piece.points.size(); ++i) {
        taper(piece.points[i], width(float(i) / last), piece.points[i + 1], width(float(i + 1) / last), shape_);
        picture_.add(Shape::polygon, shape_, 0, color);
    }
}

/// A single polyline where the width is constant, otherwise a row of tapered pieces that overlap in discs.
void PieceRenderer::paint_band(const ProjectedPiece& piece, std::span<const double> profile, float thicker,
                               const Color& color) {
    limb_along(piece.points, bends_);
    lay_out(bends_, 1, longest_part * unit_, spine_);
    const Thickness width{piece, profile, thicker};
    if (profile.empty() && piece.end_width == piece.width)
        return picture_.add(Shape::polyline, spine_.position, width(0), color);
    for (std::size_t i = 0; i + 1 < spine_.size(); ++i) {
        taper(spine_.position[i], width(spine_.share(i)), spine_.position[i + 1], width(spine_.share(i + 1)), shape_);
        picture_.add(Shape::polygon, shape_, 0, color);
    }
}

void PieceRenderer::paint_image(const ProjectedPiece& piece, const ImageLook& look, std::span<const double> profile,
                                std::uint32_t number, float larger, const Color& over) {
    const auto& points = piece.points;
    const Vec2<float> as_wide{{piece.width, piece.width / aspect(number)}};
    switch (piece.mark) {
    case Mark::dot:
        for (const auto& point : points) paint_sprite(piece, look, number, point, {{1, 0}}, as_wide, larger, over);
        return;
    case Mark::tip:
        limb_along(points, bends_);
        lay_out(bends_, 1, longest_part * unit_, spine_);
        if (spine_.size() > 0)
            paint_sprite(piece, look, number, spine_.position.back(), spine_.along.back(), as_wide, larger, over);
        return;
    case Mark::stroke:
    case Mark::ring:
        if (points.size() == 2) {
            const float length = distance(points[0], points[1]);
            return paint_sprite(piece, look, number, (points[0] + points[1]) * 0.5F, direction(points[1] - points[0]),
                                {{length, length / aspect(number)}}, larger, over);
        }
        return paint_strip(piece, look, profile, number, larger, over);
    case Mark::limb:
    case Mark::curve:
        return paint_strip(piece, look, profile, number, larger, over);
    case Mark::fill:
        if (points.size() == 4) paint_quad(points, number, over);
        return;
    case Mark::loop:
    case Mark::surface:
    case Mark::fragment:
    case Mark::face:
        return;
    }
}

void PieceRenderer::paint_sprite(const ProjectedPiece& piece, const ImageLook& look, std::uint32_t number,
                                 Vec2<float> middle, Vec2<float> along, Vec2<float> usual_size, float larger,
                                 const Color& over) {
    if (along == Vec2<float>{}) along = {{1, 0}};
    auto size = usual_size;
    if (look.size) size = {{float((*look.size)[0]) * piece.scale, float((*look.size)[1]) * piece.scale}};
    middle +=
        along * (float(look.shift[0]) * piece.scale) + perpendicular(along) * (float(look.shift[1]) * piece.scale);
    const auto grown = [&](float length) { return (length < 0 ? length - larger : length + larger) / 2; };
    const auto right = turned(along, look.turn) * grown(size[0]);
    const auto below = turned(perpendicular(along), look.turn) * grown(size[1]);
    const std::array corners = {middle - right - below, middle + right - below, middle - right + below,
                                middle + right + below};
    picture_.add_image(number, corners, 2, over);
}

/// A limb takes the image once, with the image's top on the left-hand side; a rope repeats the image a whole number of
/// times.
void PieceRenderer::paint_strip(const ProjectedPiece& piece, const ImageLook& look, std::span<const double> profile,
                                std::uint32_t number, float larger, const Color& over) {
    const bool once = piece.mark == Mark::limb;
    if (once)
        limb_along(piece.points, bends_);
    else
        rope_through(piece.points, bends_);
    ProjectedPiece thick = piece;
    if (look.size) thick.width = thick.end_width = float(absolute((*look.size)[1])) * piece.scale;
    lay_out(bends_, 1, longest_part * unit_, spine_);
    if (spine_.size() == 0) return;
    std::size_t times = 1, steps = spine_.size() - 1;
    if (!once) {
        const float usual = thick.width * aspect(number);
        const float one = look.size ? float(absolute((*look.size)[0])) * piece.scale : usual;
        times = std::size_t(clamp(spine_.length * inverse_or_zero(one), 1.0F, float(max_parts)) + 0.5F);
        steps = std::max(steps / times, std::size_t(2));
        lay_out(bends_, steps * times, spine_.length, spine_);
    }
    Pixels sides;
    sides_of(spine_, Thickness{thick, profile, larger}, sides);
    for (std::size_t i = 0; i < times && spine_.size() > 1; ++i) {
        // Rows of the image run along the band: row 0 is the left side, row 1 the right side.
        shape_.clear();
        for (const std::size_t side : {0U, 1U})
            for (std::size_t k = i * steps; k <= (i + 1) * steps; ++k) shape_.push_back(sides[2 * k + side]);
        picture_.add_image(number, shape_, std::uint32_t(steps + 1), over);
    }
}

/// The image mapped bilinearly onto four corners, which go round from the image's top left.
void PieceRenderer::paint_quad(std::span<const Vec2<float>> corners, std::uint32_t number, const Color& over) {
    constexpr float finest = 16; // nominal pixels
    float side = 0;
    for (std::size_t i = 0; i < 4; ++i) side = max(side, distance(corners[i], corners[(i + 1) % 4]));
    const bool flat = norm(corners[0] - corners[1] + corners[2] - corners[3]) < 0.01F * side;
    const int parts = flat ? 1 : int(clamp(side / (finest * unit_), 4.0F, 12.0F));
    shape_.clear();
    for (int row = 0; row <= parts; ++row)
        for (int column = 0; column <= parts; ++column) {
            const float u = float(column) / float(parts), v = float(row) / float(parts);
            shape_.push_back((corners[0] * (1 - u) + corners[1] * u) * (1 - v) +
                             (corners[3] * (1 - u) + corners[2] * u) * v);
        }
    picture_.add_image(number, shape_, std::uint32_t(parts + 1), over);
}

bool PieceRenderer::covers(const ProjectedPiece& piece, Vec2<float> pixel) {
    constexpr float min_radius = 4; // nominal pixels, the radius around thinner pieces
    const float radius = max(piece.width / 2, min_radius * unit_);
    const auto& points = piece.points;
    if (points.empty()) return false;
    if (piece.mark == Mark::fill || is_cloth(piece.mark)) return is_inside(pixel, points);
    if (piece.mark == Mark::tip) return distance(pixel, points.back()) <= radius;
    std::span<const Vec2<float>> line = points;
    if (piece.mark == Mark::limb) {
        limb_along(points, bends_);
        lay_out(bends_, 1, longest_part * unit_, spine_);
        line = spine_.position;
    }
    if (piece.mark == Mark::dot || line.size() == 1)
        return std::any_of(line.begin(), line.end(), [&](const auto& p) { return distance(pixel, p) <= radius; });
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (distance_to_segment(pixel, line[i], line[i + 1]) <= radius) return true;
    return piece.mark == Mark::loop && distance_to_segment(pixel, line.back(), line.front()) <= radius;
}

float PieceRenderer::aspect(std::uint32_t number) const {
    const auto& image = *picture_.images[number];
    return float(image.width) / float(image.height);
}

} // namespace sinew
