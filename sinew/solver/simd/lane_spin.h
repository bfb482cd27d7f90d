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
    void add(const Arrow<D, V>& arm, const V& mass) {
        const V size = dot(arm, arm) * mass;
        size_ = size_ + size;
        if constexpr (D == 3) {
            const auto across = outer(arm, arm) * mass;
            for (int k = 0; k < 9; ++k) tensor_.at[k] = tensor_.at[k] - across.at[k];
            tensor_.add_to_diagonal(size);
        }
    }
    /// Angular velocity of an angular momentum; zero if all is in one line (3D), or in one point.
    Spin<D, V> rate_of(const Spin<D, V>& spin) const {
        V determinant = size_, min{};
        Spin<D, V> turned = spin;
        if constexpr (D == 3) {
            const auto adjoint = adjugate(tensor_, determinant);
            turned = adjoint * spin;
            min = size_ * size_ * size_ * spread<V>(1e-9);
        }
        return turned * (determinant > min ? spread<V>(1.0) / determinant : V{});
    }

  private:
    V size_{};
    Square<D, V> tensor_{};
};

} // namespace lane
} // namespace
} // namespace sinew
