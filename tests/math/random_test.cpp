#include "sinew/math/random.h"

#include <gtest/gtest.h>
#include <set>

namespace sinew::SINEW_TEST_FILE {
namespace {

TEST(Random, ANumberIsAFunctionOfSeedStreamAndCount) {
    EXPECT_EQ(random::bits(1, 2, 3), random::bits(1, 2, 3));
    const std::set<std::uint64_t> distinct{random::bits(1, 2, 3), random::bits(2, 2, 3), random::bits(1, 3, 3),
                                           random::bits(1, 2, 4), random::bits(2, 1, 3), random::bits(3, 2, 1)};
    EXPECT_EQ(distinct.size(), 6U);
}

TEST(Random, MixesAsSplitMix64Does) {
    EXPECT_EQ(random::mix(0), 0xe220a8397b1dcdafU); // its first output for seed 0
    EXPECT_EQ(random::mix(0x9e3779b97f4a7c15U), 0x6e789e6aa1b965f4U);
}

// The mean of n even numbers has a deviation of 1 / sqrt(12 n) = 0.0009; five of them.
TEST(Random, UniformIsEvenInZeroToOneAndTheSameInBothPrecisions) {
    double sum = 0;
    constexpr int n = 100000;
    for (int i = 0; i < n; ++i) {
        const double u = random::uniform(9, 0, std::uint64_t(i));
        ASSERT_TRUE(u >= 0 && u < 1);
        ASSERT_EQ(u, double(random::uniform<float>(9, 0, std::uint64_t(i))));
        sum += u;
    }
    EXPECT_NEAR(sum / n, 0.5, 0.0046);
}

TEST(Random, SymmetricLiesAroundZero) {
    for (std::uint64_t i = 0; i < 1000; ++i) ASSERT_EQ(random::symmetric(1, 2, i), 2 * random::uniform(1, 2, i) - 1);
}

// 90000 draws of nine numbers: each comes 10000 times with a deviation of 94; five of them.
TEST(Random, WholeNumbersIncludeBothEndsAndAreEquallyLikely) {
    int count[9] = {};
    for (std::uint64_t i = 0; i < 90000; ++i) {
        const auto drawn = random::whole(-2, 6, 3, 4, i);
        ASSERT_TRUE(drawn >= -2 && drawn <= 6);
        ++count[drawn + 2];
    }
    for (const int times : count) EXPECT_NEAR(times, 10000, 470);
    EXPECT_EQ(random::whole(5, 5, 1, 2, 3), 5);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
