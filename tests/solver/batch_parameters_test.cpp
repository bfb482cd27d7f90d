#include "sinew/solver/batch_parameters.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

template <class Real> DistanceColumns<2, Real> columns_of(const BatchParameters<Real>& parameters) {
    DistanceColumns<2, Real> columns{};
    parameters.show(columns);
    return columns;
}

TEST(BatchParameters, HoldOnceWhatIsTheSame) {
    BatchParameters<float> all;
    for (int i = 0; i < 4; ++i) all.add(float(i), float(i), 0);
    EXPECT_EQ(columns_of(all).high, columns_of(all).low);
    EXPECT_EQ(columns_of(all).compliance, nullptr);
    all.add(1, 2, 0);
    EXPECT_NE(columns_of(all).high, columns_of(all).low);
    EXPECT_EQ(columns_of(all).compliance, nullptr);
    all.add(3, 3, 0.5F);
    ASSERT_NE(columns_of(all).compliance, nullptr);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(all.are(i, float(i), float(i), 0));
    EXPECT_TRUE(all.are(4, 1, 2, 0));
    EXPECT_TRUE(all.are(5, 3, 3, 0.5F));
    EXPECT_FALSE(all.are(5, 3, 3, 0));
    EXPECT_FALSE(all.are(4, 1, 1, 0));
    EXPECT_EQ(all.size(), 6U);
}

TEST(BatchParameters, AreCopiedIntoAnyOther) {
    BatchParameters<double> from, to;
    from.add(1, 2, 0.25);
    from.add(4, 4, 0);
    to.add(7, 7, 0);
    for (std::size_t i = 0; i < 2; ++i) to.add_copy(from, i);
    EXPECT_TRUE(to.are(0, 7, 7, 0));
    EXPECT_TRUE(to.are(1, 1, 2, 0.25));
    EXPECT_TRUE(to.are(2, 4, 4, 0));
    to.prepare();
    EXPECT_EQ(columns_of(to).quarter_per_square[2], 0.25 / 16);
    to.resize(1);
    to.add(5, 6, 0);
    EXPECT_TRUE(to.are(1, 5, 6, 0));
}

TEST(BatchParameters, StayWhereRoomWasLeft) {
    BatchParameters<float> all;
    all.reserve(3);
    const auto reserved = columns_of(all);
    all.add(1, 1, 0);
    all.add(1, 2, 0);
    all.clear();
    all.add(1, 2, 1);
    EXPECT_EQ(columns_of(all).low, reserved.low);
    EXPECT_EQ(columns_of(all).high, reserved.high);
    EXPECT_EQ(columns_of(all).compliance, reserved.compliance);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
