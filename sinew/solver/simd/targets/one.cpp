#define SINEW_ONE_LANE
#include "sinew/solver/simd/targets/all.h"

SINEW_KERNELS(kernels_one)
