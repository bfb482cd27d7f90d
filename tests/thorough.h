#pragma once

#include "tests/sanitized.h"

#include <algorithm>
#include <cstdlib>

/// How much of a test that repeats itself is run: a sample; everything where SINEW_THOROUGH is set in the environment
/// (`./dev check thorough`); a fifth of the sample under the sanitizers. These find what is wrong with a line the first
/// time it runs, and the same cases run whole in the other builds.
namespace sinew {

inline bool is_thorough() {
    return std::getenv("SINEW_THOROUGH") != nullptr;
}

/// Number of cases, `few` in a sample and `many` in all; two or more under the sanitizers.
inline int few_or_many(int few, int many) {
    if (is_thorough()) return many;
    return test::sanitized ? std::min(few, std::max(2, few / 5)) : few;
}

/// A sample takes every n-th of the cases.
inline int one_of(int n) {
    if (is_thorough()) return 1;
    return test::sanitized ? 5 * n : n;
}

/// Length of a test, seconds.
inline double lasting(double seconds) {
    return test::sanitized && !is_thorough() ? seconds / 5 : seconds;
}

} // namespace sinew
