#pragma once

#include "sinew/math/matrix.h"

/// Sums over particles of a body, about any origin: mass, first and second moments of mass, momenta, kinetic energy.
namespace sinew {

template <int D> inline constexpr int spins = D == 2 ? 1 : 3; ///< components of an angular momentum

/// Mass in the sums of a particle that does not move; above all masses that do.
inline constexpr double immovable_mass = 1e30;

template <class T> Vec<1, T> moment(const Vec<2, T>& arm, const Vec<2, T>& force) {
    return {{cross(arm, force)}};
}
template <class T> Vec<3, T> moment(const Vec<3, T>& arm, const Vec<3, T>& force) {
    return cross(arm, force);
}

template <int D> struct Moments {
    double mass = 0;
    Vec<D, double> position{};    ///< sum of m x
    Vec<D, double> momentum{};    ///< sum of m v
    Vec<spins<D>, double> spin{}; ///< sum of x times m v
    double square = 0;            ///< sum of m v^2, twice the kinetic energy
    Matrix<D, double> second{};   ///< sum of m x x^T
};

/// Moments about the centre of mass.
template <int D> struct CentralMoments {
    using Vector = Vec<D, double>;
    using Spin = Vec<spins<D>, double>;

    double mass = 0;
    Vector center{}, velocity{}; ///< from the origin of the sums
    Spin spin{};
    double square = 0;          ///< twice the kinetic energy about the centre
    Matrix<D, double> second{}; ///< sum of m x x^T

    explicit CentralMoments(const Moments<D>& sums)
        : mass(sums.mass), center(sums.position * inverse_or_zero(mass)),
          velocity(sums.momentum * inverse_or_zero(mass)), spin(sums.spin - moment(center, sums.momentum)),
          square(sums.square - dot(velocity, sums.momentum)), second(sums.second) {
        second -= outer(center, sums.position);
    }

    /// Inertia times the angular velocity, sum of x times m (rate times x).
    Spin spin_at(const Vec<1, double>& rate) const { return {{(second.column[0][0] + second.column[1][1]) * rate[0]}}; }
    Spin spin_at(const Vec<3, double>& rate) const { return rate * trace() - second * rate; }

    /// Angular velocity of a rigid body with this spin. A body whose particles lie in a line does not turn about it.
    Vec<1, double> rate_of(const Vec<1, double>& wanted) const {
        return clamp_components(wanted * inverse_or_zero(second.column[0][0] + second.column[1][1]), max);
    }
    Vec<3, double> rate_of(const Vec<3, double>& wanted) const {
        constexpr double little = 1e-9; // added to the inertia, about a line the only one
        const double per_trace = inverse_or_zero(trace());
        auto inertia = Matrix<3, double>::diagonal(1 + little);
        for (std::size_t i = 0; i < 3; ++i) inertia.column[i] -= second.column[i] * per_trace;
        const auto inverted = inverse(inertia);
        const auto scaled = clamp_components(wanted * per_trace, max);
        const auto rate = inverted * scaled;
        return rate + inverted * (scaled - spin_at(rate) * per_trace);
    }

  private:
    static constexpr double max = 1e60; ///< bound of rates, beyond sense: sums of them stay finite

    double trace() const {
        double sum = 0;
        for (int i = 0; i < D; ++i) sum += second.column[std::size_t(i)][i];
        return sum;
    }
};

/// Velocity at a place of a body that turns about the origin.
template <class T> Vec<2, T> turning(const Vec<1, T>& rate, const Vec<2, T>& arm) {
    return perpendicular(arm) * rate[0];
}
template <class T> Vec<3, T> turning(const Vec<3, T>& rate, const Vec<3, T>& arm) {
    return cross(rate, arm);
}

} // namespace sinew
