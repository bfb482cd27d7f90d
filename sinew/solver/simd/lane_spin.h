#pragma once

#include "sinew/solver/simd/lane_vec.h"

/// Angular momentum of blocks side by side in lanes, as rigid_motion.h has it for one.
namespace sinew {
namespace {
namespace lane {

template <int D, class V> using Spin = Arrow<(D == 2 ? 1 : 3), V>;

template <class V> [[gnu::always_inline]] inline Spin<2, V> moment(const Arrow<2, V>& arm, const Arrow<2, V>& kick) {
    return {{arm.at[0] * kick.at[1] - arm.at[1] * kick.at[0]}};
}
template <class V> [[gnu::always_inline]] inline Spin<3, V> moment(const Arrow<3, V>& arm, const Arrow<3, V>& kick) {
    return cross(arm, kick);
}
template <class V> [[gnu::always_inline]] inline Arrow<2, V> turning(const Spin<2, V>& rate, const Arrow<2, V>& arm) {
    return {{-rate.at[0] * arm.at[1], rate.at[0] * arm.at[0]}};
}
template <class V> [[gnu::always_inline]] inline Arrow<3, V> turning(const Spin<3, V>& rate, const Arrow<3, V>& arm) {
    return cross(rate, arm);
}

/// Inertia about the centre of mass.
template <int D, class V> class Inertia {
  public:
    void add(const Arrow<D, V>& arm, const V& mass) { add(arm, arm, mass); }
    /// With arms before and after a motion: of moments of displacements at the arms before, for turns at those after.
    void add(const Arrow<D, V>& before, const Arrow<D, V>& after, const V& mass) {
        const V size = dot(before, after) * mass;
        size_ = size_ + size, reach_ = reach_ + dot(before, before) * mass;
        if constexpr (D == 3) {
            const auto across = outer(after, before) * mass;
            for (int k = 0; k < 9; ++k) tensor_.at[k] = tensor_.at[k] - across.at[k];
            tensor_.add_to_diagonal(size);
        }
    }
    /// Second moment of mass about the centre.
    const V& size() const { return size_; }
    /// Angular velocity of an angular momentum; zero if all is in one line (3D), or in one point.
    Spin<D, V> rate_of(const Spin<D, V>& spin) const { return rate_of(spin, V{}); }
    /// The same; if all is in one line, of a turn across it.
    Spin<D, V> rate_across(const Spin<D, V>& spin) const { return rate_of(spin, inverse_size()); }

  private:
    V size_{}, reach_{}; ///< `reach_` is that of the arms before: a turn by a quarter or more leaves no size
    Square<D, V> tensor_{};

    V inverse_size() const { return size_ > reach_ * spread<V>(1e-9) ? spread<V>(1.0) / size_ : V{}; }
    /// `in_line`: rate for a unit of angular momentum if all is in one line.
    Spin<D, V> rate_of(const Spin<D, V>& spin, const V& in_line) const {
        if constexpr (D == 2) return spin * inverse_size();
        if constexpr (D == 3) {
            V determinant;
            const auto adjoint = adjugate(tensor_, determinant);
            const auto turned = adjoint * spin, across = spin * in_line;
            const V min = reach_ * reach_ * reach_ * spread<V>(1e-9), per = spread<V>(1.0) / determinant;
            Spin<D, V> rate;
            for (int k = 0; k < D; ++k) rate.at[k] = determinant > min ? turned.at[k] * per : across.at[k];
            return rate;
        }
    }
};

} // namespace lane
} // namespace
} // namespace sinew
