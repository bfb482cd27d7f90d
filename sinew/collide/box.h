#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/pose.h"
#include "sinew/collide/surface_point.h"

#include <string_view>

namespace sinew::collide {

/// Box about the origin of its pose, turned with the pose.
template <int D, class Real> struct Box {
    static constexpr std::string_view name = "box";
    Vec<D, Real> half = Vec<D, Real>::map([](int) { return Real(0.5); }); ///< half of the edge lengths

    SurfacePoint<D, Real> nearest(const Vec<D, Real>& point) const {
        const auto inner = Vec<D, Real>::map([&](int i) { return clamp(point[i], -half[i], half[i]); });
        if (inner == point) return nearest_face(point);
        return sharp_point(inner, point, Vec<D, Real>::axis(1), feature(point));
    }
    template <class T> Box<D, T> as() const { return {cast<T>(half)}; }
    BoundingBox<D, Real> bounds(const Pose<D, Real>& pose) const {
        Vec<D, Real> extent{};
        for (int i = 0; i < D; ++i) {
            const auto edge = pose.turn(Vec<D, Real>::axis(i) * half[i]);
            extent += Vec<D, Real>::map([&](int k) { return absolute(edge[k]); });
        }
        return {pose.position - extent, pose.position + extent};
    }

  private:
    SurfacePoint<D, Real> nearest_face(const Vec<D, Real>& inside) const {
        int face = 0;
        for (int i = 1; i < D; ++i)
            if (half[i] - absolute(inside[i]) < half[face] - absolute(inside[face])) face = i;
        const Real side = inside[face] < Real(0) ? Real(-1) : Real(1);
        const Real distance = absolute(inside[face]) - half[face];
        const auto normal = Vec<D, Real>::axis(face) * side;
        return {inside - normal * distance, normal, distance, number(face, side)};
    }
    /// Digits to base 3, one an axis: 0 between the faces, 1 beyond the upper one, 2 beyond the lower one.
    static constexpr std::uint32_t number(int axis, Real side) {
        constexpr std::uint32_t powers[] = {1, 3, 9};
        return powers[axis] * (side > Real(0) ? 1U : 2U);
    }
    std::uint32_t feature(const Vec<D, Real>& point) const {
        std::uint32_t sum = 0;
        for (int i = 0; i < D; ++i)
            if (absolute(point[i]) > half[i]) sum += number(i, point[i]);
        return sum;
    }
};

} // namespace sinew::collide
