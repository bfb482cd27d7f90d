#include "tests/prefab/make.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

TEST(Rope, HangsFromItsStartStraightDown) {
    const auto made = make(Rope{.length = 3, .segments = 6});
    EXPECT_EQ(made.particles(), 7U);
    EXPECT_EQ(made.constraints(), 6U);
    EXPECT_EQ(made.position("start"), made.position("particle_0"));
    EXPECT_EQ(made.position("end"), made.position("particle_6"));
    EXPECT_EQ(made.position("particle_2")[0], 0);
    EXPECT_NEAR(made.position("particle_2")[1], -1, 1e-15);
    EXPECT_NEAR(made.position("end")[1], -3, 1e-15);
}

TEST(Rope, LiesLevelToTheRightAtAQuarterTurn) {
    const auto made = make<3, double>(Rope{.length = 3, .angle = pi<double> / 2});
    EXPECT_NEAR(distance(made.position("end"), Vec<3, double>{{3, 0, 0}}), 0, 1e-14);
}

TEST(Rope, WithSlackHangsThroughBetweenEndsThatAreCloser) {
    for (const double slack : {1e-6, 0.01, 0.5, 3.0, 100.0}) {
        const auto made = make(Rope{.length = 2, .segments = 24, .angle = pi<double> / 2, .slack = slack});
        const auto end = made.position("end"), middle = made.position("particle_12");
        EXPECT_NEAR(end[0] * (1 + slack), 2, 1e-9) << slack;
        EXPECT_NEAR(end[1], 0, 1e-12);
        EXPECT_LT(middle[1], 0);
        EXPECT_NEAR(middle[0], end[0] / 2, 1e-12);
        EXPECT_NEAR(made.constraint("link_5").measure, 2.0 / 24, 1e-12);
    }
}

TEST(Rope, OfOneSegmentRefusesSlack) {
    EXPECT_TRUE(problem_of(Rope{.segments = 1, .slack = 0.1}, 2));
    EXPECT_FALSE(problem_of(Rope{.segments = 2, .slack = 0.1}, 2));
}

TEST(Rope, WeighsHalfAPieceAtItsEndsSoThatEachLinkCarriesWhatHangsBelow) {
    const auto made = make(Rope{.segments = 4, .mass = 8, .weight = 5});
    EXPECT_NEAR(made.mass("start"), 1, 1e-12);
    EXPECT_NEAR(made.mass("particle_2"), 2, 1e-12);
    EXPECT_NEAR(made.mass("end"), 1 + 5, 1e-12);
}

TEST(Rope, IsHeldAtTheEndsOneAsksFor) {
    EXPECT_EQ(make(Rope{.pinned = "none"}).world.pins.size(), 0U);
    EXPECT_EQ(make(Rope{.pinned = "both"}).world.pins.size(), 2U);
    const auto made = make(Rope{.pinned = "end"});
    ASSERT_EQ(made.world.pins.size(), 1U);
    EXPECT_EQ(made.world.pins[0].particle, find_particle(made.world, "it/end"));
}

TEST(Rope, CanGoSlackUnlessItsLinksAreExact) {
    const auto limits = [](const Rope& rope) {
        const auto made = make(rope);
        const auto& links = std::get<kind_number<Distance, 2>>(made.world.constraints);
        return std::pair(links.low(0), links.high(0));
    };
    EXPECT_EQ(limits({.length = 2, .segments = 4, .links = "exact"}), std::pair(0.5, 0.5));
    const auto [low, high] = limits({.length = 2, .segments = 4});
    EXPECT_LT(low, 0);
    EXPECT_EQ(high, 0.5);
}

TEST(Rope, ResistsBendingAlikeHoweverFinelyItIsDivided) {
    // n joints in a row give way n times as much as one: what matters is their sum, length / (E I).
    for (const int segments : {10, 100}) {
        const auto made = make(Rope{.length = 2, .segments = segments, .bend_stiffness = 4});
        const auto& bends = std::get<kind_number<Angle, 2>>(made.world.constraints);
        EXPECT_EQ(bends.size(), std::size_t(segments) - 1);
        EXPECT_NEAR(bends.compliance[0] * segments, 2.0 / 4, 1e-12);
        EXPECT_TRUE(find_constraint(made.world, "it/bend_0"));
    }
}

TEST(Chain, HasLinksOfALoopAndAGap) {
    const auto made = make(Chain{.links = 30}, Mode::classic);
    EXPECT_EQ(made.particles(), 31U);
    EXPECT_EQ(made.constraints(), 30U);
    EXPECT_NEAR(made.constraint("link_7").measure, 0.26, 1e-12);
    EXPECT_NEAR(made.position("end")[1], -30 * 0.26, 1e-12);
    EXPECT_EQ(made.figure().pieces.size(), 31U + 30) << "loops and what is between them";
}

TEST(Chain, GivesAllTheCorrectionToTheLowerLoopInClassicModeOnly) {
    const auto split = [](Mode mode) {
        const auto made = make(Chain{}, mode);
        return std::get<kind_number<Distance, 2>>(made.world.constraints).split[3];
    };
    EXPECT_EQ(split(Mode::classic), 0); // the share of the first member, the upper loop
    EXPECT_EQ(split(Mode::physical), 0.5);
}

TEST(Chain, HasBendLimitsWhenAskedInPhysicalMode) {
    const Chain chain{.links = 10, .bend_limit = 1};
    const auto made = make(chain);
    const auto& bends = std::get<kind_number<Angle, 2>>(made.world.constraints);
    ASSERT_EQ(bends.size(), 9U);
    EXPECT_EQ(bends.low(4), -1);
    EXPECT_EQ(bends.high(4), 1);
    EXPECT_EQ(make(chain, Mode::classic).constraints(), 10U);
    EXPECT_EQ(make(Chain{.links = 10}).constraints(), 10U);
}

TEST(Chain, RefusesMoreSlackThanItsBendLimitAllows) {
    EXPECT_FALSE(problem_of(Chain{.links = 20, .slack = 1, .bend_limit = 0.5}, 2));
    EXPECT_EQ(problem_of(Chain{.links = 4, .slack = 1, .bend_limit = 0.5}, 2),
              "with this slack the links turn by 56 degrees, and bend_limit is 29: less slack, a higher limit or more "
              "links");
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
