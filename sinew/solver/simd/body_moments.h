#pragma once

#include "sinew/math/lane.h"
#include "sinew/solver/simd/kernel.h"

#include <limits>
#include <utility>

/// Kernels of whole bodies. Eight sums run side by side whatever the width of the lanes: the bits are the same for all.
namespace sinew {
namespace {

using namespace lane;

inline constexpr int sums_at_once = 8;

/// A pack of a column in double. In order: `count` consecutive numbers from `at` on, then `behind`.
template <class V, class Real> [[gnu::always_inline]] inline V doubles_at(const Real* column, std::size_t at) {
    constexpr int width = sizeof(V) / sizeof(double);
    if constexpr (sizeof(Real) == sizeof(double))
        return load<V>(column + at);
    else if constexpr (width == 1)
        return double(column[at]);
    else
        return __builtin_convertvector(load<Pack<Real, width>>(column + at), V);
}

/// Reads the particles of a body: `get(column, i, behind)` is a pack from particle i on.
template <class V, bool whole> struct BodyReader {
    const std::uint32_t* slots;
    std::size_t first, count;

    template <class Real> [[gnu::always_inline]] V get(const Real* column, std::size_t i, double behind) const {
        if constexpr (whole) return doubles_at<V>(column, first + i);
        double numbers[sizeof(V) / sizeof(double)];
        for (double& number : numbers) {
            number = i < count ? double(column[slots ? slots[i] : first + i]) : behind;
            ++i;
        }
        return load<V>(numbers);
    }
};

template <int D, class V> struct MomentPacks {
    V mass{}, square{}, position[D] = {}, momentum[D] = {}, spin[spins<D>] = {}, second[D][D] = {};

    [[gnu::always_inline]] void add(const V& m, const V (&x)[D], const V (&v)[D]) {
        mass += m;
#pragma GCC unroll 3
        for (int k = 0; k < D; ++k) {
            const V weighed = x[k] * m;
            position[k] += weighed;
            momentum[k] += v[k] * m;
            square += v[k] * v[k] * m;
#pragma GCC unroll 3
            for (int j = 0; j <= k; ++j) second[k][j] += weighed * x[j];
        }
        if constexpr (D == 2) {
            spin[0] += (x[0] * v[1] - x[1] * v[0]) * m;
        } else {
#pragma GCC unroll 3
            for (int k = 0; k < D; ++k) {
                const int i = (k + 1) % D, j = (k + 2) % D;
                spin[k] += (x[i] * v[j] - x[j] * v[i]) * m;
            }
        }
    }
};

template <int D, class V> using MomentSums = std::array<MomentPacks<D, V>, sums_at_once * sizeof(double) / sizeof(V)>;

/// Adds particles [first, last) of a body, eight at a time.
template <int D, class V, bool whole, class Real>
void add_moments(MomentSums<D, V>& sums, const BodyColumns<D, Real>& body, std::size_t first, std::size_t last) {
    constexpr double no_mass = std::numeric_limits<double>::infinity();
    constexpr double min_mobility = 1 / immovable_mass;
    const BodyReader<V, whole> reader{body.slots, body.first, body.count};
    for (std::size_t at = first; at < last; at += sums_at_once)
        for (std::size_t p = 0; p < sums.size(); ++p) {
            const std::size_t i = at + p * (sums_at_once / sums.size());
            V position[D], displacement[D];
#pragma GCC unroll 3
            for (int k = 0; k < D; ++k) {
                const auto column = std::size_t(k) * body.stride;
                position[k] = reader.get(body.position + column, i, body.origin[k]) - body.origin[k];
                displacement[k] = reader.get(body.displacement + column, i, body.drift[k]) - body.drift[k];
            }
            sums[p].add(1.0 / lane::max(reader.get(body.mobility, i, no_mass), spread<V>(min_mobility)), position,
                        displacement);
        }
}

template <int D, class Real> void moments_of(const BodyColumns<D, Real>& body, Moments<D>& total) {
    using V = Pack<double, widest<double>>;
    MomentSums<D, V> sums{};
    const std::size_t whole = body.slots ? 0 : body.count / sums_at_once * sums_at_once;
    add_moments<D, V, true>(sums, body, 0, whole);
    add_moments<D, V, false>(sums, body, whole, body.count);
    for (const auto& pack : sums)
        for (int i = 0; i < sums_at_once / int(sums.size()); ++i) {
            total.mass += lane_of(pack.mass, i);
            total.square += lane_of(pack.square, i);
            for (int k = 0; k < spins<D>; ++k) total.spin[k] += lane_of(pack.spin[k], i);
            for (int k = 0; k < D; ++k) {
                total.position[k] += lane_of(pack.position[k], i);
                total.momentum[k] += lane_of(pack.momentum[k], i);
                for (int j = 0; j <= k; ++j) total.second.column[std::size_t(j)][k] += lane_of(pack.second[k][j], i);
            }
        }
    for (int k = 0; k < D; ++k)
        for (int j = 0; j < k; ++j) total.second.column[std::size_t(k)][j] = total.second.column[std::size_t(j)][k];
}

/// v <- v + rate x r - loss (v - drift), r from the centre.
template <class V, int D, class Real>
[[gnu::always_inline]] inline void turn(const BodyColumns<D, Real>& body, const BodyTurn<D, Real>& by, std::size_t at) {
    constexpr int width = sizeof(V) / sizeof(double);
    V arm[D], moves[D], turned[D];
#pragma GCC unroll 3
    for (int k = 0; k < D; ++k) {
        const auto column = std::size_t(k) * body.stride;
        arm[k] = doubles_at<V>(body.position + column, at) - by.center[k];
        moves[k] = doubles_at<V>(body.displacement + column, at);
    }
    if constexpr (D == 2)
        turned[0] = arm[1] * -by.rate[0], turned[1] = arm[0] * by.rate[0];
    else
#pragma GCC unroll 3
        for (int k = 0; k < D; ++k)
            turned[k] = by.rate[(k + 1) % D] * arm[(k + 2) % D] - by.rate[(k + 2) % D] * arm[(k + 1) % D];
#pragma GCC unroll 3
    for (int k = 0; k < D; ++k) {
        const V displacement = moves[k] + turned[k] - (moves[k] - by.drift[k]) * by.loss;
        Real* const to = body.displacement + std::size_t(k) * body.stride + at;
        if constexpr (width == 1)
            *to = Real(within(displacement, double(by.max)));
        else
            store(to, __builtin_convertvector(within(displacement, spread<V>(double(by.max))), Pack<Real, width>));
    }
}

template <int D, class Real> void turn_body(const BodyColumns<D, Real>& body, const BodyTurn<D, Real>& by) {
    constexpr std::size_t width = widest<double>;
    const std::size_t whole = body.slots ? 0 : body.count / width * width;
    for (std::size_t i = 0; i < whole; i += width) turn<Pack<double, widest<double>>>(body, by, body.first + i);
    for (std::size_t i = whole; i < body.count; ++i)
        turn<double>(body, by, body.slots ? body.slots[i] : body.first + i);
}

} // namespace
} // namespace sinew
