#include "tests/prefab/make.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

TEST(Polygon, StandsOnASideAndCountsItsCornersCounterClockwise) {
    const auto made = make(Polygon{.sides = 4, .radius = std::sqrt(2.0)});
    const auto expect = [&](const char* name, double x, double y) {
        EXPECT_NEAR(made.position(name)[0], x, 1e-14) << name;
        EXPECT_NEAR(made.position(name)[1], y, 1e-14) << name;
    };
    expect("corner_0", 1, -1);
    expect("corner_1", 1, 1);
    expect("corner_2", -1, 1);
    expect("corner_3", -1, -1);
}

std::pair<std::size_t, std::size_t> counts(const Polygon& polygon) {
    const auto made = make(polygon);
    return {made.particles(), made.constraints()};
}

TEST(Polygon, IsBracedAsAsked) {
    using Counts = std::pair<std::size_t, std::size_t>;
    EXPECT_EQ(counts({.sides = 7, .braced = "none"}), Counts(7, 7));
    EXPECT_EQ(counts({.sides = 7, .braced = "spokes"}), Counts(8, 14));
    EXPECT_EQ(counts({.sides = 7, .braced = "braces"}), Counts(7, 14));
    EXPECT_EQ(counts({.sides = 7, .braced = "area"}), Counts(7, 8));
}

TEST(Polygon, NeverJoinsTwoCornersTwice) {
    for (int sides = 3; sides <= 12; ++sides)
        for (int span = 2; span <= std::max(2, sides - 2); ++span) {
            const Polygon polygon{.sides = sides, .brace_span = span};
            ASSERT_FALSE(problem_of(polygon, 2));
            const auto made = make(polygon);
            auto rods = std::get<kind_number<Distance, 2>>(made.world.constraints).members.rows;
            for (auto& rod : rods) std::sort(rod.begin(), rod.end());
            std::sort(rods.begin(), rods.end());
            EXPECT_EQ(std::adjacent_find(rods.begin(), rods.end()), rods.end()) << sides << " " << span;
        }
}

TEST(Polygon, RefusesBracesThatWouldBeEdges) {
    EXPECT_EQ(problem_of(Polygon{.sides = 6, .brace_span = 5}, 2),
              "brace_span is 5: in a polygon of 6 sides braces span 2 to 4");
    EXPECT_FALSE(problem_of(Polygon{.sides = 6, .braced = "spokes", .brace_span = 5}, 2));
}

TEST(Polygon, KeepsItsAreaInWorldsOfEitherUp) {
    const Polygon square{.sides = 4, .radius = std::sqrt(2.0), .braced = "area"};
    for (const int up : {-1, 1}) {
        const auto made = make<2, double>(square, Mode::physical, {.at = {}, .turn = 0, .up = up});
        EXPECT_NEAR(made.constraint("area").measure, 4 * up, 1e-12);
        EXPECT_NEAR(made.constraint("area").error, 0, 1e-12);
    }
}

TEST(Polygon, OfAHundredThousandSidesIsMadeInNoTime) {
    EXPECT_EQ(counts({.sides = 100'000, .braced = "area"}), std::pair(std::size_t(100'000), std::size_t(100'001)));
}

TEST(Box, HasTheOriginalsFourEdgesAndOneDiagonal) {
    const auto made = make<2, double>(Box{}, Mode::classic, {.at = {{3, 3}}, .turn = 0, .up = -1});
    EXPECT_EQ(made.position("top_left"), (Vec<2, double>{{2.75, 2.75}}));
    EXPECT_EQ(made.position("bottom_right"), (Vec<2, double>{{3.25, 3.25}}));
    const auto& rods = std::get<kind_number<Distance, 2>>(made.world.constraints);
    const std::vector<std::array<Row, 2>> expected{{3, 0}, {0, 1}, {1, 2}, {2, 3}, {0, 2}};
    EXPECT_EQ(rods.members.rows, expected);
    EXPECT_EQ(rods.low(0), 0.5);
    EXPECT_NEAR(rods.low(4), std::sqrt(0.5), 1e-15);
}

TEST(Box, HasAsManyDiagonalsAsAsked) {
    EXPECT_EQ(make(Box{.braces = "none"}).constraints(), 4U);
    EXPECT_EQ(make(Box{.braces = "one"}).constraints(), 5U);
    const auto made = make(Box{.width = 3, .height = 4, .braces = "both"});
    EXPECT_NEAR(made.constraint("diagonal").measure, 5, 1e-12);
    EXPECT_NEAR(made.constraint("other_diagonal").measure, 5, 1e-12);
}

TEST(StickFigure, DrawsItsSticksAndHidesItsSupports) {
    const auto made = make(StickFigure{});
    EXPECT_EQ(made.particles(), 11U);
    EXPECT_EQ(made.constraints(), 15U + 4) << "sticks and supports, elbows and knees";
    const auto& pieces = made.figure().pieces;
    EXPECT_EQ(std::count_if(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.part == "stick"; }),
              10);
    EXPECT_EQ(std::count_if(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.hidden; }), 5);
    for (const auto* name : {"head", "neck", "hips", "left_elbow", "left_hand", "left_knee", "left_foot", "right_elbow",
                             "right_hand", "right_knee", "right_foot"})
        EXPECT_TRUE(find_particle(made.world, "it/" + std::string(name))) << name;
}

TEST(StickFigure, IsAsTallAsItsHeightFromTheTopOfItsHeadToItsFeet) {
    const auto made = make(StickFigure{.height = 2});
    const auto& head = made.figure().pieces.back();
    EXPECT_NEAR(made.position("head")[1] + head.width / 2 - made.position("left_foot")[1], 2, 1e-12);
}

TEST(Tire, HasTreadBracesAndSpokesAsTheOriginals) {
    using Counts = std::pair<std::size_t, std::size_t>;
    const auto counts = [](int segments) {
        const auto made = make(Tire{.segments = segments});
        return Counts(made.particles(), made.constraints());
    };
    EXPECT_EQ(counts(30), Counts(31, 90));
    EXPECT_EQ(counts(7), Counts(8, 21));
    EXPECT_EQ(counts(10), Counts(11, 25)) << "opposite corners share a brace";
    for (const int few : {3, 4, 5, 6}) EXPECT_EQ(counts(few), Counts(few + 1, 2 * few)) << "a brace would be an edge";
}

TEST(Tire, HasItsRelaxationsInClassicModeOnly) {
    const Tire tire{.segments = 7, .spoke_relaxation = 0.025, .tread_relaxation = 0.05};
    const auto classic = make(tire, Mode::classic), physical = make(tire);
    const auto shares = std::get<kind_number<Distance, 2>>(classic.world.constraints).relaxation.rows();
    EXPECT_EQ(shares.front(), 0.05);
    EXPECT_EQ(shares.back(), 0.025);
    for (const auto share : std::get<kind_number<Distance, 2>>(physical.world.constraints).relaxation.rows())
        EXPECT_EQ(share, 1);
}

TEST(Limb, IsThreeParticlesDrawnAsOneBandWithATip) {
    const auto made = make(Limb{.upper = 3, .lower = 2, .angle = pi<double> / 2, .bend = -pi<double> / 2, .mass = 10});
    EXPECT_NEAR(norm(made.position("joint") - Vec<2, double>{{3, 0}}), 0, 1e-12);
    EXPECT_NEAR(norm(made.position("end") - Vec<2, double>{{3, -2}}), 0, 1e-12) << "bent clockwise, so down";
    EXPECT_NEAR(made.mass("root"), 3, 1e-12);
    EXPECT_NEAR(made.mass("end"), 2, 1e-12);
    ASSERT_EQ(made.figure().pieces.size(), 2U);
    EXPECT_EQ(made.figure().pieces[0].mark, Mark::tip);
    EXPECT_EQ(made.figure().pieces[1].mark, Mark::limb);
    EXPECT_EQ(made.constraints(), 3U);
    EXPECT_EQ(make(Limb{}, Mode::classic).constraints(), 2U) << "the original knows no limits";
}

TEST(Limb, IsRefusedWhereItsBendIsOutOfItsLimits) {
    EXPECT_EQ(problem_of(Limb{.bend = -pi<double> / 6, .bend_min = 0}, 2),
              "bend is -30 degrees, out of its limits 0 and 150");
}

TEST(Humanoid, HasTheOriginalsElevenLinksAndATrunkOfItsOwn) {
    const Humanoid man{.height = 216};
    const auto classic = make(man, Mode::classic), physical = make(man);
    EXPECT_EQ(classic.particles(), 14U);
    EXPECT_EQ(classic.constraints(), 11U);
    EXPECT_EQ(physical.constraints(), 19U);
    EXPECT_NEAR(classic.constraint("neck").measure, 24, 1e-12);
    for (const auto* bone : {"right_upper_arm", "right_forearm"})
        EXPECT_NEAR(classic.constraint(bone).measure, 40, 1e-12) << bone;
    for (const auto* bone : {"left_upper_arm", "left_forearm", "left_thigh", "left_shin", "right_thigh", "right_shin"})
        EXPECT_NEAR(classic.constraint(bone).measure, 64, 1e-12) << bone;
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
