#pragma once

#include "sinew/math/random.h"

#include <utility>
#include <vector>

namespace sinew::bench {

/// Random permutation, determined by the seed (Fisher and Yates 1938).
template <class T> void shuffle(std::vector<T>& items, std::uint64_t seed) {
    for (std::size_t i = items.size(); i > 1; --i)
        std::swap(items[i - 1], items[std::size_t(random::whole(0, std::int64_t(i) - 1, seed, 0, i))]);
}

} // namespace sinew::bench
