#pragma once

#include "sinew/assert/assert.h"
#include "sinew/table/columns.h"

#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

namespace sinew {

/// Column of a table in which rows seldom differ: a single value while all rows are equal to the last bit, otherwise a
/// value per row.
template <class T> class Column {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    std::size_t size() const { return size_; }
    const T& operator[](std::size_t row) const {
        SINEW_ASSERT(row < size_, "the row is in the column");
        return apart_ ? each_[row] : all_;
    }
    const T& back() const { return (*this)[size_ - 1]; }

    template <class Is> bool any_of(Is&& is) const {
        return apart_ ? std::any_of(each_.begin(), each_.end(), is) : size_ > 0 && is(all_);
    }

    void set(std::size_t row, const T& value) {
        SINEW_ASSERT(row < size_, "the row is in the column");
        if (is_like_all(value)) return;
        set_apart();
        each_[row] = value;
    }
    void fill(const T& value) {
        all_ = value;
        std::fill(each_.begin(), each_.end(), value);
    }
    /// Appends `count` rows of one value.
    void append(std::size_t count, const T& value) {
        if (count == 0) return;
        if (size_ == 0) all_ = value;
        if (!is_like_all(value)) append_apart(count, value);
        size_ += count;
        SINEW_ASSERT(!apart_ || each_.size() == size_, "a column that is stored apart has a value per row");
    }
    void push_back(const T& value) { append(1, value); }
    /// Stores a value per row: afterwards set() allocates nothing.
    void set_apart() {
        if (apart_) return;
        each_.assign(size_, all_);
        apart_ = true;
    }
    void reserve(std::size_t rows) {
        if (apart_) each_.reserve(rows);
    }
    void erase(std::span<const char> gone) {
        SINEW_ASSERT(gone.size() == size_, "every row has a flag");
        size_ -= std::size_t(std::count(gone.begin(), gone.end(), char(1)));
        if (apart_) erase_rows(each_, gone);
    }

    /// Values by row, after set_apart().
    std::span<const T> each() const { return each_; }
    /// Values of all rows.
    std::vector<T> rows() const { return apart_ ? each_ : std::vector<T>(size_, all_); }

  private:
    T all_{};
    bool apart_ = false;
    std::size_t size_ = 0;
    std::vector<T> each_;

    [[gnu::noinline]] void append_apart(std::size_t count, T value) {
        set_apart();
        each_.insert(each_.end(), count, value);
    }
    bool is_like_all(T value) const { return !apart_ && are_same(value, all_); }
};

inline std::size_t next_flag(const Column<char>& flags, std::size_t from, char flag) {
    if (!flags.each().empty()) return next_flag(flags.each(), from, flag);
    return from < flags.size() && flags[from] == flag ? from : flags.size();
}

template <class T> void erase_rows(Column<T>& column, std::span<const char> gone) {
    column.erase(gone);
}

} // namespace sinew
