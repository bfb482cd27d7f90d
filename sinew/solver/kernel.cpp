#include "sinew/solver/kernel.h"

#include <atomic>
#include <cstdlib>
#include <cstring>

namespace sinew {

extern const KernelSet kernels_one, kernels_sse2;
#if defined(SINEW_WIDE_KERNELS)
extern const KernelSet kernels_avx2;
#if !defined(SINEW_NO_AVX512)
extern const KernelSet kernels_avx512;
#endif
#endif

namespace {

const KernelSet* set_of(Simd simd) {
#if defined(SINEW_WIDE_KERNELS)
#if !defined(SINEW_NO_AVX512)
    if (simd == Simd::avx512) return &kernels_avx512;
#endif
    if (simd == Simd::avx2) return &kernels_avx2;
#endif
    return simd == Simd::one ? &kernels_one : &kernels_sse2;
}

std::atomic<Simd>& in_use() {
    static std::atomic<Simd> simd = best_simd();
    return simd;
}

} // namespace

bool has_simd([[maybe_unused]] Simd simd) {
    if (simd == Simd::one || simd == Simd::sse2) return true;
#if defined(SINEW_WIDE_KERNELS)
    if (simd == Simd::avx2) return __builtin_cpu_supports("avx2") != 0;
#if defined(SINEW_NO_AVX512)
    return false;
#else
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
#endif
#else
    return false;
#endif
}

Simd best_simd() {
    constexpr Simd all[] = {Simd::avx512, Simd::avx2, Simd::sse2, Simd::one};
    const char* const wanted = std::getenv("SINEW_SIMD");
    for (const Simd simd : all)
        if (wanted && has_simd(simd) && std::strcmp(wanted, name_of(simd)) == 0) return simd;
    for (const Simd simd : all)
        if (has_simd(simd)) return simd;
    return Simd::one;
}

void use_simd(Simd simd) {
    if (has_simd(simd)) in_use() = simd;
}

Simd simd_in_use() {
    return in_use();
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

template <> const Kernels<2, float>& kernels() {
    return set_of(in_use())->in_2d_float;
}
template <> const Kernels<2, double>& kernels() {
    return set_of(in_use())->in_2d_double;
}
template <> const Kernels<3, float>& kernels() {
    return set_of(in_use())->in_3d_float;
}
template <> const Kernels<3, double>& kernels() {
    return set_of(in_use())->in_3d_double;
}

} // namespace sinew
