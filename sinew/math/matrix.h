#pragma once

#include "sinew/math/vec.h"

namespace sinew {

/// A square matrix, as its columns.
template <int D, class T> struct Matrix {
    std::array<Vec<D, T>, D> column{};

    static constexpr Matrix diagonal(T s) {
        Matrix m;
        for (int i = 0; i < D; ++i) m.column[std::size_t(i)][i] = s;
        return m;
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

/// m += a b^T
template <int D, class T> constexpr void add_outer(Matrix<D, T>& m, const Vec<D, T>& a, const Vec<D, T>& b) {
    for (int i = 0; i < D; ++i) m.column[std::size_t(i)] += a * b[i];
}

/// The x with m x = b, by Cramer's rule; zero where m is singular.
template <class T> constexpr Vec<2, T> solve(const Matrix<2, T>& m, const Vec<2, T>& b) {
    const T determinant = cross(m.column[0], m.column[1]);
    const T per = determinant == T(0) ? T(0) : T(1) / determinant;
    return {{cross(b, m.column[1]) * per, cross(m.column[0], b) * per}};
}

template <class T> constexpr Vec<3, T> solve(const Matrix<3, T>& m, const Vec<3, T>& b) {
    const auto& [x, y, z] = m.column;
    const auto yz = cross(y, z);
    const T determinant = dot(x, yz);
    const T per = determinant == T(0) ? T(0) : T(1) / determinant;
    return {{dot(b, yz) * per, dot(x, cross(b, z)) * per, dot(x, cross(y, b)) * per}};
}

/// The x with m x = b.
template <int D, class T> constexpr Matrix<D, T> solve(const Matrix<D, T>& m, const Matrix<D, T>& b) {
    Matrix<D, T> x;
    for (int i = 0; i < D; ++i) x.column[std::size_t(i)] = solve(m, b.column[std::size_t(i)]);
    return x;
}

} // namespace sinew
