#pragma once

#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/simd/lane_vec.h"

namespace sinew {
namespace {

/// First look at pairs of a particle and a segment, in a substep: whether they may touch, however they move in it.
template <int D, class Real> class NearPairs {
    static constexpr int width = lane::widest<Real>;
    using V = lane::Pack<Real, width>;
    using Vector = lane::Arrow<D, V>;

  public:
    explicit NearPairs(const PairColumns<D, Real>& columns) : c_(columns) {}

    std::uint32_t list(std::uint32_t first, std::uint32_t last, std::uint32_t* to) const {
        std::uint32_t count = 0;
        Real flags[width];
        for (; first < last; first += std::uint32_t(width)) {
            if (last - first < std::uint32_t(width)) {
                for (; first < last; ++first)
                    if (is_near<Real>(first) > Real(0)) to[count++] = first;
                break;
            }
            const V near = is_near<V>(first);
            if (!lane::any(near > V{})) continue;
            lane::store(flags, near);
            for (std::uint32_t i = 0; i < std::uint32_t(width); ++i)
                if (flags[i] > Real(0)) to[count++] = first + i;
        }
        return count;
    }

  private:
    const PairColumns<D, Real>& c_;

    template <class P>
    [[gnu::always_inline]] lane::Arrow<D, P> at(const Real* columns, const std::uint32_t* slots) const {
        lane::Arrow<D, P> v;
        for (std::size_t k = 0; k < D; ++k) v.at[k] = lane::gather<P>(columns + k * c_.stride, slots);
        return v;
    }
    /// 1 or 0. A gap shrinks by no more than the particle moves relative to either end. A little more than that counts
    /// as near, for the rounding of both looks.
    template <class P> [[gnu::always_inline]] P is_near(std::uint32_t i) const {
        const P zero{}, one = lane::spread<P>(Real(1)), two = lane::spread<P>(Real(2)),
                        slack = lane::spread<P>(Real(1.001));
        const auto a = at<P>(c_.position, c_.a + i), along = at<P>(c_.position, c_.b + i) - a;
        auto off = at<P>(c_.position, c_.p + i) - a;
        const P length2 = dot(along, along);
        P part = length2 > zero ? dot(off, along) / length2 : zero;
        part = lane::min(lane::max(part, zero), one);
        off = off - along * part;
        const auto moved = at<P>(c_.displacement, c_.p + i);
        const auto from_a = moved - at<P>(c_.displacement, c_.a + i), from_b = moved - at<P>(c_.displacement, c_.b + i);
        const P way = lane::root(lane::max(dot(from_a, from_a), dot(from_b, from_b)));
        const P reach = (lane::load<P>(c_.size + i) + way * two) * slack;
        return dot(off, off) <= reach * reach ? one : zero;
    }
};

template <int D, class Real>
std::uint32_t near_pairs(const PairColumns<D, Real>& columns, std::uint32_t first, std::uint32_t last,
                         std::uint32_t* to) {
    return NearPairs<D, Real>(columns).list(first, last, to);
}

} // namespace
} // namespace sinew
