#pragma once

#include "sinew/solver/simd/lane_pack.h"
#include "sinew/solver/simd/lane_vec.h"

/// A midpoint substep of blocks side by side in lanes: the parts that chains (chain.h) and programs (program.h) have in
/// common. The text is the same for one lane and for eight, and a lane never reads another: the bits of a block do not
/// depend on its neighbours. Lanes that have converged wait, unchanged, for the others.
namespace sinew {
namespace {

using namespace lane;

template <int D, class V> class LaneSwing {
  public:
    using Pair = Arrow<D, V>;
    using Mask = decltype(V() < V());
    using Numbers = typename LanePack<D>::Numbers;

    explicit LaneSwing(LanePack<D>& pack)
        : lanes_(pack), h_(of(pack.h)), keep_(of(pack.keep)), half_h2_(h_ * h_ * number(0.5)) {}

  protected:
    static constexpr int max_iterations = 8;            ///< where more are needed, shorter substeps are cheaper
    static constexpr double exact = 1e-8;               ///< error of a length, relative
    static constexpr double hardly = 1e-5;              ///< last move of a node, relative to the total length
    static constexpr double crude = 1e-3;               ///< error of a length at the start that is not moved with
    static constexpr double as_good_as_taut = 1 - 2e-4; ///< squared length, relative
    static constexpr double usual_error = 0.02; ///< change of a length by the velocities, relative, in a substep
    static constexpr double max_change2 = 0.25; ///< squared change of a link in one iteration, relative
    static constexpr double rounding = 1e-6, tiny = 2e-7; ///< tolerance of energies, as in direct/energy.h
    static constexpr double share_of_rounding = 0.02;

    LanePack<D>& lanes_;
    V h_, keep_, half_h2_;
    Mask active_at_start_{};
    V far2_{}, moved2_{};          ///< largest change of a link, relative, and move of a node; squared
    V before_{}, after_{}, due_{}; ///< kinetic energies, J
    V jolt_{}, min_pull_{};
    V beyond_{}; ///< largest distance of a node beyond the room, m

    static V number(double x) { return spread<V>(x); }
    static V of(const Numbers& numbers) { return load<V>(numbers.lane); }
    static Pair at(const V (&numbers)[D]) { return Pair::of(numbers); }
    Pair acceleration() const {
        Pair all;
        for (int k = 0; k < D; ++k) all.at[k] = of(lanes_.acceleration[k]);
        return all;
    }

    /// Trust region: the share of the Newton step at which no link changes by too much.
    V trusted_share() const {
        V share = number(1);
        if (any(far2_ > number(max_change2)))
            share = far2_ > number(max_change2) ? root(number(max_change2) / far2_) : share;
        return share;
    }
    static void move(V (&position)[D], const Pair& by, const Mask& active) {
#pragma GCC unroll 3
        for (int k = 0; k < D; ++k) position[k] = active ? position[k] + by.at[k] : position[k];
    }
    void measure_room(const V (&position)[D]) {
#pragma GCC unroll 3
        for (int k = 0; k < D; ++k)
            beyond_ = max(max(of(lanes_.low[k]) - position[k], position[k] - of(lanes_.high[k])), beyond_);
    }

    /// Lanes whose energy is right, with `after_` and the sum of mass times displacement known. Work that links do
    /// because lengths are not exact, now or at the start, is no error of this iteration: `slip` h^2 J, the sum of
    /// multipliers times changes of squared lengths. `inner`: energies of which rounding is a part. `may_lose`: lanes
    /// in which a link has tightened, which takes energy.
    Mask conserves(const Pair& carried, const V& slip, const V& inner, const Mask& may_lose = Mask{}) {
        due_ = before_ + dot(acceleration(), carried);
        const V max_gain = inner * number(rounding) + of(lanes_.weight_length) * number(tiny);
        const V gain = after_ - due_, unexplained = gain + slip / (h_ * h_);
        return both(both(gain <= max_gain, may_lose | (-gain <= max_gain)),
                    size_of(unexplained) <= max_gain * number(share_of_rounding));
    }
    void report(const Mask& good, const V& alien, const V& lost) {
        store(lanes_.good.lane, good ? number(1) : V{});
        store(lanes_.alien.lane, alien);
        store(lanes_.lost.lane, lost);
    }
};

} // namespace
} // namespace sinew
