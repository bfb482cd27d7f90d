// What every processor of the family has: SSE2, NEON.
#include "sinew/solver/kernel_text.h"

SINEW_KERNELS(kernels_sse2)
