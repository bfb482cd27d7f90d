#include "tests/prefab/make.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

/// Distance constraints as (first row, second row), in the order of the sweep.
template <int D, class Real> std::vector<std::pair<Row, Row>> threads(const World<D, Real>& world) {
    std::vector<std::pair<Row, Row>> pairs;
    for (const auto& [a, b] : std::get<kind_number<Distance, D>>(world.constraints).members.rows)
        pairs.emplace_back(a, b);
    return pairs;
}

TEST(Cloth, HangsFromTheMiddleOfItsTopRow) {
    const auto made = make(Cloth{.columns = 5, .rows = 4, .spacing = 0.5});
    EXPECT_EQ(made.particles(), 20U);
    EXPECT_EQ(made.position("top_left"), (Vec<2, double>{{-1, 0}}));
    EXPECT_EQ(made.position("top_right"), (Vec<2, double>{{1, 0}}));
    EXPECT_EQ(made.position("bottom_left"), (Vec<2, double>{{-1, -1.5}}));
    EXPECT_EQ(made.position("bottom_right"), (Vec<2, double>{{1, -1.5}}));
    EXPECT_EQ(made.position("particle_3_2"), (Vec<2, double>{{0.5, -1}}));
}

TEST(Cloth, LiesLevelInSpaceWithItsTopRowFurthestAway) {
    const auto made = make<3, double>(Cloth{.columns = 3, .rows = 3, .spacing = 1, .plane = "horizontal"});
    EXPECT_EQ(made.position("top_right"), (Vec<3, double>{{1, 0, 0}}));
    EXPECT_EQ(made.position("bottom_left"), (Vec<3, double>{{-1, 0, 2}}));
    EXPECT_TRUE(problem_of(Cloth{.plane = "horizontal"}, 2));
    EXPECT_FALSE(problem_of(Cloth{.plane = "horizontal"}, 3));
}

TEST(Cloth, IsWovenRowByRowAllAcrossThenAllDownThenEachDiagonalThenBends) {
    const auto made = make(Cloth{.columns = 3, .rows = 3, .bend = true});
    const std::vector<std::pair<Row, Row>> expected{
        {0, 1}, {1, 2}, {3, 4}, {4, 5}, {6, 7}, {7, 8}, // across
        {0, 3}, {1, 4}, {2, 5}, {3, 6}, {4, 7}, {5, 8}, // down
        {0, 4}, {1, 5}, {3, 7}, {4, 8},                 // falling
        {1, 3}, {2, 4}, {4, 6}, {5, 7},                 // rising
        {0, 2}, {3, 5}, {6, 8},                         // bent across
        {0, 6}, {1, 7}, {2, 8},                         // bent down
    };
    EXPECT_EQ(threads(made.world), expected);
}

TEST(Cloth, HasAsManyThreadsAsItsGridHasNeighbours) {
    const std::size_t c = 7, r = 5;
    const auto count = [&](std::string diagonals, bool bend) {
        return make(Cloth{.columns = int(c), .rows = int(r), .diagonals = std::move(diagonals), .bend = bend})
            .constraints();
    };
    const auto straight = (c - 1) * r + c * (r - 1), crossing = (c - 1) * (r - 1);
    EXPECT_EQ(count("none", false), straight);
    EXPECT_EQ(count("one", false), straight + crossing);
    EXPECT_EQ(count("both", false), straight + 2 * crossing);
    EXPECT_EQ(count("both", true), straight + 2 * crossing + (c - 2) * r + c * (r - 2));
}

TEST(Cloth, ThatBucklesLetsItsThreadsBecomeShorter) {
    const auto made = make(Cloth{.columns = 4, .rows = 3, .spacing = 1, .buckling = 0.25});
    const auto& all = std::get<kind_number<Distance, 2>>(made.world.constraints);
    for (Row row = 0; row < all.size(); ++row) {
        const bool side = all.high(row) == 1;
        EXPECT_EQ(all.low(row), side ? 0.75 : 0);
        EXPECT_TRUE(side || all.high(row) == std::sqrt(2.0));
    }
}

TEST(Cloth, NamesEachThreadByItsUpperLeftParticle) {
    const auto made = make(Cloth{.columns = 4, .rows = 3, .spacing = 1, .bend = true});
    EXPECT_EQ(made.constraint("across_2_1").measure, 1);
    EXPECT_EQ(made.constraint("down_3_1").measure, 1);
    EXPECT_NEAR(made.constraint("falling_2_1").measure, std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(made.constraint("rising_0_0").measure, std::sqrt(2.0), 1e-15);
    EXPECT_EQ(made.constraint("bend_across_1_2").measure, 2);
    EXPECT_EQ(made.constraint("bend_down_3_0").measure, 2);
    EXPECT_FALSE(find_constraint(made.world, "it/across_3_0"));
    EXPECT_FALSE(find_constraint(made.world, "it/down_0_2"));
}

TEST(Cloth, HasThreadsOfEachDirectionEquallyLongToTheLastBit) {
    const auto made =
        make<2, float>(Cloth{.columns = 30, .rows = 30, .spacing = 0.1}, Mode::physical, {.at = {{7, 3}}});
    const auto& rest = std::get<kind_number<Distance, 2>>(made.world.constraints).limits.lows();
    for (std::size_t i = 0; i < 2 * 29 * 30; ++i) ASSERT_EQ(rest[i], 0.1F);
}

TEST(Cloth, WeighsOnEachParticleTheClothAroundIt) {
    const auto made = make(Cloth{.columns = 3, .rows = 5, .mass = 8});
    EXPECT_NEAR(made.mass("particle_1_1"), 1, 1e-12);
    EXPECT_NEAR(made.mass("particle_0_1"), 0.5, 1e-12);
    EXPECT_NEAR(made.mass("bottom_right"), 0.25, 1e-12);
}

TEST(Cloth, IsHeldWhereOneAsks) {
    const auto held = [](const Cloth& cloth) {
        std::vector<std::string> names;
        const auto made = make(cloth);
        for (const auto& pin : made.world.pins)
            names.push_back(name_of(row_of(made.world, pin.particle).value(), made.figure().particle_numbers));
        return names;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(held({.columns = 3, .rows = 2}), (Names{"particle_0_0", "particle_1_0", "particle_2_0"}));
    EXPECT_EQ(held({.columns = 3, .rows = 2, .pins = "corners"}), (Names{"particle_0_0", "particle_2_0"}));
    EXPECT_EQ(held({.columns = 3, .rows = 2, .pins = "all_corners"}),
              (Names{"particle_0_0", "particle_2_0", "particle_0_1", "particle_2_1"}));
    EXPECT_EQ(held({.columns = 3, .rows = 2, .pins = "list", .pin_list = {1, 5}}),
              (Names{"particle_1_0", "particle_2_1"}));
    EXPECT_EQ(held({.pins = "none"}), Names{});
}

TEST(Cloth, RefusesPinsThatAreNotOfIt) {
    const auto problem = [](std::vector<double> list) {
        return problem_of(Cloth{.columns = 3, .rows = 2, .pins = "list", .pin_list = std::move(list)}, 2);
    };
    EXPECT_FALSE(problem({0, 5}));
    EXPECT_EQ(problem({0, 6}), "pin_list holds 6: this cloth's particles are counted from 0 to 5");
    EXPECT_TRUE(problem({1.5}));
    EXPECT_TRUE(problem({-1}));
    EXPECT_TRUE(problem({std::numeric_limits<double>::quiet_NaN()}));
    EXPECT_TRUE(problem_of(Cloth{.pin_list = {1}}, 2));
}

TEST(Cloth, KeepsNoNameForEachParticleOfALargeGrid) {
    const auto made = make<2, float>(Cloth{.columns = 300, .rows = 300});
    EXPECT_EQ(made.figure().particle_names.size(), 4U);
    EXPECT_TRUE(made.figure().constraint_names.empty());
    EXPECT_TRUE(find_particle(made.world, "it/particle_299_299"));
    EXPECT_EQ(made.figure().pieces.size(), 600U); // one line for each row and column
}

TEST(Curtain, AsItComesIsTheTutorialsAndHangsByItsTopRow) {
    const auto made = make(Curtain{});
    EXPECT_EQ(made.particles(), 61U * 41U);
    EXPECT_EQ(made.constraints(), 60U * 41U + 61U * 40U);
    EXPECT_EQ(made.world.pins.size(), 61U);
    EXPECT_EQ(made.constraint("down_0_0").measure, 0.06);
    EXPECT_EQ(made.figure().pieces.back().part, "knob");
}

TEST(Curtain, HangsByEverySoManiethHookAndByItsEnds) {
    const auto held = [](int columns, int hook_every) {
        std::vector<Row> rows;
        const auto made = make(Curtain{.columns = columns, .rows = 2, .hook_every = hook_every});
        for (const auto& pin : made.world.pins) rows.push_back(row_of(made.world, pin.particle).value());
        return rows;
    };
    EXPECT_EQ(held(8, 3), (std::vector<Row>{0, 3, 6, 7}));
    EXPECT_EQ(held(7, 3), (std::vector<Row>{0, 3, 6}));
    EXPECT_EQ(held(5, 1000000), (std::vector<Row>{0, 4}));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
