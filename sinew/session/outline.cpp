#include "sinew/session/outline.h"

#include "sinew/math/bezier.h"
#include "sinew/math/trig.h"

namespace sinew {
namespace {

/// Points of an arc around a center, from one direction to another, angles in radians.
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

} // namespace

void smooth(std::span<const Vec2<float>> points, Pixels& curve) {
    curve.clear();
    if (points.empty()) return;
    constexpr float piece = 4; // pixels, as long as a straight part may be
    constexpr int most = 8;
    const std::size_t last = points.size() - 1;
    for (std::size_t i = 0; i < last; ++i) {
        const auto bend =
            catmull_rom(points[i == 0 ? 0 : i - 1], points[i], points[i + 1], points[i + 2 > last ? last : i + 2]);
        const int parts = 1 + int(minimum(distance(points[i], points[i + 1]) / piece, float(most - 1)));
        for (int part = 0; part < parts; ++part) curve.push_back(bend.at(float(part) / float(parts)));
    }
    curve.push_back(points[last]);
}

void taper(Vec2<float> from, float from_width, Vec2<float> to, float to_width, Pixels& shape) {
    shape.clear();
    const float length = distance(from, to), narrowing = (from_width - to_width) / 2;
    if (length <= absolute(narrowing))
        return add_arc(from, maximum(from_width, to_width) / 2, 0, 2 * pi<double>, shape);
    // both discs are touched by the sides where the radius is at this angle to the way from one to the other
    const double side = arctangent(double(square_root(square(length) - square(narrowing))), double(narrowing));
    const double ahead = heading(from, to);
    add_arc(from, from_width / 2, ahead + side, ahead + 2 * pi<double> - side, shape);
    add_arc(to, to_width / 2, ahead - side, ahead + side, shape);
}

void ring(Vec2<float> from, Vec2<float> to, float width, float wire, Pixels& loop) {
    loop.clear();
    const float radius = maximum((width - wire) / 2, 0.5F);
    const auto along = direction(to - from) * (radius - wire / 2); // the ends' wires hold the next rings'
    const double ahead = heading(from, to), quarter = pi<double> / 2;
    add_arc(from + along, radius, ahead + quarter, ahead + 3 * quarter, loop);
    add_arc(to - along, radius, ahead - quarter, ahead + quarter, loop);
}

void widen(Pixels& shape, float by) {
    Vec2<float> middle{};
    for (const auto& point : shape) middle += point;
    middle *= 1 / float(shape.empty() ? 1 : shape.size());
    for (auto& point : shape)
        point += Vec2<float>::map([&](int i) { return clamp(point[i] - middle[i], -1.0F, 1.0F) * by; });
}

} // namespace sinew
