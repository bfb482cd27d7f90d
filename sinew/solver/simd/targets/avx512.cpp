// Compiled with AVX-512 options where the build has support (CMakeLists.txt).
#if defined(__AVX512F__)
#include "sinew/solver/simd/targets/all.h"

SINEW_KERNELS(kernels_avx512)
#endif
