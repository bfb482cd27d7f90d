#include "sinew/picture/spine.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

/// Limbs and ropes as bands along curves.
namespace sinew::SINEW_TEST_FILE {
namespace {

using Points = std::vector<Vec2<float>>;

Spine laid_out(const Points& limb, std::size_t parts) {
    Bends bends;
    limb_along(limb, bends);
    Spine spine;
    lay_out(bends, parts, 1e6F, spine);
    return spine;
}

TEST(Spine, ALimbOfThreeIsTheQuadraticBezierCurve) {
    const QuadraticBezier<2, float> curve{{{0, 0}}, {{80, 10}}, {{90, 120}}};
    const auto spine = laid_out({curve.a, curve.b, curve.c}, 40);
    EXPECT_NEAR(spine.length, arc_length(curve), 0.002F * spine.length); // chords are shorter than arcs
    for (const auto& position : spine.position) {
        float nearest = 1e9F;
        for (int i = 0; i <= 2000; ++i) nearest = std::min(nearest, distance(position, curve.at(float(i) / 2000)));
        EXPECT_LT(nearest, 0.1F);
    }
}

// However unevenly t runs along the curve: an image is neither stretched nor squeezed.
TEST(Spine, StepsAreEquallyLongAlongTheWay) {
    const auto spine = laid_out({{{0, 0}}, {{5, 0}}, {{200, 40}}}, 50);
    ASSERT_EQ(spine.size(), 51U);
    for (std::size_t i = 0; i + 1 < spine.size(); ++i)
        EXPECT_NEAR(distance(spine.position[i], spine.position[i + 1]), spine.length / 50, 0.02F * spine.length / 50);
}

TEST(Spine, TheWayIsTheTangentAlsoWhereAHandleHasNoLength) {
    const auto bent = laid_out({{{0, 0}}, {{100, 0}}, {{100, 100}}}, 20);
    EXPECT_NEAR(distance(bent.along.front(), Vec2<float>{{1, 0}}), 0, 1e-3);
    EXPECT_NEAR(distance(bent.along.back(), Vec2<float>{{0, 1}}), 0, 1e-3);
    const auto folded = laid_out({{{0, 0}}, {{0, 0}}, {{0, 50}}}, 20); // the elbow is at the shoulder
    for (const auto& along : folded.along) EXPECT_NEAR(distance(along, Vec2<float>{{0, 1}}), 0, 1e-3);
}

TEST(Spine, WithoutLengthItIsStillFinite) {
    for (const std::size_t count : {1U, 2U, 3U, 4U, 7U}) {
        const auto spine = laid_out(Points(count, {{3, 4}}), 8);
        for (const auto& position : spine.position) EXPECT_TRUE(is_finite(position));
        for (const auto& along : spine.along) EXPECT_TRUE(is_finite(along));
    }
    const auto beyond = laid_out({{{-3e38F, 0}}, {{0, 0}}, {{3e38F, 3e38F}}}, 8);
    EXPECT_EQ(beyond.size(), 0U);
}

TEST(Spine, ARopeRunsThroughItsPoints) {
    const Points points = {{{0, 0}}, {{30, 10}}, {{60, -5}}, {{90, 20}}};
    Bends bends;
    rope_through(points, bends);
    ASSERT_EQ(bends.size(), 3U);
    for (std::size_t i = 0; i < bends.size(); ++i) {
        EXPECT_EQ(bends[i].a, points[i]);
        EXPECT_EQ(bends[i].d, points[i + 1]);
        if (i > 0) { // no kink: it leaves a point as it came
            EXPECT_NEAR(distance(direction(bends[i].derivative(0)), direction(bends[i - 1].derivative(1))), 0, 1e-5);
        }
    }
}

/// Twice the signed area of the four corners of a part of a band.
float turn_of(const Pixels& sides, std::size_t i) {
    const auto &a = sides[2 * i], &b = sides[2 * i + 1], &c = sides[2 * i + 3], &d = sides[2 * i + 2];
    return cross(c - a, d - b);
}

TEST(Tile, SidesAreHalfAWidthFromTheMiddle) {
    const auto spine = laid_out({{{0, 0}}, {{50, 0}}, {{100, 30}}}, 20);
    Pixels sides;
    sides_of(
        spine, [](float share) { return 10 + 10 * share; }, sides);
    for (std::size_t i = 0; i < spine.size(); ++i) {
        EXPECT_NEAR(distance(sides[2 * i], sides[2 * i + 1]), 10 + 10 * spine.share(i), 1e-3);
        EXPECT_NEAR(distance((sides[2 * i] + sides[2 * i + 1]) * 0.5F, spine.position[i]), 0, 1e-3);
    }
}

// The saw teeth of a naive band: its inner side runs backwards where the bend is tighter than half its width.
TEST(Tile, NoPartIsTurnedOverInATightBend) {
    for (const float x : {5.0F, 20.0F, 60.0F, 100.0F}) {
        const auto spine = laid_out({{{0, 0}}, {{100, 0}}, {{x, 12}}}, 64);
        Pixels sides;
        sides_of(
            spine, [](float) { return 24.0F; }, sides);
        const float first = turn_of(sides, 0);
        for (std::size_t i = 0; i + 1 < spine.size(); ++i)
            EXPECT_GE(turn_of(sides, i) * first, -1e-2F) << x << ' ' << i;
    }
}

TEST(Tile, AProfileSaysHowThickItIsAlongItsWay) {
    const std::vector<double> profile = {1, 0.5, 2};
    EXPECT_EQ(thickness_at({}, 0.3F), 1);
    EXPECT_EQ(thickness_at(profile, 0), 1);
    EXPECT_EQ(thickness_at(profile, 0.25F), 0.75F);
    EXPECT_EQ(thickness_at(profile, 0.5F), 0.5F);
    EXPECT_EQ(thickness_at(profile, 0.75F), 1.25F);
    EXPECT_EQ(thickness_at(profile, 1), 2);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
