#pragma once

#include "sinew/math/scalar.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/simd/lane_vec.h"

#include <limits>

namespace sinew {
namespace {

/// Pairs of a particle and a segment that may touch in a substep, however they move in it, and their nearest points.
template <int D, class Real> class NearPairs {
    static constexpr int width = lane::widest<Real>;
    using Near = NearSegment<D, Real>;

  public:
    explicit NearPairs(const PairColumns<D, Real>& columns) : c_(columns) {}

    std::uint32_t list(std::uint32_t first, std::uint32_t last, Near* to) const {
        Near* next = to;
        for (; first + std::uint32_t(width) <= last; first += std::uint32_t(width))
            measure<lane::Pack<Real, width>>(first, next);
        for (; first < last; ++first) measure<Real>(first, next);
        return std::uint32_t(next - to);
    }

  private:
    const PairColumns<D, Real>& c_;

    template <class V>
    [[gnu::always_inline]] lane::Arrow<D, V> at(const Real* columns, const std::uint32_t* slots) const {
        lane::Arrow<D, V> v;
        for (std::size_t k = 0; k < D; ++k) v.at[k] = lane::gather<V>(columns + k * c_.stride, slots);
        return v;
    }
    /// A gap shrinks by no more than the particle moves relative to either end. A little more than that counts as near,
    /// for rounding.
    template <class V> [[gnu::always_inline]] void measure(std::uint32_t i, Near*& next) const {
        const V zero{}, one = lane::spread<V>(Real(1)), slack = lane::spread<V>(Real(1.001));
        const auto a = at<V>(c_.position, c_.a + i), along = at<V>(c_.position, c_.b + i) - a;
        auto off = at<V>(c_.position, c_.p + i) - a;
        const V length2 = dot(along, along);
        V t = length2 > zero ? dot(off, along) / length2 : zero;
        t = lane::min(lane::max(t, zero), one);
        off = off - along * t;
        const auto moved = at<V>(c_.displacement, c_.p + i);
        const auto from_a = moved - at<V>(c_.displacement, c_.a + i), from_b = moved - at<V>(c_.displacement, c_.b + i);
        const V way = lane::root(lane::max(dot(from_a, from_a), dot(from_b, from_b)));
        const V radius = (lane::load<V>(c_.size + i) + way * lane::spread<V>(Real(2))) * slack;
        const V far2 = dot(off, off);
        const V near = far2 <= radius * radius ? one : zero;
        if (!lane::any(near > zero)) return;

        const V distance = lane::root(far2);
        const V per = distance >= lane::spread<V>(std::numeric_limits<Real>::min()) ? one / distance : zero;
        const auto normal = off * per;
        const V left = left_of(along, off), approach = -dot(normal, from_a + (from_b - from_a) * t);
        const V rest = one - t;
        const V response = mobility<V>(c_.p + i) + rest * rest * mobility<V>(c_.a + i) + t * t * mobility<V>(c_.b + i);
        for (int l = 0; l < int(sizeof(V) / sizeof(Real)); ++l) {
            if (!(lane::lane_of(near, l) > Real(0))) continue;
            next->pair = i + std::uint32_t(l);
            next->t = lane::lane_of(t, l), next->distance = lane::lane_of(distance, l);
            for (int k = 0; k < D; ++k) next->normal[k] = lane::lane_of(normal.at[k], l);
            next->left = lane::lane_of(left, l), next->response = lane::lane_of(response, l);
            next->approach = lane::lane_of(approach, l);
            ++next;
        }
    }
    template <class V> [[gnu::always_inline]] V mobility(const std::uint32_t* slots) const {
        return lane::gather<V>(c_.mobility, slots);
    }
    template <class V>
    [[gnu::always_inline]] static V left_of(const lane::Arrow<D, V>& along, const lane::Arrow<D, V>& off) {
        if constexpr (D == 2)
            return along.at[0] * off.at[1] - along.at[1] * off.at[0];
        else
            return V{};
    }
};

template <int D, class Real>
std::uint32_t near_pairs(const PairColumns<D, Real>& columns, std::uint32_t first, std::uint32_t last,
                         NearSegment<D, Real>* to) {
    return NearPairs<D, Real>(columns).list(first, last, to);
}

} // namespace
} // namespace sinew
