#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sinew {

/// Sets that join: each begins as one element.
class UnionFind {
  public:
    explicit UnionFind(std::size_t elements) : parent_(elements) { std::iota(parent_.begin(), parent_.end(), 0U); }

    std::size_t first_of(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// False if they were together before.
    bool join(std::size_t a, std::size_t b) {
        a = first_of(a);
        b = first_of(b);
        parent_[a < b ? b : a] = std::uint32_t(a < b ? a : b);
        return a != b;
    }

  private:
    std::vector<std::uint32_t> parent_;
};

} // namespace sinew
