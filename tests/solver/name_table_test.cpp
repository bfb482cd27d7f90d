#include "sinew/table/name_table.h"

#include <gtest/gtest.h>
#include <optional>
#include <string>

namespace sinew::SINEW_TEST_FILE {
namespace {

TEST(NameTable, FindsTheFirstOfEachNameBeAFewOrMany) {
    NameTable<int> table;
    for (int i = 0; i < 100; ++i) {
        table.emplace_back("name_" + std::to_string(i), i);
        table.emplace_back("name_0", 1000 + i);
        for (int k = 0; k <= i; ++k) ASSERT_EQ(table.find("name_" + std::to_string(k)), k);
        ASSERT_FALSE(table.find("name_" + std::to_string(i + 1)));
    }
    EXPECT_EQ(table.size(), 200U);
    EXPECT_EQ(table.begin()[2].first, "name_1");
}

TEST(NameTable, ForgetsNamesOfAFewOrMany) {
    for (const int count : {4, 40}) {
        NameTable<int> table;
        for (int i = 0; i < count; ++i) table.emplace_back("name_" + std::to_string(i), i);
        table.erase_if([](int i) { return i % 2 == 1; });
        EXPECT_EQ(table.size(), std::size_t(count) / 2);
        for (int i = 0; i < count; ++i)
            EXPECT_EQ(table.find("name_" + std::to_string(i)), i % 2 == 0 ? std::optional(i) : std::nullopt);
        table.emplace_back("name_1", 7);
        EXPECT_EQ(table.find("name_1"), 7);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
