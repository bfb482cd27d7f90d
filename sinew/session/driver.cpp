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

Point as_point(const Vec3<double>& place) {
    return {{place[0], place[1], place[2]}};
}

/// Where it is on its way through the keys, which begins at rest at time 0.
Point along(std::span<const Keyframe> keys, const Point& rest, double time, bool is_smooth, bool repeats) {
    if (keys.empty()) return rest;
    const double end = keys.back().at;
    if (repeats && end > 0) time -= end * std::floor(time / end);
    if (time >= end) return keys.back().to;
    std::size_t next = 0; // the first key still ahead
    while (keys[next].at <= time) ++next;
    const auto place = [&](std::ptrdiff_t i) {
        const auto last = std::ptrdiff_t(keys.size()) - 1;
        return in_space(i < 0 ? rest : keys[std::size_t(i > last ? last : i)].to);
    };
    const auto to = std::ptrdiff_t(next);
    const double since = next == 0 ? 0 : keys[next - 1].at;
    const double share = (time - since) / (keys[next].at - since);
    if (is_smooth) return as_point(catmull_rom(place(to - 2), place(to - 1), place(to), place(to + 1)).at(share));
    return as_point(place(to - 1) + (place(to) - place(to - 1)) * share);
}

struct PlaceOf {
    const Point& rest;
    double time;
    int up;

    Point operator()(const OrbitDriver& orbit) const {
        const double angle = orbit.phase + orbit.rate * time;
        Point place = rest;
        place[0] += orbit.radius * cosine(angle);
        place[1] += orbit.radius * sine(angle) * up;
        return place;
    }
    Point operator()(const BobDriver& bob) const {
        Point place = rest;
        for (int i = 0; i < 3; ++i) place[i] += bob.by[i] * sine(turn * time / bob.period[i] + bob.phase);
        return place;
    }
    Point operator()(const PathDriver& path) const { return along(path.keys, rest, time, path.smooth, path.repeat); }
    Point operator()(const PointerDriver& path) const { return along(path.keys, rest, time, path.smooth, path.repeat); }
};

} // namespace

Point driven_to(const Driver& driver, const Point& rest, double time, int up) {
    return std::visit(PlaceOf{rest, time, up}, driver);
}

} // namespace sinew
