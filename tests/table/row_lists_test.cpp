#include "sinew/table/row_lists.h"

#include <gtest/gtest.h>
#include <map>
#include <rapidcheck/gtest.h>
#include <set>
#include <vector>

namespace sinew::SINEW_TEST_FILE {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

RowLists<std::uint32_t> lists_of(std::uint32_t rows, const Pairs& pairs) {
    RowLists<std::uint32_t> lists;
    lists.fill(rows, [&](auto&& visit) {
        for (const auto& [row, entry] : pairs) visit(row, entry);
    });
    return lists;
}

RC_GTEST_PROP(RowLists, KeepTheOrderOfTheVisits, ()) {
    const auto rows = *rc::gen::inRange<std::uint32_t>(1, 20);
    const auto pairs = *rc::gen::container<Pairs>(
        rc::gen::pair(rc::gen::inRange<std::uint32_t>(0, rows), rc::gen::inRange<std::uint32_t>(0, 9)));
    const auto lists = lists_of(rows, pairs);
    std::map<std::uint32_t, std::vector<std::uint32_t>> expected;
    for (const auto& [row, entry] : pairs) expected[row].push_back(entry);
    RC_ASSERT(lists.size() == rows);
    RC_ASSERT(lists.entries() == pairs.size());
    for (std::uint32_t row = 0; row < rows; ++row)
        RC_ASSERT(std::vector(lists[row].begin(), lists[row].end()) == expected[row]);
}

RC_GTEST_PROP(RowLists, BecomeSets, ()) {
    const auto rows = *rc::gen::inRange<std::uint32_t>(1, 20);
    const auto pairs = *rc::gen::container<Pairs>(
        rc::gen::pair(rc::gen::inRange<std::uint32_t>(0, rows), rc::gen::inRange<std::uint32_t>(0, 9)));
    auto lists = lists_of(rows, pairs);
    lists.make_sets();
    std::map<std::uint32_t, std::set<std::uint32_t>> expected;
    for (const auto& [row, entry] : pairs) expected[row].insert(entry);
    for (std::uint32_t row = 0; row < rows; ++row)
        RC_ASSERT(std::vector(lists[row].begin(), lists[row].end()) ==
                  std::vector(expected[row].begin(), expected[row].end()));
}

TEST(RowLists, MayBeEmpty) {
    RowLists<int> lists;
    EXPECT_EQ(lists.size(), 0U);
    lists.fill(3, [](auto&&) {});
    lists.make_sets();
    for (std::size_t row = 0; row < lists.size(); ++row) EXPECT_TRUE(lists[row].empty());
    EXPECT_EQ(lists.size(), 3U);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
