#pragma once

#include "sinew/math/scalar.h"

#include <cmath>

/// Sine, cosine, arc tangent and exponential from +, -, *, / and sqrt alone: libm's differ between platforms in the
/// last bit, and one bit is enough to part two worlds. Accurate to a few units in the last place where the argument is
/// of ordinary size (|x| < 1e5 for sine and cosine); everything else stays finite and in range.
namespace sinew {

namespace detail {

/// x - k * quarter turn, the product split so that the difference loses nothing (Cody and Waite 1980).
template <class T> T reduce_by_quarter_turns(T x, T k) {
    constexpr auto high = T(1.5707963109016418457); // pi/2 to 24 bits: k * high is exact in double
    constexpr auto low = T(1.5893254773528197e-8);  // what is left of it
    return (x - k * high) - k * low;
}

/// The Taylor polynomials of sine and cosine on [-pi/4, pi/4]; the first term left out is below 1e-17.
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

/// Sine of r plus `quarter` quarter turns, quarter in 0..3.
template <class T> T sine_of_quarter(T r, T quarter) {
    const T value = quarter == T(1) || quarter == T(3) ? cosine_near_zero(r) : sine_near_zero(r);
    return quarter >= T(2) ? -value : value;
}

template <class T> T sine_shifted(T x, T quarters) {
    constexpr T largest = T(1e9); // beyond it a float or double angle no longer tells one turn from the next
    const T bounded = clamp(x, -largest, largest);
    const T k = std::floor(bounded * (T(2) / pi<T>)+T(0.5));
    const T shifted = k + quarters;
    return sine_of_quarter(reduce_by_quarter_turns(bounded, k), shifted - T(4) * std::floor(shifted * T(0.25)));
}

/// Arc tangent on [0, 1]: the angle is halved, atan t = 2 atan(t / (1 + sqrt(1 + t^2))), then its series summed.
template <class T> T arctangent_of_fraction(T t) {
    const T u = t / (T(1) + square_root(T(1) + t * t)); // at most tan(pi/8)
    const T v = u / (T(1) + square_root(T(1) + u * u)); // at most tan(pi/16) = 0.199
    const T s = v * v;
    T sum = T(0);
    for (int n = 25; n >= 3; n -= 2) sum = s * (sum + (n % 4 == 1 ? T(1) : T(-1)) / T(n));
    return T(4) * (v + v * sum);
}

} // namespace detail

/// Reduced in double whatever T: a float has no digits to spare for taking turns off.
template <std::floating_point T> T sine(T x) {
    return T(detail::sine_shifted(double(x), 0.0));
}

template <std::floating_point T> T cosine(T x) {
    return T(detail::sine_shifted(double(x), 1.0));
}

/// The angle of the point (x, y) in (-pi, pi]; 0 at the origin.
template <std::floating_point T> T arctangent(T y, T x) {
    const T across = absolute(x), up = absolute(y);
    const T acute = detail::arctangent_of_fraction(minimum(across, up) * inverse_or_zero(maximum(across, up)));
    const T first_quadrant = up > across ? pi<T> / T(2) - acute : acute;
    const T upper_half = x < T(0) ? pi<T> - first_quadrant : first_quadrant;
    return y < T(0) ? -upper_half : upper_half;
}

/// e^x; 0 and the largest finite number where the true value is out of range.
template <std::floating_point T> T exponential(T x) {
    constexpr T widest = T(std::numeric_limits<T>::max_exponent - 1) * T(0.6931471805599453);
    const T bounded = clamp(x, -widest, widest);
    const T k = std::floor(bounded * T(1.4426950408889634) + T(0.5));
    const T r = (bounded - k * T(0.693145751953125)) - k * T(1.42860682030941723e-6); // ln 2 in two parts
    T sum = T(1);
    for (int n = 14; n >= 1; --n) sum = T(1) + sum * r / T(n);
    return std::ldexp(sum, int(k)); // a power of two: exact
}

} // namespace sinew
