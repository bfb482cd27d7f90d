// Baseline of the processor family: SSE2, NEON.
#include "sinew/solver/simd/targets/all.h"

SINEW_KERNELS(kernels_sse2)
