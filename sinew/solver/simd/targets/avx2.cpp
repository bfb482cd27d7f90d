// Compiled with AVX2 options where the build has support (CMakeLists.txt).
#if defined(__AVX2__)
#include "sinew/solver/simd/targets/all.h"

SINEW_KERNELS(kernels_avx2)
#endif
