#pragma once

#include "sinew/math/vec.h"
#include "sinew/scene/json.h"

#include <cmath>

/// JSON of scenes, in numbers that people can read.
namespace sinew::files {

/// A number with six significant digits at least, and no more than nine digits behind the point.
inline json::Value rounded_number(double number) {
    constexpr double digits = 1e6;
    if (number == 0 || !std::isfinite(number)) return 0;
    const double size = std::pow(10, std::ceil(std::log10(std::abs(number))));
    const double grid = digits / std::fmax(size, 1e-3);
    const double result = std::round(number * grid) / grid;
    if (result == std::floor(result) && std::abs(result) < 1e15) return std::int64_t(result);
    return result;
}

template <int D> json::Value point_json(const Vec<D, double>& point) {
    json::Array numbers;
    for (int i = 0; i < D; ++i) numbers.push_back(rounded_number(point[i]));
    return numbers;
}

} // namespace sinew::files
