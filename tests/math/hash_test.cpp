#include "sinew/math/hash.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

std::uint64_t hash_of(const std::vector<std::vector<int>>& pieces) {
    Hash hash;
    for (const auto& piece : pieces) hash.add(piece);
    return hash.value();
}

TEST(Hash, DependsOnEveryValueAndOnTheirOrder) {
    EXPECT_EQ(hash_of({{1, 2, 3}}), hash_of({{1, 2, 3}}));
    EXPECT_NE(hash_of({{1, 2, 3}}), hash_of({{1, 2, 4}}));
    EXPECT_NE(hash_of({{1}, {2}}), hash_of({{2}, {1}}));
    EXPECT_NE(hash_of({{1, 2}, {3}}), hash_of({{1}, {2, 3}}));
}

TEST(Hash, GivesTheSameNumberEverywhere) {
    Hash hash;
    EXPECT_EQ(hash.value(), 0U);
    hash.add(std::uint64_t(0x0123456789abcdef));
    EXPECT_EQ(hash.value(), 0xb78df414284277a6U);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
