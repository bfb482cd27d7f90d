#include "sinew/math/vec.h"

#include <gtest/gtest.h>
#include <limits>

namespace sinew::SINEW_TEST_FILE {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Scalar, ClampedIsAlwaysInRangeEvenWhenNotANumber) {
    EXPECT_EQ(clamp(5.0, 0.0, 1.0), 1.0);
    EXPECT_EQ(clamp(-5.0, 0.0, 1.0), 0.0);
    EXPECT_EQ(clamp(0.5, 0.0, 1.0), 0.5);
    EXPECT_EQ(clamp(infinity, 0.0, 1.0), 1.0);
    EXPECT_EQ(clamp(nan, 0.0, 1.0), 0.0);
}

TEST(Scalar, InverseOrZeroNeverOverflows) {
    EXPECT_EQ(inverse_or_zero(4.0), 0.25);
    for (const double x : {0.0, -0.0, -1.0, 1e-310, nan, infinity}) EXPECT_EQ(inverse_or_zero(x), 0.0) << x;
    EXPECT_TRUE(is_finite(inverse_or_zero(std::numeric_limits<double>::min())));
    EXPECT_TRUE(is_finite(inverse_or_zero(std::numeric_limits<float>::min())));
}

TEST(Scalar, FiniteMeansNeitherInfiniteNorNotANumber) {
    EXPECT_TRUE(is_finite(0.0) && is_finite(-1e308));
    EXPECT_FALSE(is_finite(nan) || is_finite(infinity) || is_finite(-infinity));
}

TEST(Vec, CrossIsPositiveCounterClockwise) {
    EXPECT_EQ(cross(Vec2<double>{1, 0}, Vec2<double>{0, 1}), 1.0);
    EXPECT_EQ(perpendicular(Vec2<double>{1, 0}), (Vec2<double>{0, 1}));
    EXPECT_EQ(cross(Vec3<double>{1, 0, 0}, Vec3<double>{0, 1, 0}), (Vec3<double>{0, 0, 1}));
}

TEST(Vec, CrossStandsAtRightAnglesToBoth) {
    const Vec3<double> a{1, 2, -3}, b{-2, 5, 7};
    EXPECT_EQ(dot(cross(a, b), a), 0.0);
    EXPECT_EQ(dot(cross(a, b), b), 0.0);
}

TEST(Vec, DirectionHasLengthOneOrIsZero) {
    EXPECT_EQ(direction(Vec2<double>{3, 4}), (Vec2<double>{0.6000000000000001, 0.8}));
    EXPECT_EQ(direction(Vec3<float>{}), Vec3<float>{});
}

TEST(Vec, CalculatesByComponents) {
    const Vec3<double> a{1, 2, 3}, b{4, 5, 6};
    EXPECT_EQ(a + b, (Vec3<double>{5, 7, 9}));
    EXPECT_EQ(b - a, (Vec3<double>{3, 3, 3}));
    EXPECT_EQ(2.0 * -a, (Vec3<double>{-2, -4, -6}));
    EXPECT_EQ(dot(a, b), 32.0);
    EXPECT_EQ(norm(Vec2<double>{3, 4}), 5.0);
    EXPECT_EQ(distance(Vec2<double>{1, 1}, Vec2<double>{4, 5}), 5.0);
    EXPECT_EQ(clamp_components(b, 5.0), (Vec3<double>{4, 5, 5}));
    EXPECT_FALSE(is_finite(Vec3<double>{0, nan, 0}));
    EXPECT_EQ((Vec3<double>::axis(1)), (Vec3<double>{0, 1, 0}));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
