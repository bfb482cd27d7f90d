#include "sinew/picture/outline.h"

#include "sinew/math/bezier.h"
#include "sinew/math/trig.h"

namespace sinew {
namespace {

/// Points of an arc around `center` from one angle to another, radians.
void add_arc(Vec2<float> center, float radius, double from, double to, Pixels& points) {
    constexpr int steps = 8;
    for (int i = 0; i <= steps; ++i) {
        const double angle = from + (to - from) * i / steps;
        points.push_back(center + Vec2<float>{{float(cosine(angle)), float(sine(angle))}} * radius);
    }
}

double heading(Vec2<float> from, Vec2<float> to) {
    return arctangent(double(to[1] - from[1]), double(to[0] - from[0]));
}

/// Signed area: positive if the shape turns from x to y.
float area(std::span<const Vec2<float>> shape) {
    float twice = 0;
    for (std::size_t i = 0; i < shape.size(); ++i)
        twice += dot(perpendicular(shape[i]), shape[i + 1 < shape.size() ? i + 1 : 0]);
    return twice / 2;
}

} // namespace

void smooth(std::span<const Vec2<float>> points, Pixels& curve) {
    curve.clear();
    if (points.empty()) return;
    constexpr float piece = 4, off = 0.1F; // pixels: shortest useful chord, and largest error of the polyline
    constexpr int max_parts = 8;
    const std::size_t last = points.size() - 1;
    for (std::size_t i = 0; i < last; ++i) {
        const auto bend =
            catmull_rom(points[i == 0 ? 0 : i - 1], points[i], points[i + 1], points[i + 2 > last ? last : i + 2]);
        // n chords of a cubic have an error of at most 0.75 bent / n^2, where 6 `bent` bounds the second derivative
        const float bent = max(norm(bend.a - bend.b * 2 + bend.c), norm(bend.b - bend.c * 2 + bend.d));
        const float needed = min(square_root(0.75F * bent / off), distance(points[i], points[i + 1]) / piece);
        const int parts = 1 + int(clamp(needed, 0.0F, float(max_parts - 1)));
        for (int part = 0; part < parts; ++part) curve.push_back(bend.at(float(part) / float(parts)));
    }
    curve.push_back(points[last]);
}

void taper(Vec2<float> from, float from_width, Vec2<float> to, float to_width, Pixels& shape) {
    shape.clear();
    const float length = distance(from, to), narrowing = (from_width - to_width) / 2;
    if (length <= absolute(narrowing)) return add_arc(from, max(from_width, to_width) / 2, 0, 2 * pi<double>, shape);
    // angle between the line of centres and the radii to the points where the common tangents touch both discs
    const double side = arctangent(double(square_root(square(length) - square(narrowing))), double(narrowing));
    const double ahead = heading(from, to);
    add_arc(from, from_width / 2, ahead + side, ahead + 2 * pi<double> - side, shape);
    add_arc(to, to_width / 2, ahead - side, ahead + side, shape);
}

void ring(Vec2<float> from, Vec2<float> to, float width, float wire, Pixels& loop) {
    loop.clear();
    const float radius = max((width - wire) / 2, 0.5F);
    const auto along = direction(to - from) * (radius - wire / 2); // neighbouring rings interlock
    const double ahead = heading(from, to), quarter = pi<double> / 2;
    add_arc(from + along, radius, ahead + quarter, ahead + 3 * quarter, loop);
    add_arc(to - along, radius, ahead - quarter, ahead + quarter, loop);
}

void widen(Pixels& shape, float by) {
    if (shape.empty()) return;
    constexpr float longest = 3; // miter limit at sharp corners, in multiples of `by`
    const auto is_at = [](Vec2<float> a, Vec2<float> b) { return dot(b - a, b - a) < 1e-6F; };
    const auto first = shape.front();
    auto before = shape.back();
    for (std::size_t i = shape.size(); i-- > 0 && is_at(before, first);) before = shape[i];
    const float outward = area(shape) < 0 ? -by : by;
    auto from = perpendicular(direction(first - before));
    for (std::size_t i = 0; i < shape.size(); ++i) {
        auto next = i + 1;
        while (next < shape.size() && is_at(shape[next], shape[i])) ++next;
        const auto point = shape[i], after = next < shape.size() ? shape[next] : first;
        const auto to = perpendicular(direction(after - point));
        const float straight = max(1 + dot(from, to), 2 / square(longest));
        shape[i] -= (from + to) * (outward / straight);
        if (!is_at(after, point) && next == i + 1)
            before = point, from = to;
        else if (i + 1 < shape.size())
            from = perpendicular(direction(shape[i + 1] - before));
    }
}

} // namespace sinew
