#pragma once

#include "sinew/assert/assert.h"
#include "sinew/math/sort.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew {

/// A list of entries per row, one list behind the other (compressed sparse rows).
template <class Entry> class RowLists {
  public:
    /// Lists all entries of rows [0, rows): each(visit) calls visit(row, entry), twice over in the same order. Each
    /// list keeps the order of the visits.
    template <class Each> void fill(std::size_t rows, Each&& each) {
        first_.assign(rows + 2, 0);
        each([&](std::size_t row, const Entry&) { ++first_[row + 2]; });
        for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
        entries_.resize(first_.back());
        each([&](std::size_t row, const Entry& entry) { entries_[first_[row + 1]++] = entry; });
        first_.pop_back();
    }

    std::size_t size() const { return first_.empty() ? 0 : first_.size() - 1; }
    std::span<const Entry> operator[](std::size_t row) const {
        SINEW_ASSERT(row < size(), "the row has a list");
        return std::span(entries_).subspan(first_[row], first_[row + 1] - first_[row]);
    }

    /// Number of entries of all lists.
    std::size_t entries() const { return entries_.size(); }

    /// Sorts each list and removes repetitions.
    void make_sets() {
        std::uint32_t kept = 0;
        for (std::size_t row = 0; row < size(); ++row) {
            const auto begin = entries_.begin() + first_[row], end = entries_.begin() + first_[row + 1];
            sinew::sort(begin, end);
            first_[row] = kept;
            kept = std::uint32_t(std::unique_copy(begin, end, entries_.begin() + kept) - entries_.begin());
        }
        if (!first_.empty()) first_.back() = kept;
        entries_.resize(kept);
    }

    void reserve(std::size_t rows, std::size_t entries) {
        first_.reserve(rows + 2);
        entries_.reserve(entries);
    }

  private:
    std::vector<std::uint32_t> first_; ///< offset of each list; size() + 1 entries
    std::vector<Entry> entries_;
};

} // namespace sinew
