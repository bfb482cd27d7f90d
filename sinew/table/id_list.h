#pragma once

#include "sinew/assert/assert.h"
#include "sinew/table/id.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <vector>

/// Compressed list of ids. Prefabs build in rows, so ids mostly form arithmetic sequences, each stored in constant
/// memory.
namespace sinew {

/// Id `indices` further on.
template <class Tag> Id<Tag> further(const Id<Tag>& id, std::uint32_t indices) {
    return {id.index + indices, id.generation};
}
inline ConstraintId further(const ConstraintId& id, std::uint32_t indices) {
    return {id.kind, further(id.id, indices)};
}
template <class Tag> std::uint32_t index_in(const Id<Tag>& id) {
    return id.index;
}
inline std::uint32_t index_in(const ConstraintId& id) {
    return id.id.index;
}

template <class IdT> class IdList {
    /// Arithmetic sequence: `first`, then an id every `step` indices.
    struct Steps {
        IdT first{};
        std::uint32_t step = 0;
        std::uint32_t begin = 0; ///< number of ids before the sequence
        IdT at(std::size_t i) const { return further(first, std::uint32_t(i - begin) * step); }
        friend bool operator==(const Steps&, const Steps&) = default;
    };

  public:
    class Iterator {
      public:
        using iterator_category = std::input_iterator_tag;
        using value_type = IdT;
        using difference_type = std::ptrdiff_t;
        using pointer = void;
        using reference = IdT;

        Iterator(const IdList& list, std::size_t at) : list_(&list), at_(at) {}
        IdT operator*() const {
            SINEW_ASSERT(at_ < list_->size(), "the iterator is before the end");
            return list_->steps_[steps_].at(at_);
        }
        Iterator& operator++() {
            SINEW_ASSERT(at_ < list_->size(), "the iterator is before the end");
            ++at_;
            if (steps_ + 1 < list_->steps_.size() && at_ == list_->steps_[steps_ + 1].begin) ++steps_;
            return *this;
        }
        void operator++(int) { ++*this; }
        friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }
        friend std::ptrdiff_t operator-(const Iterator& a, const Iterator& b) {
            return std::ptrdiff_t(a.at_) - std::ptrdiff_t(b.at_);
        }

      private:
        const IdList* list_;
        std::size_t at_ = 0, steps_ = 0; ///< index of the sequence; meaningless at the end
    };
    using value_type = IdT;
    using iterator = Iterator;
    using const_iterator = Iterator;

    IdList() = default;
    IdList(std::initializer_list<IdT> ids) : IdList(std::vector<IdT>(ids)) {}
    IdList(const std::vector<IdT>& ids) {
        for (const auto& id : ids) push_back(id);
    }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    Iterator begin() const { return {*this, 0}; }
    Iterator end() const { return {*this, size_}; }
    IdT operator[](std::size_t i) const {
        SINEW_ASSERT(i < size_, "the index is in the list");
        const auto after = std::upper_bound(steps_.begin(), steps_.end(), i,
                                            [](std::size_t at, const Steps& steps) { return at < steps.begin; });
        return std::prev(after)->at(i);
    }
    void push_back(const IdT& id) {
        if (!steps_.empty() && size_ == steps_.back().begin + 1)
            steps_.back().step = index_in(id) - index_in(steps_.back().first);
        if (steps_.empty() || steps_.back().at(size_) != id) steps_.push_back({.first = id, .begin = size_});
        ++size_;
    }
    void clear() { *this = {}; }

    friend bool operator==(const IdList&, const IdList&) = default;

  private:
    std::vector<Steps> steps_;
    std::uint32_t size_ = 0;
};

} // namespace sinew
