#include "sinew/math/bezier.h"
#include "sinew/math/scalar.h"

#include <cmath>
#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

using V = Vec2<double>;
constexpr QuadraticBezier<2, double> arch{{{0, 0}}, {{1, 2}}, {{3, 0}}};
constexpr CubicBezier<2, double> wave{{{0, 0}}, {{1, 3}}, {{2, -3}}, {{4, 1}}};

void expect_near(const V& a, const V& b, double tolerance) {
    EXPECT_NEAR(distance(a, b), 0, tolerance);
}

TEST(Bezier, BeginsAndEndsAtItsEndsTowardsItsHandles) {
    expect_near(arch.at(0.0), arch.a, 0);
    expect_near(arch.at(1.0), arch.c, 0);
    expect_near(arch.derivative(0.0), 2.0 * (arch.b - arch.a), 1e-15);
    expect_near(arch.derivative(1.0), 2.0 * (arch.c - arch.b), 1e-15);
    expect_near(wave.at(0.0), wave.a, 0);
    expect_near(wave.at(1.0), wave.d, 0);
    expect_near(wave.derivative(0.0), 3.0 * (wave.b - wave.a), 1e-15);
    expect_near(wave.derivative(1.0), 3.0 * (wave.d - wave.c), 1e-15);
}

TEST(Bezier, DerivativeIsTheSlopeOfTheCurve) {
    constexpr double h = 1e-5; // a central difference is wrong by h^2 B'''/6 and rounding by 1e-16 / h
    for (const double t : {0.1, 0.37, 0.5, 0.93}) {
        expect_near((arch.at(t + h) - arch.at(t - h)) * (0.5 / h), arch.derivative(t), 1e-8);
        expect_near((wave.at(t + h) - wave.at(t - h)) * (0.5 / h), wave.derivative(t), 1e-8);
    }
}

TEST(Bezier, LengthOfAStraightCurveIsTheDistanceOfItsEnds) {
    const QuadraticBezier<2, double> line{{{1, 1}}, {{2.5, 3}}, {{4, 5}}};
    EXPECT_NEAR(arc_length(line), 5, 1e-14);
    EXPECT_NEAR(arc_length(line, 0.25), 1.25, 1e-14);
    EXPECT_EQ(arc_length(line, 0.0), 0);
}

// y = x^2 from 0 to 1: sqrt(5)/2 + asinh(2)/4.
TEST(Bezier, LengthOfAParabolaIsTheTextbooks) {
    const QuadraticBezier<2, double> parabola{{{0, 0}}, {{0.5, 0}}, {{1, 1}}};
    EXPECT_NEAR(arc_length(parabola), std::sqrt(5.0) / 2 + std::asinh(2.0) / 4, 1e-9);
}

TEST(Bezier, LengthIsThatOfManyChords) {
    constexpr int chords = 20000; // short of the arc by a fraction of 1 / chords^2
    double length = 0;
    for (int i = 0; i < chords; ++i) length += distance(wave.at(double(i) / chords), wave.at(double(i + 1) / chords));
    EXPECT_NEAR(arc_length(wave), length, 1e-6);
}

TEST(Bezier, IsTheSameCurveADegreeHigher) {
    const QuadraticBezier<2, double> low{{{0, 0}}, {{1, 3}}, {{4, 1}}};
    const auto high = elevated(low);
    for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        expect_near(high.at(t), low.at(t), 1e-14);
        expect_near(high.derivative(t), low.derivative(t), 1e-14);
    }
}

TEST(CatmullRom, RunsThroughItsPointsAndTurnsSmoothlyThere) {
    const V a{{0, 0}}, b{{1, 2}}, c{{3, 1}}, d{{4, 4}}, e{{6, 3}};
    const auto before = catmull_rom(a, b, c, d), after = catmull_rom(b, c, d, e);
    expect_near(before.at(0.0), b, 0);
    expect_near(before.at(1.0), c, 0);
    expect_near(before.derivative(1.0), after.derivative(0.0), 1e-14);
    expect_near(before.derivative(0.0), (c - a) * 0.5, 1e-14);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
