#pragma once

#if !defined(SINEW_SMALL)
#include <algorithm>
#endif
#include <functional>
#include <iterator>
#include <ranges>
#include <utility>
#include <vector>

namespace sinew {

#if defined(SINEW_SMALL)
namespace detail {

/// Moves the element at `hole` down a heap of `size` elements.
template <class It, class Less> void sift_down(It first, std::ptrdiff_t hole, std::ptrdiff_t size, Less& less) {
    auto value = std::move(first[hole]);
    for (std::ptrdiff_t child; (child = 2 * hole + 1) < size; hole = child) {
        if (child + 1 < size && less(first[child], first[child + 1])) ++child;
        if (!less(value, first[child])) break;
        first[hole] = std::move(first[child]);
    }
    first[hole] = std::move(value);
}

template <class It, class Less> void insertion_sort(It first, It last, Less& less) {
    for (auto next = first; next != last; ++next) {
        auto value = std::move(*next);
        auto hole = next;
        for (; hole != first && less(value, hole[-1]); --hole) *hole = std::move(hole[-1]);
        *hole = std::move(value);
    }
}

template <class It, class Less> void heap_sort(It first, It last, Less& less) {
    const auto size = last - first;
    for (auto i = size / 2; i-- > 0;) sift_down(first, i, size, less);
    for (auto i = size; i-- > 1;) {
        std::swap(first[0], first[i]);
        sift_down(first, 0, i, less);
    }
}

} // namespace detail
#endif

/// Sorts a range, as std::sort. A module that must be small (SINEW_SMALL) gets a tenth of the instructions: insertion
/// for a short range, else a heap.
template <class It, class Less = std::less<>> void sort(It first, It last, Less less = {}) {
#if defined(SINEW_SMALL)
    constexpr std::ptrdiff_t is_short = 12;
    last - first <= is_short ? detail::insertion_sort(first, last, less) : detail::heap_sort(first, last, less);
#else
    std::sort(first, last, less);
#endif
}
template <std::ranges::random_access_range Range, class Less = std::less<>> void sort(Range& range, Less less = {}) {
    sinew::sort(std::ranges::begin(range), std::ranges::end(range), less);
}

/// Sorts a range and keeps the order of equal elements.
template <class It, class Less = std::less<>> void stable_sort(It first, It last, Less less = {}) {
#if defined(SINEW_SMALL)
    using Element = std::pair<std::iter_value_t<It>, std::ptrdiff_t>;
    std::vector<Element> numbered;
    numbered.reserve(std::size_t(last - first));
    for (auto it = first; it != last; ++it) numbered.emplace_back(std::move(*it), it - first);
    sinew::sort(numbered.begin(), numbered.end(), [&](const Element& a, const Element& b) {
        return less(a.first, b.first) || (!less(b.first, a.first) && a.second < b.second);
    });
    for (auto& element : numbered) *first++ = std::move(element.first);
#else
    std::stable_sort(first, last, less);
#endif
}

} // namespace sinew
