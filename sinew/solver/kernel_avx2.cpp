// Compiled with the options of its processors, where the build knows them (CMakeLists.txt).
#if defined(__AVX2__)
#include "sinew/solver/kernel_text.h"

SINEW_KERNELS(kernels_avx2)
#endif
