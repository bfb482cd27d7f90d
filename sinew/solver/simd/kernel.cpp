#include "sinew/solver/simd/kernel.h"

#include <algorithm>

namespace sinew {

extern const KernelSet kernels_one, kernels_sse2, kernels_avx2, kernels_avx512;

namespace {

struct Target {
    Simd simd;
    const KernelSet* kernels;
    bool (*runs_here)();
};

/// Kernels of the build, the widest first. The build names those that it leaves out (cmake/kernels.cmake).
constexpr Target targets[] = {
#if !defined(SINEW_NO_AVX512)
    {Simd::avx512, &kernels_avx512,
     [] {
         return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
     }},
#endif
#if !defined(SINEW_NO_AVX2)
    {Simd::avx2, &kernels_avx2, [] { return __builtin_cpu_supports("avx2") != 0; }},
#endif
#if !defined(SINEW_NO_SSE2)
    {Simd::sse2, &kernels_sse2, [] { return true; }},
#endif
#if !defined(SINEW_NO_ONE)
    {Simd::one, &kernels_one, [] { return true; }},
#endif
};

const Target* target_of(Simd simd) {
    const auto found = std::find_if(std::begin(targets), std::end(targets),
                                    [&](const Target& target) { return target.simd == simd && target.runs_here(); });
    return found == std::end(targets) ? nullptr : found;
}

} // namespace

bool has_simd(Simd simd) {
    return target_of(simd) != nullptr;
}

bool has_any_simd() {
    return std::any_of(std::begin(targets), std::end(targets), [](const Target& target) { return target.runs_here(); });
}

Simd best_simd() {
    for (const auto& target : targets)
        if (target.runs_here()) return target.simd;
    return std::rbegin(targets)->simd;
}

std::optional<Simd> simd_called(std::string_view name) {
    for (const auto& target : targets)
        if (target.runs_here() && name == name_of(target.simd)) return target.simd;
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
    const auto* target = target_of(simd);
    return *(target ? target : target_of(best_simd()))->kernels;
}

#define SINEW_KERNELS_OF(D, Real) template const Kernels<D, Real>& kernels(Simd);
SINEW_INSTANTIATE(SINEW_KERNELS_OF)

} // namespace sinew
