#pragma once

#include "sinew/math/scalar.h"

#include <array>
#include <cstddef>
#include <utility>

namespace sinew {

/// A vector of D numbers. An aggregate: Vec<2, float>{1, 2}.
template <int D, class T> struct Vec {
    std::array<T, D> component{};

    constexpr T& operator[](int i) { return component[std::size_t(i)]; }
    constexpr const T& operator[](int i) const { return component[std::size_t(i)]; }
    friend constexpr bool operator==(const Vec&, const Vec&) = default;

    constexpr Vec& operator+=(const Vec& b) { return *this = *this + b; }
    constexpr Vec& operator-=(const Vec& b) { return *this = *this - b; }
    constexpr Vec& operator*=(T s) { return *this = *this * s; }

    friend constexpr Vec operator+(const Vec& a, const Vec& b) {
        return map([&](int i) { return a[i] + b[i]; });
    }
    friend constexpr Vec operator-(const Vec& a, const Vec& b) {
        return map([&](int i) { return a[i] - b[i]; });
    }
    friend constexpr Vec operator-(const Vec& a) {
        return map([&](int i) { return -a[i]; });
    }
    friend constexpr Vec operator*(const Vec& a, T s) {
        return map([&](int i) { return a[i] * s; });
    }
    friend constexpr Vec operator*(T s, const Vec& a) { return a * s; }

    /// The vector whose i-th component is f(i).
    template <class F> static constexpr Vec map(F&& f) {
        return [&]<int... I>(std::integer_sequence<int, I...>) {
            return Vec{{f(I)...}};
        }
        (std::make_integer_sequence<int, D>{});
    }

    /// The unit vector along axis i.
    static constexpr Vec axis(int i) {
        return map([i](int j) { return i == j ? T(1) : T(0); });
    }
};

template <class T> using Vec2 = Vec<2, T>;
template <class T> using Vec3 = Vec<3, T>;

template <int D, class T> constexpr T dot(const Vec<D, T>& a, const Vec<D, T>& b) {
    return [&]<int... I>(std::integer_sequence<int, I...>) {
        return (... + (a[I] * b[I]));
    }
    (std::make_integer_sequence<int, D>{});
}

template <int D, class T> T norm(const Vec<D, T>& a) {
    return square_root(dot(a, a));
}

template <int D, class T> T distance(const Vec<D, T>& a, const Vec<D, T>& b) {
    return norm(b - a);
}

/// a / |a|, or the zero vector where |a| is 0.
template <int D, class T> Vec<D, T> direction(const Vec<D, T>& a) {
    return a * inverse_or_zero(norm(a));
}

/// Signed area of the parallelogram (a, b): positive where b is counter-clockwise of a in a y-up frame.
template <class T> constexpr T cross(const Vec<2, T>& a, const Vec<2, T>& b) {
    return a[0] * b[1] - a[1] * b[0];
}

template <class T> constexpr Vec<3, T> cross(const Vec<3, T>& a, const Vec<3, T>& b) {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// a rotated by +90 degrees (counter-clockwise in a y-up frame).
template <class T> constexpr Vec<2, T> perpendicular(const Vec<2, T>& a) {
    return {{-a[1], a[0]}};
}

/// Each component clamped to [-limit, limit].
template <int D, class T> constexpr Vec<D, T> clamp_components(const Vec<D, T>& a, T limit) {
    return Vec<D, T>::map([&](int i) { return clamp(a[i], -limit, limit); });
}

template <int D, class T> constexpr bool is_finite(const Vec<D, T>& a) {
    for (int i = 0; i < D; ++i)
        if (!is_finite(a[i])) return false;
    return true;
}

/// Conversion to another precision.
template <class To, int D, class From> constexpr Vec<D, To> cast(const Vec<D, From>& a) {
    return Vec<D, To>::map([&](int i) { return To(a[i]); });
}

} // namespace sinew
