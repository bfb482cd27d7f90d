// Baseline of the processor family: SSE2, NEON.
#include "sinew/solver/kernel_text.h"

SINEW_KERNELS(kernels_sse2)
