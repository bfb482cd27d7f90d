#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sinew {

/// Disjoint sets (union-find) with path halving; each element begins as a set of one. The smallest element represents a
/// set.
class UnionFind {
  public:
    explicit UnionFind(std::size_t elements) : parent_(elements) { std::iota(parent_.begin(), parent_.end(), 0U); }

    std::size_t first_of(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// Merges the sets of a and b. False if a and b were already in one set.
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
