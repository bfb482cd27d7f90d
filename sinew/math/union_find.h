#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace sinew {

/// Disjoint sets (union-find) with path halving: the one way to find connected components. The smallest element
/// represents a set.
class UnionFind {
  public:
    UnionFind() = default;
    explicit UnionFind(std::size_t elements) { reset(elements); }

    /// Every element of [0, elements) becomes a set of one.
    void reset(std::size_t elements) {
        parent_.resize(elements);
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    /// Room for so many elements, whose sets are unknown until separate(): for searches of a part of the elements.
    void make_room(std::size_t elements) { parent_.resize(elements); }
    void separate(std::uint32_t i) { parent_[i] = i; }
    /// Puts a separate element into the set represented by `first`, at most i.
    void attach(std::uint32_t i, std::uint32_t first) { parent_[i] = first; }

    std::uint32_t first_of(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    bool is_first(std::uint32_t i) const { return parent_[i] == i; }

    /// Merges the sets of a and b. False if a and b were already in one set.
    bool join(std::uint32_t a, std::uint32_t b) {
        a = first_of(a);
        b = first_of(b);
        if (a > b) std::swap(a, b);
        parent_[b] = a;
        return a != b;
    }

    void reserve(std::size_t elements) { parent_.reserve(elements); }

  private:
    std::vector<std::uint32_t> parent_;
};

} // namespace sinew
