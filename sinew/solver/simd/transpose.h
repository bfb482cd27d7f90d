#pragma once

#include "sinew/math/lane.h"
#include "sinew/solver/simd/kernel.h"

#include <type_traits>
#include <utility>

/// Transposition between vectors by row and columns of components by slot. In 3D a whole pack of slots at once.
namespace sinew {
namespace {

using namespace lane;

template <int D, class Real> inline constexpr int turned_at_once = D != 3 || widest<Real> < 4 ? 1 : widest<Real>;

template <class V> inline constexpr std::size_t lanes_of = sizeof(V) / sizeof(V{}[0]);
template <class V> using Half = Pack<std::decay_t<decltype(V{}[0])>, int(lanes_of<V> / 2)>;

/// Lanes of(0), of(1), ... of the concatenation of a and b; as many as V has.
template <class V, class From, class Of> [[gnu::always_inline]] inline V lanes_from(const From& a, const From& b, Of) {
    return [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
        return __builtin_shufflevector(a, b, Of{}(i)...);
    }
    (std::make_index_sequence<lanes_of<V>>());
}

/// Four numbers from the row of every fourth slot; the last number belongs to the next row.
template <class V, class Real>
[[gnu::always_inline]] inline V four_from(const Real* rows, const std::uint32_t* row_of) {
    if constexpr (lanes_of<V> == 4)
        return load<V>(rows + std::size_t(row_of[0]) * 3);
    else
        return lanes_from<V>(four_from<Half<V>>(rows, row_of), four_from<Half<V>>(rows, row_of + lanes_of<V> / 2),
                             [](std::size_t i) { return i; });
}

template <class V, class Real>
[[gnu::always_inline]] inline void put_three(Real* rows, const std::uint32_t* row_of, const V& pack) {
    if constexpr (lanes_of<V> == 4) {
        Real* const to = rows + std::size_t(row_of[0]) * 3;
        __builtin_memcpy(to, &pack, 2 * sizeof(Real));
        to[2] = pack[2];
    } else {
        constexpr std::size_t half = lanes_of<V> / 2;
        put_three(rows, row_of, lanes_from<Half<V>>(pack, pack, [](std::size_t i) { return i; }));
        put_three(rows, row_of + half, lanes_from<Half<V>>(pack, pack, [](std::size_t i) { return half + i; }));
    }
}

/// In each group of four lanes: the numbers given, 0 to 3 from a and 4 to 7 from b.
template <int i, int j, int k, int l, class V> [[gnu::always_inline]] inline V choose(const V& a, const V& b) {
    return lanes_from<V>(a, b, [](std::size_t lane) {
        constexpr std::size_t chosen[] = {i, j, k, l};
        const std::size_t number = chosen[lane % 4], four = lane / 4 * 4;
        return number < 4 ? four + number : lanes_of<V> + four + number - 4;
    });
}

/// Transposes 4 x 4 groups of lanes, by interleaving within 16 bytes as processors do.
template <class V> [[gnu::always_inline]] inline void turn(V& a, V& b, V& c, V& d) {
    constexpr bool twos = sizeof(a[0]) == 8; // 16 bytes hold two doubles or four floats
    constexpr int near = twos ? 2 : 1, far = 3 - near;
    const V ab = choose<0, 4, near, near + 4>(a, b), ab_else = choose<far, far + 4, 3, 7>(a, b);
    const V cd = choose<0, 4, near, near + 4>(c, d), cd_else = choose<far, far + 4, 3, 7>(c, d);
    const V last_of_near = choose<2, 3, 6, 7>(ab, cd), first_of_far = choose<0, 1, 4, 5>(ab_else, cd_else);
    a = choose<0, 1, 4, 5>(ab, cd);
    if constexpr (twos)
        b = first_of_far, c = last_of_near;
    else
        b = last_of_near, c = first_of_far;
    d = choose<2, 3, 6, 7>(ab_else, cd_else);
}

/// A number times a factor, within a bound; NaN stays NaN, for quarantine to find.
template <bool changes, class V, class Real> [[gnu::always_inline]] inline V changed(const V& x, Real by, Real most) {
    if constexpr (changes)
        return min(max(V(x * by), spread<V>(-most)), spread<V>(most));
    else
        return x;
}

template <int D, class Real, bool changes>
[[gnu::always_inline]] inline void to_columns_as(const Transposition<D, Real>& turning, std::uint32_t first,
                                                 std::uint32_t last) {
    const auto [rows, columns, stride, row_of, slot_of_last, by, max] = turning;
    constexpr std::uint32_t width = turned_at_once<D, Real>;
    const auto change = [ by, max ]<class V>(const V& x) __attribute__((always_inline)) {
        return changed<changes>(x, by, max);
    };
    const auto one = [&](std::uint32_t slot) __attribute__((always_inline)) {
        for (unsigned k = 0; k < D; ++k) columns[k * stride + slot] = change(rows[std::size_t(row_of[slot]) * D + k]);
    };
    std::uint32_t slot = first;
    if constexpr (width > 1) {
        using V = Pack<Real, width>;
        for (; slot + width <= last; slot += width) {
            if (slot_of_last - slot < width) [[unlikely]] {
                for (std::uint32_t i = slot; i < slot + width; ++i) one(i);
                continue;
            }
            const auto* const at = row_of + slot;
            V a = four_from<V>(rows, at), b = four_from<V>(rows, at + 1), c = four_from<V>(rows, at + 2);
            V d = four_from<V>(rows, at + 3);
            turn(a, b, c, d);
            store(columns + slot, change(a));
            store(columns + stride + slot, change(b));
            store(columns + 2 * stride + slot, change(c));
        }
    }
    for (; slot < last; ++slot) one(slot);
}
template <int D, class Real>
void to_columns(const Transposition<D, Real>& turning, std::uint32_t first, std::uint32_t last) {
    if (turning.max > 0)
        to_columns_as<D, Real, true>(turning, first, last);
    else
        to_columns_as<D, Real, false>(turning, first, last);
}

template <int D, class Real, bool changes>
[[gnu::always_inline]] inline void to_rows_as(const Transposition<D, Real>& turning, std::uint32_t first,
                                              std::uint32_t last) {
    const auto [rows, columns, stride, row_of, slot_of_last, by, max] = turning;
    constexpr std::uint32_t width = turned_at_once<D, Real>;
    const auto change = [ by, max ]<class V>(const V& x) __attribute__((always_inline)) {
        return changed<changes>(x, by, max);
    };
    std::uint32_t slot = first;
    if constexpr (width > 1) {
        using V = Pack<Real, width>;
        for (; slot + width <= last; slot += width) {
            V a = change(load<V>(columns + slot)), b = change(load<V>(columns + stride + slot));
            V c = change(load<V>(columns + 2 * stride + slot)), d{};
            turn(a, b, c, d);
            const auto* const at = row_of + slot;
            put_three(rows, at, a);
            put_three(rows, at + 1, b);
            put_three(rows, at + 2, c);
            put_three(rows, at + 3, d);
        }
    }
    for (; slot < last; ++slot)
        for (unsigned k = 0; k < D; ++k) rows[std::size_t(row_of[slot]) * D + k] = change(columns[k * stride + slot]);
}
template <int D, class Real>
void to_rows(const Transposition<D, Real>& turning, std::uint32_t first, std::uint32_t last) {
    if (turning.max > 0)
        to_rows_as<D, Real, true>(turning, first, last);
    else
        to_rows_as<D, Real, false>(turning, first, last);
}

} // namespace
} // namespace sinew
