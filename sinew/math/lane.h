#pragma once

#include "sinew/math/scalar.h" // before any `using namespace lane`: its min and max would be ambiguous in there

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif
#if defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

/// Packs of numbers for SIMD code. A pack of width 1 is the plain number; +, -, *, /, comparisons, `a < b ? a : b` and
/// the functions below mean the same for both. Code templated on an open type V therefore runs on either and gives the
/// same bits in every lane. All names here have internal linkage, because each including file may be compiled for
/// another instruction set.
namespace sinew {
namespace {
namespace lane {

template <class Real, int width> struct PackOf {
    typedef Real type __attribute__((vector_size(width * sizeof(Real))));
};
template <class Real> struct PackOf<Real, 1> { using type = Real; };
template <class Real, int width> using Pack = typename PackOf<Real, width>::type;

/// Widest pack, in bytes, of the instruction set this file is compiled for.
#if defined(SINEW_ONE_LANE)
inline constexpr int bytes = 0;
#elif defined(__AVX512F__)
inline constexpr int bytes = 64;
#elif defined(__AVX2__)
inline constexpr int bytes = 32;
#else
inline constexpr int bytes = 16;
#endif
template <class Real> inline constexpr int widest = bytes > 0 ? bytes / int(sizeof(Real)) : 1;

template <class V, class Real> [[gnu::always_inline]] inline V load(const Real* from) {
    V pack;
    __builtin_memcpy(&pack, from, sizeof pack);
    return pack;
}
template <class V, class Real> [[gnu::always_inline]] inline void store(Real* to, const V& pack) {
    __builtin_memcpy(to, &pack, sizeof pack);
}
/// Broadcasts a number to every lane.
template <class V, class Real> [[gnu::always_inline]] inline V spread(Real number) {
    return number - V{};
}

[[gnu::always_inline]] inline float root(float x) {
    return __builtin_sqrtf(x);
}
[[gnu::always_inline]] inline double root(double x) {
    return __builtin_sqrt(x);
}
#if defined(__SSE2__)
[[gnu::always_inline]] inline Pack<float, 4> root(Pack<float, 4> x) {
    return _mm_sqrt_ps(x);
}
[[gnu::always_inline]] inline Pack<double, 2> root(Pack<double, 2> x) {
    return _mm_sqrt_pd(x);
}
#endif
#if defined(__wasm_simd128__)
[[gnu::always_inline]] inline Pack<float, 4> root(Pack<float, 4> x) {
    return Pack<float, 4>(wasm_f32x4_sqrt(v128_t(x)));
}
[[gnu::always_inline]] inline Pack<double, 2> root(Pack<double, 2> x) {
    return Pack<double, 2>(wasm_f64x2_sqrt(v128_t(x)));
}
#endif
#if defined(__AVX2__)
[[gnu::always_inline]] inline Pack<float, 8> root(Pack<float, 8> x) {
    return _mm256_sqrt_ps(x);
}
[[gnu::always_inline]] inline Pack<double, 4> root(Pack<double, 4> x) {
    return _mm256_sqrt_pd(x);
}
#endif
#if defined(__AVX512F__)
[[gnu::always_inline]] inline Pack<float, 16> root(Pack<float, 16> x) {
    return _mm512_maskz_sqrt_ps(0xffff, x); // the unmasked intrinsic draws a warning from g++ 12
}
[[gnu::always_inline]] inline Pack<double, 8> root(Pack<double, 8> x) {
    return _mm512_maskz_sqrt_pd(0xff, x);
}
#endif
template <class V> [[gnu::always_inline]] inline V root(V x) {
    V roots{};
    for (unsigned i = 0; i < sizeof(V) / sizeof(x[0]); ++i) roots[i] = root(x[i]);
    return roots;
}

template <class V> [[gnu::always_inline]] inline V min(V a, V b) {
    return b < a ? b : a;
}
template <class V> [[gnu::always_inline]] inline V max(V a, V b) {
    return a < b ? b : a;
}
#if defined(__AVX2__)
// g++ 12 emits two instructions for the generic form; min and max have the same meaning, NaN included.
[[gnu::always_inline]] inline Pack<float, 8> min(Pack<float, 8> a, Pack<float, 8> b) {
    return _mm256_min_ps(b, a);
}
[[gnu::always_inline]] inline Pack<double, 4> min(Pack<double, 4> a, Pack<double, 4> b) {
    return _mm256_min_pd(b, a);
}
[[gnu::always_inline]] inline Pack<float, 8> max(Pack<float, 8> a, Pack<float, 8> b) {
    return _mm256_max_ps(b, a);
}
[[gnu::always_inline]] inline Pack<double, 4> max(Pack<double, 4> a, Pack<double, 4> b) {
    return _mm256_max_pd(b, a);
}
#endif
template <class V> [[gnu::always_inline]] inline V within(const V& x, const V& limit) {
    return min(limit, max(-limit, x));
}

template <class V> [[gnu::always_inline]] inline auto lane_of(const V& pack, int i) {
    if constexpr (std::is_arithmetic_v<V>)
        return pack;
    else
        return pack[i];
}
template <class V, class Real> [[gnu::always_inline]] inline void put_lane(V& pack, int i, Real number) {
    if constexpr (sizeof(V) == sizeof(Real))
        pack = number;
    else
        pack[i] = number;
}

/// Number of each lane: 0, 1, 2 and so on.
template <class V> [[gnu::always_inline]] inline V lane_numbers() {
    V numbers{};
    for (int i = 1; i < int(sizeof(V) / sizeof(lane_of(numbers, 0))); ++i)
        put_lane(numbers, i, lane_of(numbers, i - 1) + 1);
    return numbers;
}
/// Sum of all lanes: of those half a pack apart first, and so on down to neighbours.
template <class V> [[gnu::always_inline]] inline auto sum_of_lanes(const V& pack) {
    if constexpr (std::is_arithmetic_v<V>) {
        return pack;
    } else {
        using Real = std::decay_t<decltype(pack[0])>;
        constexpr int half = int(sizeof(V) / sizeof(Real)) / 2;
        Pack<Real, half> halves[2];
        __builtin_memcpy(halves, &pack, sizeof pack);
        return sum_of_lanes(halves[0] + halves[1]);
    }
}

/// Gathers one number for each lane from the indices `at` of a column; `scatter` writes them back.
template <class V, class Real> [[gnu::always_inline]] inline V gather(const Real* column, const unsigned* at) {
#if defined(__AVX512F__)
    if constexpr (sizeof(V) == 64 && sizeof(Real) == 4)
        return _mm512_mask_i32gather_ps(_mm512_setzero_ps(), 0xffff, _mm512_loadu_si512(at), column, 4);
    else if constexpr (sizeof(V) == 64)
        return _mm512_mask_i32gather_pd(_mm512_setzero_pd(), 0xff,
                                        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at)), column, 8);
    else
#endif
        if constexpr (sizeof(V) == 16 && sizeof(Real) == 4) {
        return V{column[at[0]], column[at[1]], column[at[2]], column[at[3]]};
    } else if constexpr (sizeof(V) == 16) {
        return V{column[at[0]], column[at[1]]};
    } else if constexpr (sizeof(V) == 8 && sizeof(Real) == 4) {
        return V{column[at[0]], column[at[1]]};
    } else if constexpr (sizeof(V) == 32 && sizeof(Real) == 4) {
        return V{column[at[0]], column[at[1]], column[at[2]], column[at[3]],
                 column[at[4]], column[at[5]], column[at[6]], column[at[7]]};
    } else if constexpr (sizeof(V) == 32) {
        return V{column[at[0]], column[at[1]], column[at[2]], column[at[3]]};
    } else {
        return column[at[0]];
    }
}
template <class V, class Real>
[[gnu::always_inline]] inline void scatter(Real* column, const unsigned* at, const V& pack) {
#if defined(__AVX512F__)
    if constexpr (sizeof(V) == 64 && sizeof(Real) == 4)
        return _mm512_i32scatter_ps(column, _mm512_loadu_si512(at), pack, 4);
    else if constexpr (sizeof(V) == 64)
        return _mm512_i32scatter_pd(column, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at)), pack, 8);
#endif
    Real numbers[sizeof(V) / sizeof(Real)];
    store(numbers, pack);
    for (unsigned i = 0; i < sizeof(V) / sizeof(Real); ++i) column[at[i]] = numbers[i];
}

/// True if the comparison holds in at least one lane.
[[gnu::always_inline]] inline bool any(bool holds) {
    return holds;
}
template <class Mask> [[gnu::always_inline]] inline bool any(const Mask& holds) {
#if defined(__AVX512F__)
    if constexpr (sizeof(Mask) == 64) {
        const auto words = reinterpret_cast<__m512i>(holds);
        return _mm512_test_epi64_mask(words, words) != 0;
    } else
#endif
#if defined(__AVX2__)
        if constexpr (sizeof(Mask) == 32) {
        return _mm256_movemask_epi8(reinterpret_cast<__m256i>(holds)) != 0;
    } else
#endif
#if defined(__SSE2__)
        if constexpr (sizeof(Mask) == 16) {
        return _mm_movemask_epi8(reinterpret_cast<__m128i>(holds)) != 0;
    } else
#endif
#if defined(__wasm_simd128__)
        if constexpr (sizeof(Mask) == 16) {
        return wasm_v128_any_true(v128_t(holds));
    } else
#endif
    {
        unsigned long long words[sizeof(Mask) / 8], all = 0;
        __builtin_memcpy(words, &holds, sizeof holds);
        for (const auto word : words) all |= word;
        return all != 0;
    }
}

/// True if a < b in at least one lane.
template <class V> [[gnu::always_inline]] inline bool any_less(const V& a, const V& b) {
#if defined(__AVX512F__)
    if constexpr (sizeof(V) == 64) {
        if constexpr (sizeof(a[0]) == 4)
            return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ) != 0;
        else
            return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ) != 0;
    } else
#endif
        return any(a < b);
}

template <class V, std::size_t packs> [[gnu::always_inline]] inline bool any_less(const V& a, const V (&b)[packs]) {
    if constexpr (packs == 1) return any_less(a, b[0]);
    if constexpr (sizeof(V) == 64) return any_less(a, b[0]) || any_less(a, b[1]);
    auto less = a < b[0];
    for (unsigned p = 1; p < packs; ++p) less |= a < b[p];
    return any(less);
}

/// Stores the first `count` lanes; memory behind them is not touched.
template <class V, class Real> [[gnu::always_inline]] inline void store_first(Real* to, const V& pack, int count) {
#if defined(__AVX512F__)
    if constexpr (sizeof(V) == 64 && sizeof(Real) == 4)
        return _mm512_mask_storeu_ps(to, __mmask16((1U << count) - 1), pack);
    else if constexpr (sizeof(V) == 64)
        return _mm512_mask_storeu_pd(to, __mmask8((1U << count) - 1), pack);
    else
#endif
    {
        constexpr int width = sizeof(V) / sizeof(Real);
        Real numbers[width];
        store(numbers, pack);
        const Real* from = numbers;
#pragma GCC unroll 8
        for (int piece = width; piece > 0; piece /= 2)
            if (count & piece) {
                __builtin_memcpy(to, from, std::size_t(piece) * sizeof(Real));
                to += piece, from += piece;
            }
    }
}

/// Strided store of all lanes, or of the first `count`: lane i goes to to[i * apart]. Memory in between is not touched.
template <bool all, class V, class Real>
[[gnu::always_inline]] inline void store_strided(Real* to, const V& pack, int count, std::size_t stride) {
#if defined(__AVX512F__)
    if constexpr (sizeof(V) == 64 && sizeof(Real) == 4)
        if (stride == 2) {
            const auto low = _mm512_set_epi32(7, 7, 6, 6, 5, 5, 4, 4, 3, 3, 2, 2, 1, 1, 0, 0);
            const auto high = _mm512_set_epi32(15, 15, 14, 14, 13, 13, 12, 12, 11, 11, 10, 10, 9, 9, 8, 8);
            const auto wanted = unsigned(((1ULL << 2 * count) - 1) & 0x55555555ULL);
            _mm512_mask_storeu_ps(to, __mmask16(wanted), _mm512_maskz_permutexvar_ps(0xffff, low, pack));
            _mm512_mask_storeu_ps(to + 16, __mmask16(wanted >> 16), _mm512_maskz_permutexvar_ps(0xffff, high, pack));
            return;
        }
#endif
    if constexpr (all)
#pragma GCC unroll 16
        for (int i = 0; i < int(sizeof(V) / sizeof(Real)); ++i, to += stride) *to = lane_of(pack, i);
    else
        for (int i = 0; i < count; ++i) to[std::size_t(i) * stride] = lane_of(pack, i);
}

/// The first `count` lanes of the pack, and the number `behind` in all lanes after.
template <class V, class Real> [[gnu::always_inline]] inline V first_lanes(const V& pack, int count, Real behind) {
#if defined(__AVX512F__)
    if constexpr (sizeof(V) == 64 && sizeof(Real) == 4)
        return _mm512_mask_blend_ps(__mmask16((1U << count) - 1), _mm512_set1_ps(behind), pack);
    else if constexpr (sizeof(V) == 64)
        return _mm512_mask_blend_pd(__mmask8((1U << count) - 1), _mm512_set1_pd(behind), pack);
    else
#endif
        if constexpr (sizeof(V) == sizeof(Real)) {
        return count > 0 ? pack : behind;
    } else {
        constexpr std::size_t width = sizeof(V) / sizeof(Real);
        using Lane = std::conditional_t<sizeof(Real) == 4, int, long long>;
        static constexpr auto first = [] {
            std::array<Lane, 2 * width> lanes{};
            std::fill_n(lanes.begin(), width, Lane(-1));
            return lanes;
        }();
        return load<decltype(pack < pack)>(first.data() + width - std::size_t(count)) ? pack : spread<V>(behind);
    }
}

/// Stores all lanes, or the first `count`.
template <bool all, class V, class Real> [[gnu::always_inline]] inline void put(Real* to, const V& pack, int count) {
    if constexpr (all)
        store(to, pack);
    else
        store_first(to, pack, count);
}

} // namespace lane
} // namespace
} // namespace sinew
