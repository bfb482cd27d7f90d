#pragma once

#include "sinew/math/lane.h"

/// Vectors and square matrices of packs. Internal linkage, as math/lane.h has it: plain functions on vectors of double
/// would be compiled once for all instruction sets.
namespace sinew {
namespace {
namespace lane {

template <int D, class V> struct Arrow {
    V at[D];

    [[gnu::always_inline]] static Arrow of(const V (&numbers)[D]) {
        Arrow a;
#pragma GCC unroll 3
        for (int k = 0; k < D; ++k) a.at[k] = numbers[k];
        return a;
    }
    [[gnu::always_inline]] void to(V (&numbers)[D]) const {
#pragma GCC unroll 3
        for (int k = 0; k < D; ++k) numbers[k] = at[k];
    }
};

template <int D, class V> [[gnu::always_inline]] inline Arrow<D, V> operator+(Arrow<D, V> a, const Arrow<D, V>& b) {
#pragma GCC unroll 3
    for (int k = 0; k < D; ++k) a.at[k] = a.at[k] + b.at[k];
    return a;
}
template <int D, class V> [[gnu::always_inline]] inline Arrow<D, V> operator-(Arrow<D, V> a, const Arrow<D, V>& b) {
#pragma GCC unroll 3
    for (int k = 0; k < D; ++k) a.at[k] = a.at[k] - b.at[k];
    return a;
}
template <int D, class V> [[gnu::always_inline]] inline Arrow<D, V> operator*(Arrow<D, V> a, const V& s) {
#pragma GCC unroll 3
    for (int k = 0; k < D; ++k) a.at[k] = a.at[k] * s;
    return a;
}
template <int D, class V> [[gnu::always_inline]] inline V dot(const Arrow<D, V>& a, const Arrow<D, V>& b) {
    V sum = a.at[0] * b.at[0];
#pragma GCC unroll 3
    for (int k = 1; k < D; ++k) sum = sum + a.at[k] * b.at[k];
    return sum;
}

/// A square matrix, in rows.
template <int D, class V> struct Square {
    V at[D * D];

    [[gnu::always_inline]] static Square of(const V (&numbers)[D * D]) {
        Square m;
#pragma GCC unroll 9
        for (int k = 0; k < D * D; ++k) m.at[k] = numbers[k];
        return m;
    }
    [[gnu::always_inline]] void to(V (&numbers)[D * D]) const {
#pragma GCC unroll 9
        for (int k = 0; k < D * D; ++k) numbers[k] = at[k];
    }
    [[gnu::always_inline]] void add_to(V (&numbers)[D * D]) const {
#pragma GCC unroll 9
        for (int k = 0; k < D * D; ++k) numbers[k] = numbers[k] + at[k];
    }
    [[gnu::always_inline]] void take_from(V (&numbers)[D * D]) const {
#pragma GCC unroll 9
        for (int k = 0; k < D * D; ++k) numbers[k] = numbers[k] - at[k];
    }
    [[gnu::always_inline]] void add_to_diagonal(const V& s) {
#pragma GCC unroll 3
        for (int k = 0; k < D; ++k) at[(D + 1) * k] = at[(D + 1) * k] + s;
    }
};

template <int D, class V>
[[gnu::always_inline]] inline Arrow<D, V> operator*(const Square<D, V>& m, const Arrow<D, V>& v) {
    Arrow<D, V> product;
#pragma GCC unroll 3
    for (int i = 0; i < D; ++i) {
        V sum = m.at[D * i] * v.at[0];
#pragma GCC unroll 3
        for (int k = 1; k < D; ++k) sum = sum + m.at[D * i + k] * v.at[k];
        product.at[i] = sum;
    }
    return product;
}
/// v^T m
template <int D, class V>
[[gnu::always_inline]] inline Arrow<D, V> operator*(const Arrow<D, V>& v, const Square<D, V>& m) {
    Arrow<D, V> product;
#pragma GCC unroll 3
    for (int i = 0; i < D; ++i) {
        V sum = m.at[i] * v.at[0];
#pragma GCC unroll 3
        for (int k = 1; k < D; ++k) sum = sum + m.at[D * k + i] * v.at[k];
        product.at[i] = sum;
    }
    return product;
}

template <int D, class V>
[[gnu::always_inline]] inline Square<D, V> operator*(const Square<D, V>& m, const Square<D, V>& n) {
    Square<D, V> product;
#pragma GCC unroll 3
    for (int i = 0; i < D; ++i)
#pragma GCC unroll 3
        for (int j = 0; j < D; ++j) {
            V sum = m.at[D * i] * n.at[j];
#pragma GCC unroll 3
            for (int k = 1; k < D; ++k) sum = sum + m.at[D * i + k] * n.at[D * k + j];
            product.at[D * i + j] = sum;
        }
    return product;
}
template <int D, class V> [[gnu::always_inline]] inline Square<D, V> operator*(Square<D, V> m, const V& s) {
#pragma GCC unroll 9
    for (int k = 0; k < D * D; ++k) m.at[k] = m.at[k] * s;
    return m;
}
/// a b^T
template <int D, class V> [[gnu::always_inline]] inline Square<D, V> outer(const Arrow<D, V>& a, const Arrow<D, V>& b) {
    Square<D, V> product;
#pragma GCC unroll 3
    for (int i = 0; i < D; ++i)
#pragma GCC unroll 3
        for (int j = 0; j < D; ++j) product.at[D * i + j] = a.at[i] * b.at[j];
    return product;
}
template <class V> [[gnu::always_inline]] inline Arrow<3, V> cross(const Arrow<3, V>& a, const Arrow<3, V>& b) {
    return {{a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2],
             a.at[0] * b.at[1] - a.at[1] * b.at[0]}};
}

/// The adjugate: the inverse times the determinant.
template <class V> [[gnu::always_inline]] inline Square<2, V> adjugate(const Square<2, V>& m, V& determinant) {
    determinant = m.at[0] * m.at[3] - m.at[1] * m.at[2];
    return {{m.at[3], -m.at[1], -m.at[2], m.at[0]}};
}
template <class V> [[gnu::always_inline]] inline Square<3, V> adjugate(const Square<3, V>& m, V& determinant) {
    const auto& a = m.at;
    const Square<3, V> adjugate{{a[4] * a[8] - a[5] * a[7], a[2] * a[7] - a[1] * a[8], a[1] * a[5] - a[2] * a[4],
                                 a[5] * a[6] - a[3] * a[8], a[0] * a[8] - a[2] * a[6], a[2] * a[3] - a[0] * a[5],
                                 a[3] * a[7] - a[4] * a[6], a[1] * a[6] - a[0] * a[7], a[0] * a[4] - a[1] * a[3]}};
    determinant = a[0] * adjugate.at[0] + a[1] * adjugate.at[3] + a[2] * adjugate.at[6];
    return adjugate;
}

// Masks: the result of a comparison of packs, or a bool.
[[gnu::always_inline]] inline bool both(bool a, bool b) {
    return a && b;
}
[[gnu::always_inline]] inline bool without(bool a, bool b) {
    return a && !b;
}
template <class Mask> [[gnu::always_inline]] inline Mask both(const Mask& a, const Mask& b) {
    return a & b;
}
template <class Mask> [[gnu::always_inline]] inline Mask without(const Mask& a, const Mask& b) {
    return a & ~b;
}
template <class V> [[gnu::always_inline]] inline V size_of(const V& x) {
    return max(x, -x);
}

} // namespace lane
} // namespace
} // namespace sinew
