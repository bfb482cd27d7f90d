#pragma once

#include "sinew/collide/surface_point.h"

#include <array>
#include <optional>
#include <span>

namespace sinew::collide {

/// Part of a surface (edge of a chain, triangle) near a sphere, and the centre of the sphere where the part counts.
template <class Part, class Vector> struct FoundPart {
    Part part;
    Vector center{};
};

/// Contacts of the parts of a surface with a sphere, each with one owner. With c the centre, q the point of a part
/// nearest to it, and s the signed distance of c from the plane of the part:
///
///     q on the face          the part's own; of parts that meet at a convex edge and have c behind, the nearest's
///     q on an edge or corner, which is nearest from the front      the first part's of all that reach the point
///     q on an edge or corner, which is nearest from behind         each of these parts': c is in a valley
///
/// All parts see the same centre, and their order is total: one of a tie remains.
template <int D, class T, class Part> class PartOwner {
  public:
    using Vector = Vec<D, T>;
    using Found = FoundPart<Part, Vector>;

    /// `rounding`: of distances.
    PartOwner(std::span<const Found> found, T rounding) : found_(found), rounding_(rounding) {}

    /// The contact of part i, unless it is another's.
    std::optional<SurfacePoint<D, T>> contact(std::size_t i) const {
        const auto& [part, center] = found_[i];
        const auto nearest = part.nearest(center);
        if (!part.is_inside(nearest)) return sharp_contact(i, nearest);
        if (nearest.distance < T(0) && is_behind_another(i, nearest.distance)) return std::nullopt;
        return nearest;
    }

  private:
    static constexpr std::size_t most = 32; ///< parts that meet at a point
    std::span<const Found> found_;
    T rounding_;

    /// Parts that reach a point as near to the centre as a part itself.
    struct Fan {
        std::array<std::size_t, most> part{};
        std::size_t count = 0;
        T furthest = 0; ///< signed distance of the centre from the plane furthest from it
        void add(std::size_t number, T from_plane) {
            if (count < most) part[count++] = number;
            if (absolute(from_plane) > absolute(furthest)) furthest = from_plane;
        }
    };

    T from_plane(std::size_t i, const Vector& point) const {
        return dot(found_[i].part.normal(), point - found_[i].part.a);
    }
    /// True for a part behind which the centre is, and by less behind another one across a convex edge or a
    /// corner.
    bool is_behind_another(std::size_t i, T distance) const {
        const auto& [part, center] = found_[i];
        for (std::size_t k = 0; k < found_.size(); ++k) {
            const auto& other = found_[k].part;
            if (k == i || !meet(part, other) || !is_behind(other, part)) continue;
            const auto nearest = other.nearest(center);
            if (other.is_inside(nearest) && (nearest.distance > distance || (nearest.distance == distance && k < i)))
                return true;
        }
        return false;
    }
    static bool meet(const Part& part, const Part& other) {
        for (const auto& corner : part.corners())
            for (const auto& there : other.corners())
                if (corner == there) return true;
        return false;
    }
    /// True if no corner of a part is before the plane of another.
    static bool is_behind(const Part& part, const Part& other) {
        const auto normal = other.normal();
        for (const auto& corner : part.corners())
            if (dot(normal, corner - other.a) > T(0)) return false;
        return true;
    }

    std::optional<SurfacePoint<D, T>> sharp_contact(std::size_t i, const SurfacePoint<D, T>& nearest) const {
        const auto& [part, center] = found_[i];
        const T distance = nearest.distance;
        constexpr T clear = 8; // rounding errors in a distance that still tells a direction
        const bool is_on_it = distance <= clear * rounding_;
        Fan fan;
        fan.add(i, from_plane(i, center));
        bool is_first = true, is_beyond = false, is_in_valley = false;
        for (std::size_t k = 0; k < found_.size(); ++k) {
            const auto& other = found_[k].part;
            if (k == i || absolute(other.nearest(nearest.point).distance) > rounding_) continue;
            const auto there = other.nearest(center);
            if (other.is_inside(there)) {
                const bool is_nearer = absolute(there.distance) <= distance + rounding_;
                if (!is_nearer) continue;
                if (!(is_on_it || there.distance < T(0)) || is_behind(part, other)) return std::nullopt;
                is_in_valley = true; // whose other side the centre is behind
                fan.add(k, from_plane(k, center));
                continue;
            }
            is_first = is_first && !(there.distance < distance || (there.distance == distance && k < i));
            is_beyond = is_beyond || there.distance < distance - rounding_;
            if (absolute(there.distance - distance) <= rounding_) fan.add(k, from_plane(k, center));
        }
        if (is_in_valley) return plane_of(i, fan, nearest);
        if (!is_on_it && fan.furthest > T(0)) return is_first ? std::optional(nearest) : std::nullopt;
        if (is_beyond || !(is_closed(fan, nearest.point) || (is_on_it && is_first))) return std::nullopt;
        return plane_of(i, fan, nearest);
    }
    /// Plane of a part through a point of its edge. Parts in one plane count once.
    std::optional<SurfacePoint<D, T>> plane_of(std::size_t i, const Fan& fan, SurfacePoint<D, T> nearest) const {
        constexpr T same = T(1) - T(16) * std::numeric_limits<T>::epsilon();
        const auto normal = found_[i].part.normal();
        for (std::size_t k = 0; k < fan.count; ++k)
            if (fan.part[k] < i && dot(found_[fan.part[k]].part.normal(), normal) > same) return std::nullopt;
        nearest.normal = normal;
        nearest.distance = from_plane(i, found_[i].center);
        return nearest;
    }
    /// True if the parts lie all around a point: below the rim of a surface a point is behind nothing.
    bool is_closed(const Fan& fan, const Vector& point) const {
        if constexpr (D == 2) {
            return fan.count > 1;
        } else {
            for (std::size_t k = 0; k < fan.count; ++k)
                for (const auto& side : found_[fan.part[k]].part.sides_at(point, rounding_))
                    if (!is_beside(fan, k, side, point)) return false;
            return true;
        }
    }
    bool is_beside(const Fan& fan, std::size_t one, const Vector& side, const Vector& point) const {
        constexpr T same = T(1) - T(1e-4);
        for (std::size_t k = 0; k < fan.count; ++k) {
            if (k == one) continue;
            for (const auto& other : found_[fan.part[k]].part.sides_at(point, rounding_))
                if (dot(side, other) > same) return true;
        }
        return false;
    }
};

} // namespace sinew::collide
