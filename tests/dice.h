#pragma once

#include "sinew/math/random.h"

#include <algorithm>
#include <cmath>

namespace sinew::test {

/// Numbers that follow from a seed alone.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : seed_(seed) {}
    double share() { return random::uniform(seed_, next_++, 0); }
    double between(double low, double high) { return low + (high - low) * share(); }
    int below(int count) { return std::min(int(share() * count), count - 1); }
    bool one_of(int count) { return below(count) == 0; }
    /// Log-uniform.
    double scale(double low, double high) { return low * std::pow(high / low, share()); }

  private:
    std::uint64_t seed_, next_ = 0;
};

} // namespace sinew::test
