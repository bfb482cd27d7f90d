#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/pose.h"
#include "sinew/collide/segment_over_face.h"
#include "sinew/collide/surface_point.h"

#include <optional>
#include <string_view>

namespace sinew::collide {

/// Box about the origin of its pose, turned with the pose.
template <int D, class Real> struct Box {
    static constexpr std::string_view name = "box";
    Vec<D, Real> size = Vec<D, Real>::map([](int) { return Real(1); }); ///< edge lengths, as in scenes

    Vec<D, Real> half() const { return size * Real(0.5); }

    SurfacePoint<D, Real> nearest(const Vec<D, Real>& point) const {
        const auto far = half();
        const auto inner = Vec<D, Real>::map([&](int i) { return clamp(point[i], -far[i], far[i]); });
        if (inner == point) return nearest_face(point);
        return sharp_point(inner, point, Vec<D, Real>::axis(1), feature(point));
    }
    static constexpr bool is_face(std::uint32_t feature) {
        constexpr std::uint32_t faces[] = {1, 2, 3, 6, 9, 18};
        for (const auto face : faces)
            if (feature == face) return true;
        return false;
    }
    /// Calls visit(surface) with the points nearest to a point inside on each face.
    template <class Visit> void each_face(const Vec<D, Real>& inside, Visit&& visit) const {
        for (int i = 0; i < D; ++i)
            for (const Real side : {Real(1), Real(-1)}) visit(face_point(inside, i, side));
    }
    /// Part of a segment above the face that looks most along a direction; nothing above a corner or an edge.
    std::optional<SegmentOverFace<D, Real>> over_face(const Vec<D, Real>& a, const Vec<D, Real>& b,
                                                      const Vec<D, Real>& along) const {
        const auto far = half();
        int face = 0;
        for (int i = 1; i < D; ++i)
            if (absolute(along[i]) > absolute(along[face])) face = i;
        if (absolute(along[face]) < SegmentOverFace<D, Real>::least_slope) return std::nullopt;
        const auto normal = Vec<D, Real>::axis(face) * (along[face] < Real(0) ? Real(-1) : Real(1));
        SegmentOverFace<D, Real> over{normal, far[face]};
        for (int i = 0; i < D; ++i)
            for (const Real side : {Real(1), Real(-1)})
                if (i != face) over.clip(far[i] - side * a[i], far[i] - side * b[i]);
        return over;
    }
    template <class T> Box<D, T> as() const { return {cast<T>(size)}; }
    BoundingBox<D, Real> bounds(const Pose<D, Real>& pose) const {
        Vec<D, Real> extent{};
        for (int i = 0; i < D; ++i) {
            const auto edge = pose.turn(Vec<D, Real>::axis(i) * (size[i] * Real(0.5)));
            extent += Vec<D, Real>::map([&](int k) { return absolute(edge[k]); });
        }
        return {pose.position - extent, pose.position + extent};
    }

  private:
    SurfacePoint<D, Real> nearest_face(const Vec<D, Real>& inside) const {
        const auto far = half();
        int face = 0;
        for (int i = 1; i < D; ++i)
            if (far[i] - absolute(inside[i]) < far[face] - absolute(inside[face])) face = i;
        return face_point(inside, face, inside[face] < Real(0) ? Real(-1) : Real(1));
    }
    SurfacePoint<D, Real> face_point(const Vec<D, Real>& inside, int face, Real side) const {
        const Real distance = inside[face] * side - half()[face];
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
            if (absolute(point[i]) > size[i] * Real(0.5)) sum += number(i, point[i]);
        return sum;
    }
};

} // namespace sinew::collide
