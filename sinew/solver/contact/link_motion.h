#pragma once

#include "sinew/solver/solver.h"

#include <span>

namespace sinew::detail {

/// Displacements of linked particles in a substep.
template <int D, class Real> class LinkMotion {
  public:
    using Vector = Vec<D, double>;

    LinkMotion(SweepState<D, Real>& state, std::span<const Row> slots) : state_(state), slots_(slots) {}

    /// Displacement in which the energy is measured: of the first particle that cannot move, or the mean.
    Vector frame() const {
        Vector momentum{};
        double mass = 0;
        for (const Row slot : slots_) {
            if (state_.mobility[slot] == Real(0)) return displacement(slot);
            const double m = 1 / double(state_.mobility[slot]);
            mass += m, momentum += displacement(slot) * m;
        }
        return momentum * inverse_or_zero(mass);
    }
    /// Kinetic energy in that frame, times 2 h^2.
    double energy(const Vector& frame) const {
        double sum = 0;
        for (const Row slot : slots_) {
            const auto own = displacement(slot) - frame;
            sum += inverse_or_zero(double(state_.mobility[slot])) * dot(own, own);
        }
        return sum;
    }
    void slow_down(const Vector& frame, double share) const {
        for (const Row slot : slots_)
            state_.set_displacement(slot, cast<Real>(frame + (displacement(slot) - frame) * share));
    }
    void save(std::span<Vector> moves) const {
        for (std::size_t i = 0; i < slots_.size(); ++i) moves[i] = displacement(slots_[i]);
    }
    void restore(std::span<const Vector> moves) const {
        for (std::size_t i = 0; i < slots_.size(); ++i) state_.set_displacement(slots_[i], cast<Real>(moves[i]));
    }

  private:
    SweepState<D, Real>& state_;
    std::span<const Row> slots_;

    Vector displacement(Row slot) const { return cast<double>(state_.displacement_at(slot)); }
};

} // namespace sinew::detail
