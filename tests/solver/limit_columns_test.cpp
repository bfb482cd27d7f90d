#include "sinew/table/limit_columns.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

TEST(LimitColumns, AreOneWhileEachRowHasOneLimit) {
    LimitColumns<double> limits;
    limits.append(3, 2, 2);
    limits.set(1, 5, 5);
    EXPECT_EQ(&limits.lows(), &limits.highs());
    EXPECT_EQ(limits.high(1), 5);

    limits.set(2, 2, 7);
    limits.append(1, -1, 1);
    EXPECT_EQ(limits.lows(), (std::vector<double>{2, 5, 2, -1}));
    EXPECT_EQ(limits.highs(), (std::vector<double>{2, 5, 7, 1}));
}

TEST(LimitColumns, EraseRowsOfBoth) {
    const std::vector<char> gone{1, 0, 1, 0};
    for (const double last : {4.0, 9.0}) {
        LimitColumns<double> limits;
        for (const double low : {1.0, 2.0, 3.0}) limits.append(1, low, low);
        limits.append(1, 4, last);
        erase_rows(limits, gone);
        EXPECT_EQ(limits.size(), 2U);
        EXPECT_EQ(limits.lows(), (std::vector<double>{2, 4}));
        EXPECT_EQ(limits.highs(), (std::vector<double>{2, last}));
    }
}

// Zeros of two signs are equal, but not the same bits.
TEST(LimitColumns, TellZerosApart) {
    LimitColumns<float> limits;
    limits.append(1, -0.0F, 0.0F);
    EXPECT_TRUE(std::signbit(limits.low(0)));
    EXPECT_FALSE(std::signbit(limits.high(0)));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
