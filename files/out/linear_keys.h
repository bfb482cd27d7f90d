#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sinew::files {

/// Frames, from 0 on, at which a motion needs a key: linear interpolation between keys is off by at most the tolerance
/// of each number. `numbers`: those of each frame in turn, as many as tolerances. A motion that ends where it is
/// throughout has one key.
std::vector<std::size_t> linear_keys(std::span<const float> numbers, std::span<const float> tolerances);

} // namespace sinew::files
