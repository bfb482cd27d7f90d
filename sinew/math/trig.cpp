#include "sinew/math/trig.h"

namespace sinew {

template double detail::sine_shifted(double, double);
template double detail::arctangent_of_fraction(double);
template float detail::arctangent_of_fraction(float);
template double arctangent(double, double);
template float arctangent(float, float);

} // namespace sinew
