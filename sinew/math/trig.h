#pragma once

#include "sinew/math/scalar.h"

#include <cmath>

/// Sine, cosine, arc tangent and exponential built from +, -, *, / and sqrt alone. Results of libm differ between
/// platforms in the last bit, and one bit is enough to make two simulations diverge. Accurate to a few units in the
/// last place for arguments of ordinary size (|x| < 1e5 for sine and cosine); for all others the result is finite and
/// in range.
namespace sinew {

namespace detail {

/// x - k pi/2, with pi/2 split in two parts so that the difference keeps full precision (Cody and Waite 1980).
template <class T> T reduce_by_quarter_turns(T x, T k) {
    constexpr auto high = T(1.5707963109016418457); // pi/2 to 25 bits: k * high is exact in double for |k| < 2^28
    constexpr auto low = T(1.5893254773528197e-8);  // pi/2 - high
    return (x - k * high) - k * low;
}

/// Taylor polynomials of sine and cosine on [-pi/4, pi/4]; the first omitted term is below 1e-17.
template <class T> T sine_near_zero(T r) {
    const T s = r * r;
    T sum = T(1) / T(355687428096000.0);
    sum = T(-1) / T(1307674368000.0) + s * sum;
    sum = T(1) / T(6227020800.0) + s * sum;
    sum = T(-1) / T(39916800.0) + s * sum;
    sum = T(1) / T(362880.0) + s * sum;
    sum = T(-1) / T(5040.0) + s * sum;
    sum = T(1) / T(120.0) + s * sum;
    sum = T(-1) / T(6.0) + s * sum;
    return r + r * s * sum;
}

template <class T> T cosine_near_zero(T r) {
    const T s = r * r;
    T sum = T(1) / T(20922789888000.0);
    sum = T(-1) / T(87178291200.0) + s * sum;
    sum = T(1) / T(479001600.0) + s * sum;
    sum = T(-1) / T(3628800.0) + s * sum;
    sum = T(1) / T(40320.0) + s * sum;
    sum = T(-1) / T(720.0) + s * sum;
    sum = T(1) / T(24.0) + s * sum;
    sum = T(-1) / T(2.0) + s * sum;
    return T(1) + s * sum;
}

/// Sine of r + quarter pi/2, for quarter in 0..3.
template <class T> T sine_of_quarter(T r, T quarter) {
    const T value = quarter == T(1) || quarter == T(3) ? cosine_near_zero(r) : sine_near_zero(r);
    return quarter >= T(2) ? -value : value;
}

template <class T> T sine_shifted(T x, T quarters) {
    constexpr T largest = T(1e9); // beyond, the spacing of angles in float exceeds a whole turn
    const T bounded = clamp(x, -largest, largest);
    const T k = std::floor(bounded * (T(2) / pi<T>)+T(0.5));
    const T shifted = k + quarters;
    return sine_of_quarter(reduce_by_quarter_turns(bounded, k), shifted - T(4) * std::floor(shifted * T(0.25)));
}

/// Arc tangent on [0, 1]: the angle is halved twice by atan t = 2 atan(t / (1 + sqrt(1 + t^2))), then summed as a
/// series.
template <class T> T arctangent_of_fraction(T t) {
    const T u = t / (T(1) + square_root(T(1) + t * t)); // at most tan(pi/8)
    const T v = u / (T(1) + square_root(T(1) + u * u)); // at most tan(pi/16) = 0.199
    const T s = v * v;
    T sum = s * (T(1) / T(25));
    sum = s * (sum + T(-1) / T(23));
    sum = s * (sum + T(1) / T(21));
    sum = s * (sum + T(-1) / T(19));
    sum = s * (sum + T(1) / T(17));
    sum = s * (sum + T(-1) / T(15));
    sum = s * (sum + T(1) / T(13));
    sum = s * (sum + T(-1) / T(11));
    sum = s * (sum + T(1) / T(9));
    sum = s * (sum + T(-1) / T(7));
    sum = s * (sum + T(1) / T(5));
    sum = s * (sum + T(-1) / T(3));
    return T(4) * (v + v * sum);
}

} // namespace detail

/// Sine of x, radians. The argument is reduced in double for every T: float has no digits to spare for removing whole
/// turns.
template <std::floating_point T> T sine(T x) {
    return T(detail::sine_shifted(double(x), 0.0));
}

template <std::floating_point T> T cosine(T x) {
    return T(detail::sine_shifted(double(x), 1.0));
}

/// Angle of the point (x, y), radians, in (-pi, pi]; 0 at the origin.
template <std::floating_point T> T arctangent(T y, T x) {
    const T across = absolute(x), up = absolute(y);
    const T acute = detail::arctangent_of_fraction(min(across, up) * inverse_or_zero(max(across, up)));
    const T first_quadrant = up > across ? pi<T> / T(2) - acute : acute;
    const T upper_half = x < T(0) ? pi<T> - first_quadrant : first_quadrant;
    return y < T(0) ? -upper_half : upper_half;
}

/// e^x. The argument is clamped to +-(max_exponent - 1) ln 2, so the result is always finite: 2^-1023 to 2^1023 in
/// double.
template <std::floating_point T> T exponential(T x) {
    constexpr T widest = T(std::numeric_limits<T>::max_exponent - 1) * T(0.6931471805599453);
    const T bounded = clamp(x, -widest, widest);
    const T k = std::floor(bounded * T(1.4426950408889634) + T(0.5));
    const T r = (bounded - k * T(0.693145751953125)) - k * T(1.42860682030941723e-6); // ln 2 split in two parts
    T sum = T(1);
    for (int n = 14; n >= 1; --n) sum = T(1) + sum * r / T(n);
    return std::ldexp(sum, int(k)); // scaling by a power of two: exact unless subnormal
}

} // namespace sinew
