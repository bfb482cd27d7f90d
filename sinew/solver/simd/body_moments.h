#pragma once

#include "sinew/math/lane.h"
#include "sinew/solver/simd/kernel.h"

#include <limits>
#include <tuple>
#include <utility>

/// Kernels of whole bodies. Eight sums run side by side whatever the width of the lanes: the bits are the same for all.
namespace sinew {
namespace {

using namespace lane;

inline constexpr int sums_at_once = 8;

/// The numbers of a pack, in another precision.
template <class To, class From> [[gnu::always_inline]] inline To converted(const From& pack) {
    if constexpr (std::is_arithmetic_v<To>)
        return To(pack);
    else
        return __builtin_convertvector(pack, To);
}
template <class V, class Real> [[gnu::always_inline]] inline V doubles_at(const Real* column, std::size_t at) {
    return converted<V>(load<Pack<Real, sizeof(V) / sizeof(double)>>(column + at));
}

/// Place of a body's particles in the columns: adjacent, anywhere, or fewer than are added at once.
enum class Placed { adjacent, scattered, few };

/// Reads the particles of a body: `get(column, i, behind)` is a pack from particle i on, `behind` for those behind the
/// last.
template <class V, Placed placed> struct BodyReader {
    const std::uint32_t* slots;
    std::size_t first, count;

    template <class Real> [[gnu::always_inline]] V get(const Real* column, std::size_t i, double behind) const {
        if constexpr (placed == Placed::adjacent) return doubles_at<V>(column, first + i);
        if constexpr (placed == Placed::scattered)
            return converted<V>(gather<Pack<Real, sizeof(V) / sizeof(double)>>(column, slots + i));
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

/// Adds eight particles of a body from `first` on. Those before `fresh` were added already, and those behind the last
/// have no mass.
template <int D, class V, Placed placed, class Real>
void add_moments(MomentSums<D, V>& sums, const BodyColumns<D, Real>& body, std::size_t first, std::size_t fresh) {
    constexpr double no_mass = std::numeric_limits<double>::infinity();
    constexpr double min_mobility = 1 / immovable_mass;
    const BodyReader<V, placed> reader{body.slots, body.first, body.count};
    for (std::size_t p = 0; p < sums.size(); ++p) {
        const std::size_t i = first + p * (sums_at_once / sums.size());
        V position[D], displacement[D];
#pragma GCC unroll 3
        for (int k = 0; k < D; ++k) {
            const auto column = std::size_t(k) * body.stride;
            position[k] = reader.get(body.position + column, i, body.origin[k]) - body.origin[k];
            displacement[k] = reader.get(body.displacement + column, i, body.drift[k]) - body.drift[k];
        }
        V mass = 1.0 / lane::max(reader.get(body.mobility, i, no_mass), spread<V>(min_mobility));
        if (i < fresh) mass = lane_numbers<V>() < double(fresh - i) ? V{} : mass;
        sums[p].add(mass, position, displacement);
    }
}

/// Sum of the eight sums of one quantity, `get(packs)`: of those four apart first, then two apart, then one.
template <class Sums, class Get> [[gnu::always_inline]] inline double total_of(const Sums& sums, Get&& get) {
    std::array<std::decay_t<decltype(get(sums[0]))>, std::tuple_size_v<Sums>> packs;
    for (std::size_t p = 0; p < packs.size(); ++p) packs[p] = get(sums[p]);
    for (std::size_t half = packs.size() / 2; half > 0; half /= 2)
        for (std::size_t p = 0; p < half; ++p) packs[p] += packs[p + half];
    return sum_of_lanes(packs[0]);
}

/// Adds eight at a time; the last eight overlap those before.
template <int D, class V, Placed placed, class Real>
void add_all_moments(MomentSums<D, V>& sums, const BodyColumns<D, Real>& body) {
    const std::size_t last = std::max<std::size_t>(body.count, sums_at_once) - sums_at_once;
    std::size_t i = 0;
    for (; i < last; i += sums_at_once) add_moments<D, V, placed>(sums, body, i, i);
    add_moments<D, V, placed>(sums, body, last, i);
}

template <int D, class Real> void moments_of(const BodyColumns<D, Real>& body, Moments<D>& total) {
    using V = Pack<double, widest<double>>;
    MomentSums<D, V> sums{};
    if (body.count < sums_at_once)
        add_all_moments<D, V, Placed::few>(sums, body);
    else if (body.slots)
        add_all_moments<D, V, Placed::scattered>(sums, body);
    else
        add_all_moments<D, V, Placed::adjacent>(sums, body);
    total.mass = total_of(sums, [](const auto& pack) { return pack.mass; });
    total.square = total_of(sums, [](const auto& pack) { return pack.square; });
#pragma GCC unroll 3
    for (int k = 0; k < spins<D>; ++k) total.spin[k] = total_of(sums, [=](const auto& pack) { return pack.spin[k]; });
#pragma GCC unroll 3
    for (int k = 0; k < D; ++k) {
        total.position[k] = total_of(sums, [=](const auto& pack) { return pack.position[k]; });
        total.momentum[k] = total_of(sums, [=](const auto& pack) { return pack.momentum[k]; });
#pragma GCC unroll 3
        for (int j = 0; j <= k; ++j) {
            const double second = total_of(sums, [=](const auto& pack) { return pack.second[k][j]; });
            total.second.column[std::size_t(j)][k] = total.second.column[std::size_t(k)][j] = second;
        }
    }
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
