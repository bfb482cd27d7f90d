#pragma once

#include "sinew/solver/columns.h"

#include <span>
#include <vector>

namespace sinew {

/// The two columns that measures are held between. While each row has only one limit - all constraints are exact - one
/// column is both.
template <class Real> class LimitColumns {
  public:
    std::size_t size() const { return low_.size(); }
    Real low(std::size_t row) const { return low_[row]; }
    Real high(std::size_t row) const { return apart_ ? high_[row] : low_[row]; }

    void set(std::size_t row, Real low, Real high) {
        if (!are_same(low, high)) set_apart();
        low_[row] = low;
        if (apart_) high_[row] = high;
    }
    /// Of each limit, what f makes of it.
    template <class F> void change(std::size_t row, F&& f) { set(row, f(low(row)), f(high(row))); }
    /// So many more rows of the same.
    void append(std::size_t count, Real low, Real high) {
        if (!are_same(low, high)) set_apart();
        low_.insert(low_.end(), count, low);
        if (apart_) high_.insert(high_.end(), count, high);
    }
    /// Rows at the end come, between 0 and 0, or go.
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

    /// From now on setting a row allocates nothing.
    void set_apart() {
        if (apart_) return;
        high_.reserve(low_.capacity());
        high_ = low_;
        apart_ = true;
    }

    /// All rows, one after the other.
    const std::vector<Real>& lows() const { return low_; }
    const std::vector<Real>& highs() const { return apart_ ? high_ : low_; }

  private:
    bool apart_ = false;
    std::vector<Real> low_, high_; ///< the latter empty until they are apart
};

template <class Real> void erase_rows(LimitColumns<Real>& limits, std::span<const char> gone) {
    limits.erase(gone);
}

} // namespace sinew
