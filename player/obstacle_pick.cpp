#include "player/obstacle_pick.h"

#include "sinew/math/trig.h"
#include "sinew/scene/types.h"

#include <limits>

namespace sinew::play {
namespace {

double distance_to(Vec2<double> point, Vec2<double> a, Vec2<double> b) {
    const double share = dot(point - a, b - a) * inverse_or_zero(dot(b - a, b - a));
    return distance(point, a + (b - a) * clamp(share, 0.0, 1.0));
}

bool is_inside(const std::vector<Vec2<double>>& corners, Vec2<double> at) {
    bool odd = false;
    for (std::size_t i = 0, before = corners.size() - 1; i < corners.size(); before = i++) {
        const auto &p = corners[i], &q = corners[before];
        if ((p[1] > at[1]) != (q[1] > at[1]) && at[0] < (q[0] - p[0]) * (at[1] - p[1]) / (q[1] - p[1]) + p[0])
            odd = !odd;
    }
    return odd;
}

void add_round(std::vector<Vec2<double>>& corners, Vec2<double> middle, double radius, double from, double to) {
    constexpr int parts = 12;
    for (int i = 0; i <= parts; ++i) {
        const double angle = from + (to - from) * i / parts;
        corners.push_back(middle + Vec2<double>{{cosine(angle), sine(angle)}} * radius);
    }
}

Vec2<double> flat(const Point& point) {
    return {{point[0], point[1]}};
}

struct Outline {
    std::vector<Vec2<double>> corners;

    void operator()(const HalfSpaceShape&) {}
    void operator()(const HeightFieldShape&) {}
    void operator()(const MeshShape&) {}
    void operator()(const SphereShape& sphere) { add_round(corners, {}, sphere.radius, 0, 2 * pi<double>); }
    void operator()(const CapsuleShape& capsule) {
        const auto along = flat(capsule.to) - flat(capsule.from);
        const double angle = arctangent(along[1], along[0]);
        add_round(corners, flat(capsule.to), capsule.radius, angle - pi<double> / 2, angle + pi<double> / 2);
        add_round(corners, flat(capsule.from), capsule.radius, angle + pi<double> / 2, angle + 1.5 * pi<double>);
    }
    void operator()(const BoxShape& box) {
        for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
            corners.push_back({{x * box.size[0], y * box.size[1]}});
    }
    void operator()(const PolygonShape& polygon) {
        for (const auto& point : polygon.points) corners.push_back(flat(point));
    }
    void operator()(const ChainShape& chain) {
        for (const auto& point : chain.points) corners.push_back(flat(point));
    }
};

} // namespace

std::vector<Vec2<double>> outline_of(const ColliderSection& obstacle, double up) {
    Outline outline;
    detail::visit_held(obstacle.shape, outline);
    const double c = cosine(obstacle.turn), s = sine(obstacle.turn) * up;
    for (auto& corner : outline.corners)
        corner = flat(obstacle.at) + Vec2<double>{{c * corner[0] - s * corner[1], s * corner[0] + c * corner[1]}};
    return outline.corners;
}

std::optional<std::size_t> obstacle_at(const Scene& scene, const View& view, Vec2<double> pixel, double radius) {
    if (scene.dimension == 3) return std::nullopt;
    const auto at = view.position_of(pixel);
    const double near = radius / view.scale();
    for (std::size_t i = scene.colliders.size(); i-- > 0;) {
        const auto corners = outline_of(scene.colliders[i], scene.units.up == "-y" ? -1 : 1);
        if (corners.size() < 2) continue;
        const auto* chain = std::get_if<ChainShape>(&scene.colliders[i].shape);
        const bool is_open = chain && !chain->closed;
        if (!is_open && is_inside(corners, at)) return i;
        for (std::size_t k = 0; k + (is_open ? 1 : 0) < corners.size(); ++k)
            if (distance_to(at, corners[k], corners[(k + 1) % corners.size()]) <= near) return i;
    }
    return std::nullopt;
}

} // namespace sinew::play
