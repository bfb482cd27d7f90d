#include "sinew/math/union_find.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <vector>

namespace sinew::SINEW_TEST_FILE {
namespace {

/// Labels of components by repeated propagation of the smallest element along the pairs.
std::vector<std::uint32_t> labels(std::uint32_t elements,
                                  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
    std::vector<std::uint32_t> label(elements);
    for (std::uint32_t i = 0; i < elements; ++i) label[i] = i;
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [a, b] : pairs) {
            const auto min = std::min(label[a], label[b]);
            changed = changed || label[a] != min || label[b] != min;
            label[a] = label[b] = min;
        }
    }
    return label;
}

RC_GTEST_PROP(UnionFind, FindsTheSmallestElementOfEachComponent, ()) {
    const auto elements = *rc::gen::inRange<std::uint32_t>(1, 40);
    const auto element = rc::gen::inRange<std::uint32_t>(0, elements);
    const auto pairs =
        *rc::gen::container<std::vector<std::pair<std::uint32_t, std::uint32_t>>>(rc::gen::pair(element, element));
    UnionFind sets(elements);
    std::size_t joins = 0;
    for (const auto& [a, b] : pairs) joins += sets.join(a, b);
    const auto expected = labels(elements, pairs);
    std::size_t firsts = 0;
    for (std::uint32_t i = 0; i < elements; ++i) {
        RC_ASSERT(sets.first_of(i) == expected[i]);
        firsts += sets.is_first(i);
    }
    RC_ASSERT(joins == elements - firsts);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
