#pragma once

#include "sinew/math/moments.h"
#include "sinew/world/energy_terms.h"

#include <span>

/// Motion of a body in two parts: that of the rigid body with the same momenta, and the motion beside it.
namespace sinew::detail {

template <int D, class Real> class BodyMotion {
  public:
    using Vector = Vec<D, double>;
    using Spin = Vec<spins<D>, double>;

    /// `rows`: the particles of the body that move; at least one.
    BodyMotion(Particles<D, Real>& particles, std::span<const Row> rows)
        : p_(particles), rows_(rows), origin_(cast<double>(particles.position[rows.front()])),
          whole_(moments(particles.position)), rate_(whole_.rate_of(whole_.spin)) {}

    /// Takes energy from the motion beside the rigid one: both momenta stay. Returns how much it took.
    double slow_inner(double energy) {
        const double there = max(0.5 * (whole_.square - dot(rate_, whole_.spin)), 0.0), taken = min(energy, there);
        if (!(taken > 0)) return 0;
        const double keep = square_root(max(1 - taken / there, 0.0));
        for (const Row row : rows_) {
            const auto rigid = whole_.velocity + turning(rate_, arm(row));
            p_.velocity[row] = cast<Real>(rigid + (cast<double>(p_.velocity[row]) - rigid) * keep);
        }
        return taken;
    }
    /// Keeps a share of all velocities and spins.
    void slow(double keep, bool rolls) {
        for (const Row row : rows_) {
            p_.velocity[row] = cast<Real>(cast<double>(p_.velocity[row]) * keep);
            if (rolls) p_.spin.set(row, p_.spin[row] * Real(keep));
        }
    }

    /// Takes energy from a body in free flight that turns faster because it has shrunk: all distances from the centre
    /// grow by a share, and velocities about the centre fall by it. Both momenta stay. The body gets back at most the
    /// moment of inertia of a step ago about the axis of its spin. Returns how much it took.
    double grow_back(std::span<const Vec<D, Real>> before, double energy) {
        constexpr double most = 0.75; // of the kinetic energy of the rotation: twice the size
        whole_ = moments(p_.position);
        const double there = 0.5 * dot(whole_.rate_of(whole_.spin), whole_.spin);
        const double now = inertia(whole_), was = inertia(moments(before));
        if (!(was > now) || !(there > 0)) return 0;
        const double taken = min(energy, there * min(1 - now / was, most));
        const double keep = square_root(1 - taken / there);
        for (const Row row : rows_) {
            const auto center = origin_ + whole_.center;
            place(row, center + arm(row) * (1 / keep));
            p_.velocity[row] = cast<Real>(whole_.velocity + (cast<double>(p_.velocity[row]) - whole_.velocity) * keep);
        }
        return taken;
    }

    /// Takes energy from the motion about the centre, and from spins: the momentum stays. Returns how much it took.
    double slow_turn(double energy, bool rolls) {
        whole_ = moments(p_.position);
        const double there = 0.5 * whole_.square + (rolls ? energy_of_spins() : 0), taken = min(energy, there);
        if (!(taken > 0)) return 0;
        const double keep = square_root(max(1 - taken / there, 0.0));
        for (const Row row : rows_) {
            p_.velocity[row] = cast<Real>(whole_.velocity + (cast<double>(p_.velocity[row]) - whole_.velocity) * keep);
            if (rolls) p_.spin.set(row, p_.spin[row] * Real(keep));
        }
        return taken;
    }

    /// Gives a body the shape of a step ago, about its present centre.
    void put_back(std::span<const Vec<D, Real>> before) {
        const auto way = moments(p_.position).center - moments(before).center;
        for (const Row row : rows_) place(row, cast<double>(before[row]) + way);
    }

  private:
    Particles<D, Real>& p_;
    std::span<const Row> rows_;
    Vector origin_;
    CentralMoments<D> whole_;
    Spin rate_;

    void place(Row row, const Vector& at) const {
        p_.position[row] = clamp_components(cast<Real>(at), limit::coordinate<Real>);
        p_.residual[row] = {};
    }
    double energy_of_spins() const {
        double sum = 0;
        for (const Row row : rows_) {
            const auto spin = cast<double>(p_.spin[row]);
            sum += 0.5 * inertia_of(p_, row) * dot(spin, spin);
        }
        return sum;
    }
    Vector arm(Row row) const { return cast<double>(p_.position[row]) - origin_ - whole_.center; }
    CentralMoments<D> moments(std::span<const Vec<D, Real>> places) const {
        Moments<D> sums;
        for (const Row row : rows_) {
            const double mass = mass_of(p_, row);
            const auto arm = cast<double>(places[row]) - origin_, momentum = cast<double>(p_.velocity[row]) * mass;
            sums.mass += mass;
            sums.position += arm * mass;
            sums.momentum += momentum;
            sums.spin += moment(arm, momentum);
            sums.square += dot(momentum, cast<double>(p_.velocity[row]));
            sums.second += outer(arm * mass, arm);
        }
        return CentralMoments<D>(sums);
    }
    /// Moment of inertia about the axis of the present spin.
    double inertia(const CentralMoments<D>& at) const {
        const auto axis = whole_.spin * inverse_or_zero(norm(whole_.spin));
        return dot(at.spin_at(axis), axis);
    }
};

} // namespace sinew::detail
