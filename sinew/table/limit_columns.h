#pragma once

#include "sinew/assert/assert.h"
#include "sinew/table/columns.h"

#include <span>
#include <vector>

namespace sinew {

/// Columns of lower and upper limits, stored as one column while the two are equal in every row (all constraints are
/// equalities).
template <class Real> class LimitColumns {
  public:
    std::size_t size() const { return low_.size(); }
    Real low(std::size_t row) const {
        SINEW_ASSERT(row < size(), "the row is in the column");
        return low_[row];
    }
    Real high(std::size_t row) const {
        SINEW_ASSERT(row < size(), "the row is in the column");
        return apart_ ? high_[row] : low_[row];
    }

    void set(std::size_t row, Real low, Real high) {
        SINEW_ASSERT(row < size(), "the row is in the column");
        if (!are_same(low, high)) set_apart();
        low_[row] = low;
        if (apart_) high_[row] = high;
    }
    /// Replaces both limits by f(limit).
    template <class F> void change(std::size_t row, F&& f) { set(row, f(low(row)), f(high(row))); }
    /// Appends `count` equal rows.
    void append(std::size_t count, Real low, Real high) {
        if (!are_same(low, high)) set_apart();
        low_.insert(low_.end(), count, low);
        if (apart_) high_.insert(high_.end(), count, high);
    }
    /// Resizes; new rows have limits 0 and 0.
    void resize(std::size_t rows) {
        low_.resize(rows);
        if (apart_) high_.resize(rows);
    }
    void reserve(std::size_t rows) {
        low_.reserve(rows);
        if (apart_) high_.reserve(rows);
    }
    void erase(std::span<const char> gone) {
        erase_rows(low_, gone);
        if (apart_) erase_rows(high_, gone);
    }

    /// Stores two columns: afterwards set() allocates nothing.
    void set_apart() {
        if (apart_) return;
        high_.reserve(low_.capacity());
        high_ = low_;
        apart_ = true;
    }

    /// Limits of all rows.
    const std::vector<Real>& lows() const { return low_; }
    const std::vector<Real>& highs() const { return apart_ ? high_ : low_; }

  private:
    bool apart_ = false;
    std::vector<Real> low_, high_; ///< `high_` is empty until stored apart
};

template <class Real> void erase_rows(LimitColumns<Real>& limits, std::span<const char> gone) {
    limits.erase(gone);
}

} // namespace sinew
