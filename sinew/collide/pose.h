#pragma once

#include "sinew/math/trig.h"
#include "sinew/math/vec.h"

#include <type_traits>

namespace sinew::collide {

/// Rotation: (cosine, sine) in the plane, a unit quaternion (x, y, z, w) in space.
template <int D, class Real> struct Rotation {
    using Vector = Vec<D, Real>;
    static constexpr int size = D == 2 ? 2 : 4;
    Vec<size, Real> number = Vec<size, Real>::axis(D == 2 ? 0 : 3);

    friend constexpr bool operator==(const Rotation&, const Rotation&) = default;

    /// Rotation by an angle, radians, counter-clockwise in a y-up frame.
    static Rotation of(Real angle) requires(D == 2) { return {{{cosine(angle), sine(angle)}}}; }
    /// Rotation by an angle, radians, about an axis; no rotation for an axis of length zero.
    static Rotation of(const Vec<3, Real>& axis, Real angle) requires(D == 3) {
        const auto n = direction(axis) * sine(angle * Real(0.5));
        return n == Vec<3, Real>{} ? Rotation{} : Rotation{{{n[0], n[1], n[2], cosine(angle * Real(0.5))}}};
    }

    /// Rotation by an angle, or about a vector by its length, radians.
    static Rotation by(const Vec<1, Real>& angle) requires(D == 2) { return of(angle[0]); }
    static Rotation by(const Vec<3, Real>& angle) requires(D == 3) { return of(angle, norm(angle)); }

    /// This rotation after another.
    Rotation operator*(const Rotation& first) const {
        const auto &a = number, &b = first.number;
        if constexpr (D == 2)
            return {{{a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]}}};
        else
            return {{{a[3] * b[0] + b[3] * a[0] + (a[1] * b[2] - a[2] * b[1]),
                      a[3] * b[1] + b[3] * a[1] + (a[2] * b[0] - a[0] * b[2]),
                      a[3] * b[2] + b[3] * a[2] + (a[0] * b[1] - a[1] * b[0]),
                      a[3] * b[3] - (a[0] * b[0] + a[1] * b[1] + a[2] * b[2])}}};
    }
    Rotation normalized() const { return {number * inverse_or_zero(norm(number))}; }

    /// The same rotation, of length 1 in another precision.
    template <class T> Rotation<D, T> as() const {
        if constexpr (std::is_same_v<T, Real>) return *this;
        const auto wide = cast<T>(number);
        return {wide * inverse_or_zero(norm(wide))};
    }

    Rotation inverse() const {
        if constexpr (D == 2)
            return {{{number[0], -number[1]}}};
        else
            return {{{-number[0], -number[1], -number[2], number[3]}}};
    }

    Vector operator*(const Vector& v) const {
        if constexpr (D == 2) {
            return v * number[0] + perpendicular(v) * number[1];
        } else {
            const Vector axis{{number[0], number[1], number[2]}};
            const auto twice = cross(axis, v) * Real(2);
            return v + twice * number[3] + cross(axis, twice);
        }
    }

    /// Normalised linear interpolation: exact at both ends, and nearly uniform for angles far below a half turn.
    static Rotation between(const Rotation& from, const Rotation& to, Real share) {
        const Real side = dot(from.number, to.number) < Real(0) ? Real(-1) : Real(1);
        if (from == to) return from;
        const auto mixed = from.number * (Real(1) - share) + to.number * (side * share);
        const Real per_length = inverse_or_zero(norm(mixed));
        return per_length > Real(0) ? Rotation{mixed * per_length} : to;
    }
};

/// Position and orientation of a rigid shape.
template <int D, class Real> struct Pose {
    using Vector = Vec<D, Real>;
    Vector position{};
    Rotation<D, Real> rotation{};

    friend constexpr bool operator==(const Pose&, const Pose&) = default;

    template <class T> Pose<D, T> as() const { return {cast<T>(position), rotation.template as<T>()}; }
    Vector to_world(const Vector& local) const { return position + rotation * local; }
    Vector to_local(const Vector& point) const { return rotation.inverse() * (point - position); }
    Vector turn(const Vector& local) const { return rotation * local; }
    Vector turn_back(const Vector& vector) const { return rotation.inverse() * vector; }

    static Pose between(const Pose& from, const Pose& to, Real share) {
        return {from.position + (to.position - from.position) * share,
                Rotation<D, Real>::between(from.rotation, to.rotation, share)};
    }
};

} // namespace sinew::collide
