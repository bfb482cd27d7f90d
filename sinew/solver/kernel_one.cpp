#define SINEW_ONE_LANE
#include "sinew/solver/kernel_text.h"

SINEW_KERNELS(kernels_one)
