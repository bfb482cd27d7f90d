// Compiled with AVX-512 options where the build has support (CMakeLists.txt).
#if defined(__AVX512F__)
#include "sinew/solver/kernel_text.h"

SINEW_KERNELS(kernels_avx512)
#endif
