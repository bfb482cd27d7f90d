#pragma once

#include "sinew/math/vec.h"

#include <array>
#include <cstdint>

namespace sinew::detail {

/// Four corners of a pair of features: a vertex and the corners of a face, or the ends of two edges. The first one
/// (the first two) are the one side, the others the other.
template <class Real> using FeatureCorners = std::array<Vec3<Real>, 4>;

/// Nearest points of two features: sum of weight times corner is the vector from the second to the first, distance
/// times normal.
template <class Real> struct NearestPoints {
    std::array<Real, 4> weight{};
    Vec3<Real> normal{};
    Real distance = 0;
    bool is_inside = false; ///< within the face, or within both edges
};

template <class Real> void set_distance(NearestPoints<Real>& near, const Vec3<Real>& away) {
    near.distance = norm(away);
    near.normal = away * inverse_or_zero(near.distance);
}

/// Point q of a triangle with a corner at the origin, nearest to a point, by its shares of two sides.
template <class Real> struct TriangleShares {
    Real first = 0, second = 0;
    bool is_inside = false;
};

/// Products of sides: `square_first` = |s|^2, `both` = s . t; of sides and point: `along_first` = s . p.
template <class Real> struct TriangleProducts { Real square_first, square_second, both, along_first, along_second; };

/// Nearest of the three edges of a triangle, where the foot of the perpendicular is outside.
template <class Real> TriangleShares<Real> nearest_on_outline(const TriangleProducts<Real>& of) {
    const auto share = [](Real along, Real square) { return clamp(along * inverse_or_zero(square), Real(0), Real(1)); };
    const Real first = share(of.along_first, of.square_first), second = share(of.along_second, of.square_second);
    // Squared distances, less that of the corner.
    const Real by_first = first * (first * of.square_first - Real(2) * of.along_first);
    const Real by_second = second * (second * of.square_second - Real(2) * of.along_second);
    const Real along = of.along_second - of.along_first - of.both + of.square_first;
    const Real square = of.square_first - Real(2) * of.both + of.square_second;
    const Real third = share(along, square);
    const Real by_third = of.square_first - Real(2) * of.along_first + third * (third * square - Real(2) * along);
    if (by_third < min(by_first, by_second)) return {Real(1) - third, third, false};
    return by_first <= by_second ? TriangleShares<Real>{first, 0, false} : TriangleShares<Real>{0, second, false};
}

/// A vertex against a face.
template <class Real> NearestPoints<Real> nearest_vertex_face(const FeatureCorners<Real>& corner) {
    const auto s = corner[2] - corner[1], t = corner[3] - corner[1], p = corner[0] - corner[1];
    const TriangleProducts<Real> of{dot(s, s), dot(t, t), dot(s, t), dot(s, p), dot(t, p)};
    const Real per = inverse_or_zero(of.square_first * of.square_second - of.both * of.both);
    TriangleShares<Real> at{(of.square_second * of.along_first - of.both * of.along_second) * per,
                            (of.square_first * of.along_second - of.both * of.along_first) * per, true};
    at.is_inside = at.first >= Real(0) && at.second >= Real(0) && at.first + at.second <= Real(1);
    if (!at.is_inside) at = nearest_on_outline(of);
    NearestPoints<Real> near{.weight = {Real(1), at.first + at.second - Real(1), -at.first, -at.second},
                             .is_inside = at.is_inside};
    set_distance(near, p - s * at.first - t * at.second);
    return near;
}

/// An edge against another one.
template <class Real> NearestPoints<Real> nearest_edge_edge(const FeatureCorners<Real>& corner) {
    const auto e = corner[1] - corner[0], f = corner[3] - corner[2], k = corner[0] - corner[2];
    const Real ee = dot(e, e), ff = dot(f, f), ef = dot(e, f), ek = dot(e, k), fk = dot(f, k);
    const Real determinant = ee * ff - ef * ef, per_e = inverse_or_zero(ee), per_f = inverse_or_zero(ff);
    const auto within = [](Real share) { return clamp(share, Real(0), Real(1)); };
    const bool is_parallel = !(determinant > Real(1e-6) * ee * ff);
    Real s = is_parallel ? Real(0.5) : within((ef * fk - ek * ff) * inverse_or_zero(determinant));
    Real t = within((ef * s + fk) * per_f);
    s = within((ef * t - ek) * per_e);
    t = within((ef * s + fk) * per_f);
    NearestPoints<Real> near{.weight = {Real(1) - s, s, t - Real(1), -t},
                             .is_inside = s > Real(0) && s < Real(1) && t > Real(0) && t < Real(1)};
    set_distance(near, k + e * s - f * t);
    return near;
}

/// Gap between the corners of the first side, `first_side` of four, and those of the other below, by their heights.
template <class Real> Real gap_of(const std::array<Real, 4>& height, std::size_t first_side) {
    const Real low = first_side == 2 ? min(height[0], height[1]) : height[0];
    const Real high = first_side == 2 ? max(height[2], height[3]) : max(height[1], max(height[2], height[3]));
    return low - high;
}

/// Least distance along a direction between the corners of both sides; negative where the direction parts them not.
/// `first_side`: number of corners of the first side.
template <class Real>
Real clearance(const FeatureCorners<Real>& corner, std::size_t first_side, const Vec3<Real>& direction) {
    std::array<Real, 4> height;
    for (std::size_t i = 0; i < 4; ++i) height[i] = dot(direction, corner[i] - corner[0]);
    return gap_of(height, first_side);
}

/// Direction that parts two features best, of all that nearest features can have, worked out in double: nearest points
/// of slivers are imprecise.
class PartingDirection {
  public:
    PartingDirection(const FeatureCorners<double>& corner, std::size_t first_side)
        : corner_(corner), first_side_(first_side) {}

    Vec3<double> find() {
        for (std::size_t i = 0; i < first_side_; ++i) offer_from(i);
        if (first_side_ == 2) {
            for (std::size_t i = 2; i < 4; ++i) offer_across(i, 0, 1);
            offer(cross(corner_[1] - corner_[0], corner_[3] - corner_[2]));
        } else {
            offer(cross(corner_[2] - corner_[1], corner_[3] - corner_[1]));
        }
        return best_;
    }

  private:
    const FeatureCorners<double>& corner_;
    std::size_t first_side_;
    Vec3<double> best_{};
    double max_ = -1;

    void offer_from(std::size_t i) {
        for (std::size_t a = first_side_; a < 4; ++a) {
            offer(corner_[i] - corner_[a]);
            for (std::size_t b = a + 1; b < 4; ++b) offer_across(i, a, b);
        }
    }
    /// From the line a b to the corner i.
    void offer_across(std::size_t i, std::size_t a, std::size_t b) {
        const auto side = corner_[b] - corner_[a], to = corner_[i] - corner_[a];
        offer(to - side * (dot(to, side) * inverse_or_zero(dot(side, side))));
    }
    void offer(const Vec3<double>& way) {
        for (const auto& unit : {direction(way), -direction(way)}) {
            const double gap = clearance(corner_, first_side_, unit);
            if (gap > max_) max_ = gap, best_ = unit;
        }
    }
};

} // namespace sinew::detail
