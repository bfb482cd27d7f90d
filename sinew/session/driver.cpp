#include "sinew/session/driver.h"

#include "sinew/math/bezier.h"
#include "sinew/math/trig.h"

#include <cmath>
#include <span>

namespace sinew {
namespace {

constexpr double turn = 2 * pi<double>;

Vec3<double> in_space(const Point& point) {
    return point.as<3, double>();
}

Point as_point(const Vec3<double>& position) {
    return {{position[0], position[1], position[2]}};
}

/// Position at `time` on a path through the keys, which starts from `rest` at time 0.
Point along(std::span<const Keyframe> keys, const Point& rest, double time, bool is_smooth, bool repeats) {
    if (keys.empty()) return rest;
    const double end = keys.back().at;
    if (repeats && end > 0) time -= end * std::floor(time / end);
    if (time >= end) return keys.back().to;
    std::size_t next = 0; // first key after `time`
    while (keys[next].at <= time) ++next;
    const auto position = [&](std::ptrdiff_t i) {
        const auto last = std::ptrdiff_t(keys.size()) - 1;
        return in_space(i < 0 ? rest : keys[std::size_t(i > last ? last : i)].to);
    };
    const auto to = std::ptrdiff_t(next);
    const double since = next == 0 ? 0 : keys[next - 1].at;
    const double share = (time - since) / (keys[next].at - since);
    if (is_smooth)
        return as_point(catmull_rom(position(to - 2), position(to - 1), position(to), position(to + 1)).at(share));
    return as_point(position(to - 1) + (position(to) - position(to - 1)) * share);
}

struct PlaceOf {
    const Point& rest;
    double time;
    int up;

    Point operator()(const OrbitDriver& orbit) const {
        const double angle = orbit.phase + orbit.rate * time;
        Point position = rest;
        position[0] += orbit.radius * cosine(angle);
        position[1] += orbit.radius * sine(angle) * up;
        return position;
    }
    Point operator()(const BobDriver& bob) const {
        Point position = rest;
        for (int i = 0; i < 3; ++i) position[i] += bob.by[i] * sine(turn * time / bob.period[i] + bob.phase);
        return position;
    }
    Point operator()(const PathDriver& path) const { return along(path.keys, rest, time, path.smooth, path.repeat); }
    Point operator()(const PointerDriver& path) const { return along(path.keys, rest, time, path.smooth, path.repeat); }
};

} // namespace

Point driven_to(const Driver& driver, const Point& rest, double time, int up) {
    return std::visit(PlaceOf{rest, time, up}, driver);
}

} // namespace sinew
