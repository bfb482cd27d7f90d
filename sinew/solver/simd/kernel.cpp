#include "sinew/solver/simd/kernel.h"

namespace sinew {

// The build names the kernels that it leaves out; the wide ones are for x86 only.
#if !defined(SINEW_WIDE_KERNELS)
#define SINEW_NO_AVX2
#define SINEW_NO_AVX512
#endif

extern const KernelSet kernels_one, kernels_sse2, kernels_avx2, kernels_avx512;

namespace {

const KernelSet* set_of(Simd simd) {
    switch (simd) {
#if !defined(SINEW_NO_AVX512)
    case Simd::avx512:
        return &kernels_avx512;
#endif
#if !defined(SINEW_NO_AVX2)
    case Simd::avx2:
        return &kernels_avx2;
#endif
#if !defined(SINEW_NO_SSE2)
    case Simd::sse2:
        return &kernels_sse2;
#endif
    default:
#if defined(SINEW_NO_ONE)
        return &kernels_sse2;
#else
        return &kernels_one;
#endif
    }
}

} // namespace

bool has_simd(Simd simd) {
    switch (simd) {
#if !defined(SINEW_NO_ONE)
    case Simd::one:
        return true;
#endif
#if !defined(SINEW_NO_SSE2)
    case Simd::sse2:
        return true;
#endif
#if !defined(SINEW_NO_AVX2)
    case Simd::avx2:
        return __builtin_cpu_supports("avx2") != 0;
#endif
#if !defined(SINEW_NO_AVX512)
    case Simd::avx512:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
#endif
    default:
        return false;
    }
}

namespace {
constexpr Simd all[] = {Simd::avx512, Simd::avx2, Simd::sse2, Simd::one};
} // namespace

Simd best_simd() {
    for (const Simd simd : all)
        if (has_simd(simd)) return simd;
    return Simd::one;
}

std::optional<Simd> simd_called(std::string_view name) {
    for (const Simd simd : all)
        if (has_simd(simd) && name == name_of(simd)) return simd;
    return std::nullopt;
}

const char* name_of(Simd simd) {
#if defined(__aarch64__)
    constexpr const char* names[] = {"one", "neon", "", ""};
#elif defined(__wasm__)
    constexpr const char* names[] = {"one", "simd128", "", ""};
#else
    constexpr const char* names[] = {"one", "sse2", "avx2", "avx512"};
#endif
    return names[int(simd)];
}

template <int D, class Real> const Kernels<D, Real>& kernels(Simd simd) {
    return *set_of(has_simd(simd) ? simd : best_simd());
}

#define SINEW_KERNELS_OF(D, Real) template const Kernels<D, Real>& kernels(Simd);
SINEW_INSTANTIATE(SINEW_KERNELS_OF)

} // namespace sinew
