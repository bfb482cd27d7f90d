#include "sinew/math/trig.h"

#include <bit>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>

namespace sinew::SINEW_TEST_FILE {
namespace {

constexpr long double half_pi = 1.570796326794896619231321691639751442L;
constexpr double ulp_of_one = 0x1p-52;

/// Calls check(x) for many x: evenly spread over [-range, range], near multiples of a quarter turn, and tiny.
template <class Check> void for_many(double range, Check&& check) {
    std::mt19937_64 draw(7);
    std::uniform_real_distribution<double> even(-range, range), exponent(-300, 0);
    for (int i = 0; i < 50000; ++i) check(even(draw));
    for (int i = 0; i < 5000; ++i) check(std::exp2(exponent(draw)));
    for (int k = -1000; k <= 1000; ++k) {
        const double near = double(half_pi * k);
        for (const double x : {near, std::nextafter(near, 1e9), std::nextafter(near, -1e9)})
            if (std::abs(x) <= range) check(x);
    }
}

double error_of(double ours, long double truth) {
    return double(std::abs((long double)(ours)-truth));
}

double distance_in_ulps(double ours, long double truth) {
    const double nearest = double(truth);
    const double ulp = std::abs(std::nextafter(nearest, INFINITY) - nearest);
    return error_of(ours, truth) / ulp;
}

// Absolute, because next to a zero of the sine no relative bound can hold: the argument itself is rounded there.
TEST(Trig, SineAndCosineAreWithinOneUnitOfTheLastPlaceOfOneUpToAHundredThousandRadians) {
    for_many(1e5, [](double x) {
        ASSERT_LE(error_of(sine(x), sinl(x)), ulp_of_one) << x;
        ASSERT_LE(error_of(cosine(x), cosl(x)), ulp_of_one) << x;
    });
}

TEST(Trig, SineOfASmallAngleIsRightRelativeToItsSize) {
    for_many(0.75, [](double x) { ASSERT_LE(distance_in_ulps(sine(x), sinl(x)), 2) << x; });
}

TEST(Trig, FloatSineAndCosineAreTheDoubleOnesRounded) {
    for_many(1e5, [](double x) {
        const float narrow = float(x);
        ASSERT_EQ(sine(narrow), float(sine(double(narrow))));
        ASSERT_EQ(cosine(narrow), float(cosine(double(narrow))));
    });
}

TEST(Trig, SineAndCosineStayInRangeAndFiniteForEveryArgument) {
    for (const double x : {0.0, -0.0, 1e9, 1e15, 1e300, -1e300, double(INFINITY), -double(INFINITY), double(NAN)}) {
        EXPECT_LE(std::abs(sine(x)), 1 + ulp_of_one) << x;
        EXPECT_LE(std::abs(cosine(x)), 1 + ulp_of_one) << x;
        EXPECT_LE(std::abs(sine(float(x))), 1.0F) << x;
    }
}

TEST(Trig, ArctangentIsWithinSixUnitsOfTheLastPlaceInEveryDirection) {
    std::mt19937_64 draw(7);
    std::uniform_real_distribution<double> even(-1, 1), exponent(-100, 100);
    for (int i = 0; i < 100000; ++i) {
        const double y = even(draw) * std::exp2(exponent(draw)), x = even(draw) * std::exp2(exponent(draw));
        ASSERT_LE(distance_in_ulps(arctangent(y, x), atan2l(y, x)), 6) << y << ' ' << x;
        // two units of rounding in each of the four operations that lead there
        ASSERT_NEAR(arctangent(float(y), float(x)), float(atan2l(float(y), float(x))), 8e-7) << y << ' ' << x;
    }
}

TEST(Trig, ArctangentKnowsTheAxes) {
    EXPECT_EQ(arctangent(0.0, 0.0), 0.0);
    EXPECT_EQ(arctangent(0.0, 1.0), 0.0);
    EXPECT_EQ(arctangent(1.0, 0.0), pi<double> / 2);
    EXPECT_EQ(arctangent(0.0, -1.0), pi<double>);
    EXPECT_EQ(arctangent(-0.0, -1.0), pi<double>) << "the half-open interval has no -pi";
    EXPECT_EQ(arctangent(-1.0, 0.0), -pi<double> / 2);
}

TEST(Trig, ExponentialIsWithinTwoUnitsOfTheLastPlace) {
    for_many(700, [](double x) { ASSERT_LE(distance_in_ulps(exponential(x), expl(x)), 2) << x; });
    for (float x = -80; x < 80; x += 0.0371F)
        ASSERT_NEAR(exponential(x) / float(expl((long double)(x))), 1, 4 * 0x1p-23) << x;
}

TEST(Trig, ExponentialStaysFiniteAndNotNegativeForEveryArgument) {
    for (const double x : {1e3, 1e300, double(INFINITY), -1e3, -double(INFINITY), double(NAN)}) {
        EXPECT_TRUE(std::isfinite(exponential(x)) && exponential(x) >= 0) << x;
        EXPECT_TRUE(std::isfinite(exponential(float(x))) && exponential(float(x)) >= 0) << x;
    }
    EXPECT_EQ(exponential(0.0), 1.0);
}

struct Bits {
    double x;
    std::uint64_t sine, cosine, arctangent, exponential;
};

// Another compiler, flag or processor that rounds one operation differently shows up here before it parts two worlds.
TEST(Trig, GivesTheSameBitsEverywhere) {
    const Bits table[] = {
        {0.1, 0x3fb98eaecb8bcb2cU, 0x3fefd712f9a817c0U, 0x3fc229aec47638dcU, 0x3ff1aec7b35a00d4U},
        {-0.5, 0xbfdeaee8744b05f0U, 0x3fec1528065b7d50U, 0xbfe3d91573350662U, 0x3fe368b2fc6f960aU},
        {1, 0x3feaed548f090ceeU, 0x3fe14a280fb5068cU, 0x3feeb8e57b0c8583U, 0x4005bf0a8b14576aU},
        {-2.5, 0xbfe326af0dcfcab0U, 0xbfe9a2f7ef858b7dU, 0xbff4c3bcf48faef4U, 0x3fb50385c094f425U},
        {7.25, 0x3fea56adb62a27b8U, 0x3fe22c6f50dc3fbfU, 0x3ff797ba5c47edf2U, 0x4096006b5d53e8d9U},
        {30, 0xbfef9df47f1c903dU, 0x3fc3be82f2505a52U, 0x3ff8c26cfea14562U, 0x42a370470aec28ecU},
        {-123.456, 0x3fe9b9dadc41aeb6U, 0xbfe307e5980a1559U, 0xbff90ac1edccde0dU, 0x34cda9fb9e4ee720U},
        {700, 0x3fe16834defaadb0U, 0xbfead9f150b2e096U, 0x3ff91de2c0e658bcU, 0x7f0d945df4f8ec8eU},
        {-700, 0xbfe16834defaadb0U, 0xbfead9f150b2e096U, 0xbff91de2c0e658bcU, 0x00d14f2b0fb9307fU},
    };
    for (const auto& row : table) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(sine(row.x)), row.sine) << row.x;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(cosine(row.x)), row.cosine) << row.x;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(arctangent(row.x, 0.7)), row.arctangent) << row.x;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(exponential(row.x)), row.exponential) << row.x;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
