#pragma once

#include "sinew/math/lane.h"
#include "sinew/math/vec.h"
#include "sinew/solver/id.h"

#include <array>
#include <span>
#include <utility>

/// Vectors by row into columns of their components, by slot, and back. In space, and in single precision, four at once:
/// as many lanes as every processor has.
namespace sinew {
namespace {

using Four = lane::Pack<float, 4>;
template <int D, class Real> inline constexpr bool four_at_once = D == 3 && sizeof(Real) == 4;

/// The components of four vectors, each with a number more, become three packs; or the other way round.
[[gnu::always_inline]] inline void turn(Four& a, Four& b, Four& c, Four& d) {
    const Four ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5), ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Four cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5), cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

[[gnu::always_inline]] inline void put_three(Vec<3, float>& to, const Four& pack) {
#if defined(__SSE2__)
    _mm_storel_pi(reinterpret_cast<__m64*>(to.component.data()), pack);
    _mm_store_ss(to.component.data() + 2, _mm_movehl_ps(pack, pack));
#else
    for (int i = 0; i < 3; ++i) to[i] = pack[i];
#endif
}

/// Which rows the slots hold, and the slot of the last row there is: behind it nothing may be read.
struct SlotRows {
    const Row* row_of;
    Row slot_of_last;
};

/// Of slots [first, last); each number as `change` gives it back.
template <int D, class Real, class Change>
[[gnu::always_inline]] inline void to_columns(std::span<const Vec<D, Real>> rows, const SlotRows& slots, Row first,
                                              Row last, const std::array<Real*, D>& columns, Change&& change) {
    const auto one = [&](Row slot) {
        for (int i = 0; i < D; ++i) columns[std::size_t(i)][slot] = change(rows[slots.row_of[slot]][i]);
    };
    Row slot = first;
    if constexpr (four_at_once<D, Real>) {
        using V = Four;
        for (; slot + 4 <= last; slot += 4) {
            if (slots.slot_of_last - slot < 4) {
                for (Row i = slot; i < slot + 4; ++i) one(i);
                continue;
            }
            const auto at = [&](Row i) { return rows[slots.row_of[slot + i]].component.data(); };
            V a = lane::load<V>(at(0)), b = lane::load<V>(at(1)), c = lane::load<V>(at(2)), d = lane::load<V>(at(3));
            turn(a, b, c, d);
            lane::store(columns[0] + slot, change(a));
            lane::store(columns[1] + slot, change(b));
            lane::store(columns[2] + slot, change(c));
        }
    }
    for (; slot < last; ++slot) one(slot);
}

template <int D, class Real, class Change>
[[gnu::always_inline]] inline void to_rows(const std::array<Real*, D>& columns, const Row* row_of, Row first, Row last,
                                           std::span<Vec<D, Real>> rows, Change&& change) {
    Row slot = first;
    if constexpr (four_at_once<D, Real>) {
        using V = Four;
        for (; slot + 4 <= last; slot += 4) {
            V a = change(lane::load<V>(columns[0] + slot)), b = change(lane::load<V>(columns[1] + slot));
            V c = change(lane::load<V>(columns[2] + slot)), d{};
            turn(a, b, c, d);
            put_three(rows[row_of[slot]], a);
            put_three(rows[row_of[slot + 1]], b);
            put_three(rows[row_of[slot + 2]], c);
            put_three(rows[row_of[slot + 3]], d);
        }
    }
    for (; slot < last; ++slot)
        for (int i = 0; i < D; ++i) rows[row_of[slot]][i] = change(columns[std::size_t(i)][slot]);
}

} // namespace
} // namespace sinew
