#pragma once

#include "sinew/math/vec.h"

namespace sinew {

/// A square matrix, stored as columns.
template <int D, class T> struct Matrix {
    std::array<Vec<D, T>, D> column{};

    static constexpr Matrix diagonal(T s) {
        if constexpr (D == 2)
            return {{Vec<2, T>{{s, 0}}, Vec<2, T>{{0, s}}}};
        else
            return {{Vec<3, T>{{s, 0, 0}}, Vec<3, T>{{0, s, 0}}, Vec<3, T>{{0, 0, s}}}};
    }

    friend constexpr Vec<D, T> operator*(const Matrix& m, const Vec<D, T>& v) {
        Vec<D, T> sum = m.column[0] * v[0];
        for (int i = 1; i < D; ++i) sum += m.column[std::size_t(i)] * v[i];
        return sum;
    }
};

template <int D, class T> constexpr Matrix<D, T>& operator+=(Matrix<D, T>& a, const Matrix<D, T>& b) {
    for (int i = 0; i < D; ++i) a.column[std::size_t(i)] += b.column[std::size_t(i)];
    return a;
}

template <int D, class T> constexpr Matrix<D, T>& operator-=(Matrix<D, T>& a, const Matrix<D, T>& b) {
    for (int i = 0; i < D; ++i) a.column[std::size_t(i)] -= b.column[std::size_t(i)];
    return a;
}

template <int D, class T> constexpr Matrix<D, T> operator*(const Matrix<D, T>& a, const Matrix<D, T>& b) {
    Matrix<D, T> product;
    for (int i = 0; i < D; ++i) product.column[std::size_t(i)] = a * b.column[std::size_t(i)];
    return product;
}

/// Outer product a b^T.
template <int D, class T> Matrix<D, T> outer(const Vec<D, T>& a, const Vec<D, T>& b) {
    Matrix<D, T> m;
    for (int i = 0; i < D; ++i) m.column[std::size_t(i)] = a * b[i];
    return m;
}

/// Inverse of m, or the zero matrix where m is singular.
template <class T> constexpr Matrix<2, T> inverse(const Matrix<2, T>& m) {
    const auto& [x, y] = m.column;
    const T determinant = cross(x, y);
    const T per = determinant == T(0) ? T(0) : T(1) / determinant;
    return {{Vec<2, T>{{y[1] * per, -x[1] * per}}, Vec<2, T>{{-y[0] * per, x[0] * per}}}};
}

template <class T> constexpr Matrix<3, T> inverse(const Matrix<3, T>& m) {
    const auto& [x, y, z] = m.column;
    const auto yz = cross(y, z), zx = cross(z, x), xy = cross(x, y);
    const T determinant = dot(x, yz);
    const T per = determinant == T(0) ? T(0) : T(1) / determinant;
    Matrix<3, T> rows{{yz * per, zx * per, xy * per}};
    Matrix<3, T> result;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) result.column[std::size_t(i)][k] = rows.column[std::size_t(k)][i];
    return result;
}

} // namespace sinew
