#pragma once

#include <cstdlib>

namespace sinew {

/// Tests that take a sample of many cases take them all where SINEW_THOROUGH is set in the environment, as
/// `./dev check thorough` does.
inline bool is_thorough() {
    return std::getenv("SINEW_THOROUGH") != nullptr;
}

inline int few_or_many(int few, int many) {
    return is_thorough() ? many : few;
}

} // namespace sinew
