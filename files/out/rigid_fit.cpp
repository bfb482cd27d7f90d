#include "files/out/rigid_fit.h"

#include "sinew/collide/pose.h"

#include <algorithm>
#include <array>

namespace sinew::files {
namespace {

using Turn = collide::Rotation<3, double>;

/// Three vertices that span a plane.
using Corners = std::array<std::uint32_t, 3>;

/// The vertex farthest by a measure.
template <class Measure> std::uint32_t farthest(std::span<const std::uint32_t> vertices, Measure&& measure) {
    return *std::ranges::max_element(vertices, {}, measure);
}

std::optional<Corners> spread_corners(const MeshFilm& film, std::span<const std::uint32_t> vertices) {
    const auto at = [&](std::uint32_t i) { return film.position(0, i); };
    const auto a = vertices[0];
    const auto b = farthest(vertices, [&](auto i) { return norm(at(i) - at(a)); });
    const auto area = [&](auto i) { return norm(cross(at(b) - at(a), at(i) - at(a))); };
    const auto c = farthest(vertices, area);
    constexpr double flattest = 1e-3; // height of the triangle as a share of its base
    const double base = norm(at(b) - at(a));
    if (base == 0 || area(c) < flattest * base * base) return std::nullopt;
    return Corners{a, b, c};
}

/// Rotation from the axes to an orthonormal frame: x along the first side of the triangle, z its normal.
Turn frame_of(const MeshFilm& film, std::size_t frame, const Corners& corners) {
    const auto at = [&](std::size_t i) { return film.position(frame, corners[i]); };
    const auto x = direction(at(1) - at(0)), z = direction(cross(at(1) - at(0), at(2) - at(0)));
    const Turn to_x{shortest_turn({{1, 0, 0}}, x)};
    const auto z_now = to_x * Vec3<double>{{0, 0, 1}};
    const double c = dot(z_now, z), s = dot(cross(z_now, z), x); // the rest is a rotation about x
    const double w = square_root(max(0.0, (1 + c) / 2)), half = square_root(max(0.0, (1 - c) / 2));
    return (Turn{{{x[0] * (s < 0 ? -half : half), x[1] * (s < 0 ? -half : half), x[2] * (s < 0 ? -half : half), w}}} *
            to_x)
        .normalized();
}

Vec3<double> center_of(const MeshFilm& film, std::size_t frame, std::span<const std::uint32_t> vertices) {
    Vec3<double> sum{};
    for (const auto i : vertices) sum += film.position(frame, i);
    return sum * (1 / double(vertices.size()));
}

} // namespace

Vec<4, double> shortest_turn(const Vec3<double>& from, const Vec3<double>& to) {
    const double w = 1 + dot(from, to);
    if (w < 1e-12) return {{0, 0, 1, 0}};
    const auto axis = cross(from, to);
    const Vec<4, double> q{{axis[0], axis[1], axis[2], w}};
    return q * (1 / norm(q));
}

Vec<4, double> product(const Vec<4, double>& a, const Vec<4, double>& b) {
    return (Turn{a} * Turn{b}).normalized().number;
}

Vec<4, double> nearest_sign(const Vec<4, double>& q, const Vec<4, double>& before) {
    return dot(q, before) < 0 ? -q : q;
}

std::optional<RigidMotion> rigid_motion(const MeshFilm& film, std::span<const std::uint32_t> vertices,
                                        double tolerance) {
    if (vertices.size() < 3) return std::nullopt;
    const auto corners = spread_corners(film, vertices);
    if (!corners) return std::nullopt;
    const double most = tolerance * norm(film.position(0, (*corners)[1]) - film.position(0, (*corners)[0]));
    const auto back = frame_of(film, 0, *corners).inverse();
    RigidMotion motion;
    for (std::size_t frame = 0; frame < film.frames(); ++frame) {
        const auto turn = (frame_of(film, frame, *corners) * back).normalized();
        const auto center = center_of(film, frame, vertices);
        motion.rotation.push_back(frame == 0 ? turn.number : nearest_sign(turn.number, motion.rotation.back()));
        motion.center.push_back(center);
        for (const auto i : vertices) {
            const auto placed = center + turn * (film.position(0, i) - motion.center[0]);
            motion.error = max(motion.error, norm(film.position(frame, i) - placed));
        }
        if (!(motion.error <= most)) return std::nullopt;
    }
    return motion;
}

} // namespace sinew::files
