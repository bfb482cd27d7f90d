#pragma once

#include "sinew/collide/collider.h"
#include "sinew/math/trig.h"
#include "sinew/picture/picture.h"

#include <array>
#include <span>
#include <vector>

/// Faces of colliders in space, for painting.
namespace sinew::solid {

using Position = Vec3<double>;

template <int D, class Real> Position placed_in_space(const Vec<D, Real>& vector) {
    Position wide{};
    for (int i = 0; i < D; ++i) wide[i] = double(vector[i]);
    return wide;
}

constexpr int circle_corners = 32; ///< corners of a circle

/// A face of a solid: three or four corners, counter-clockwise seen from outside.
struct SolidFace {
    std::array<Position, 4> places{};
    int count = 0;
    Position normal{};

    std::span<const Position> corners() const { return {places.data(), std::size_t(count)}; }
};

inline SolidFace quad(const Position& a, const Position& b, const Position& c, const Position& d) {
    return {{a, b, c, d}, 4, direction(cross(b - a, c - a))};
}
inline SolidFace triangle(const Position& a, const Position& b, const Position& c) {
    return {{a, b, c}, 3, direction(cross(b - a, c - a))};
}

/// Points of a capsule of a given axis, in circles around it.
class CapsuleNet {
  public:
    static constexpr int rings = circle_corners / 2 + 2; ///< from pole to pole; the equator is two of them

    CapsuleNet(const Position& a, const Position& b, double radius) {
        const auto along = direction(b - a);
        const Position axis = along == Position{} ? Position::axis(1) : along;
        const auto side = direction(cross(axis, absolute(axis[0]) < 0.8 ? Position::axis(0) : Position::axis(2)));
        const auto other = cross(axis, side);
        std::array<Position, circle_corners + 1> out;
        for (int i = 0; i <= circle_corners; ++i) {
            const double turn = 2 * pi<double> * i / circle_corners;
            out[std::size_t(i)] = side * cosine(turn) + other * sine(turn);
        }
        for (int ring = 0; ring < rings; ++ring) {
            const bool is_of_a = ring < rings / 2;
            const double polar = pi<double> * (is_of_a ? ring : ring - 1) / (rings - 2);
            const double wide = sine(polar);
            const auto down = axis * cosine(polar);
            for (int i = 0; i <= circle_corners; ++i)
                points_[std::size_t(ring)][std::size_t(i)] =
                    (is_of_a ? a : b) + (out[std::size_t(i)] * wide - down) * radius;
        }
    }

    const Position& at(int ring, int i) const { return points_[std::size_t(ring)][std::size_t(i)]; }

  private:
    std::array<std::array<Position, circle_corners + 1>, rings> points_;
};

/// Capsule of a given axis; a sphere for an axis of no length.
template <class Take> void each_face_of_capsule(const Position& a, const Position& b, double radius, const Take& take) {
    const CapsuleNet net(a, b, radius);
    for (int ring = 0; ring + 1 < CapsuleNet::rings; ++ring)
        for (int i = 0; i < circle_corners; ++i) {
            const auto &p = net.at(ring, i), &q = net.at(ring, i + 1), &r = net.at(ring + 1, i + 1),
                       &s = net.at(ring + 1, i);
            const auto normal = cross(r - p, s - q);
            if (normal != Position{}) take(SolidFace{{p, q, r, s}, 4, direction(normal)});
        }
}

/// Calls take(face) for every face of a shape, in its own frame.
template <class Real, class Take> void each_face(const collide::Sphere<3, Real>& sphere, const Take& take) {
    each_face_of_capsule({}, {}, double(sphere.radius), take);
}
template <class Real, class Take> void each_face(const collide::Capsule<3, Real>& capsule, const Take& take) {
    each_face_of_capsule(placed_in_space(capsule.a), placed_in_space(capsule.b), double(capsule.radius), take);
}
template <class Real, class Take> void each_face(const collide::Box<3, Real>& box, const Take& take) {
    const auto half = placed_in_space(box.half());
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const auto u = Position::axis((axis + 1) % 3) * half[(axis + 1) % 3],
                       v = Position::axis((axis + 2) % 3) * (half[(axis + 2) % 3] * side),
                       middle = Position::axis(axis) * (half[axis] * side);
            take(quad(middle - u - v, middle + u - v, middle + u + v, middle - u + v));
        }
}
template <class Real, class Take> void each_face(const collide::HalfSpace<3, Real>& plane, const Take& take) {
    constexpr double half_width = 20;
    const auto normal = placed_in_space(plane.normal);
    const auto u = direction(cross(normal, absolute(normal[0]) < 0.8 ? Position::axis(0) : Position::axis(2))) *
                   half_width,
               v = cross(normal, u), middle = normal * double(plane.offset);
    take(quad(middle - u - v, middle + u - v, middle + u + v, middle - u + v));
}
template <class Surface, class Take>
void each_face(const Surface& surface, const Take& take) requires(collide::IsSurface<Surface>) {
    surface.parts_near(std::decay_t<decltype(surface.bounds({}))>::everything(), [&](const auto& part) {
        take(triangle(placed_in_space(part.a), placed_in_space(part.b), placed_in_space(part.c)));
    });
}

} // namespace sinew::solid
