#include "tests/prefab/make.h"
#include "tests/stepped.h"

#include <gtest/gtest.h>

/// What grows in gardens: trees and the webs between them.
namespace sinew::SINEW_TEST_FILE {
namespace {

TEST(Tree, ForksAsOftenAsItsDepthSays) {
    for (int depth = 0; depth <= 6; ++depth) {
        const auto made = make(Tree{.depth = depth});
        const std::size_t branches = (2U << unsigned(depth)) - 1;
        EXPECT_EQ(made.particles(), branches + 2);
        EXPECT_EQ(made.constraints(), 2 * branches + 1) << "a link and an angle each, and the stump";
    }
}

TEST(Tree, HasTheOriginalsLengthsAndAngles) {
    const auto made = make(Tree{.depth = 2, .branch = 70, .shrink = 0.95, .spread = pi<double> / 6}, Mode::classic);
    EXPECT_NEAR(made.position("particle_0")[1], 70 * 0.95, 1e-12);
    EXPECT_NEAR(made.constraint("branch_1").measure, 70 * 0.95 * 0.95, 1e-12);
    EXPECT_NEAR(made.constraint("branch_2").measure, 70 * 0.95 * 0.95 * 0.95 * 0.95, 1e-12);
    EXPECT_NEAR(made.constraint("joint_0").measure, 0, 1e-12);
    EXPECT_NEAR(made.constraint("joint_1").measure, pi<double> / 6, 1e-12) << "to the left first";
}

/// A trunk that grows sideways hangs where its weight and its stiffness agree:  E I angle / L = m g L cos(angle).
TEST(Tree, BendsAsStiffAsItSays) {
    const Tree trunk{.depth = 0, .branch = 1, .shrink = 1, .bend_stiffness = 200, .mass = 10};
    auto made = make<2, double>(trunk, Mode::physical, {.at = {}, .turn = -pi<double> / 2, .up = 1});
    made.world.forces = {Gravity<2, double>{{{0, -10}}}};
    made.world.settings.damping = 5;
    for (int i = 0; i < 600; ++i) step(made.world, 1.0 / 60);
    const double angle = std::abs(made.constraint("joint_0").measure), mass = made.mass("particle_0");
    EXPECT_GT(angle, 0.3);
    EXPECT_NEAR(200 * angle, mass * 10 * std::cos(angle), 0.01);
}

TEST(Spiderweb, IsASpiralWithTheOriginalsTies) {
    const auto made = make(Spiderweb{.spokes = 20, .rings = 7});
    EXPECT_EQ(made.particles(), 140U);
    EXPECT_EQ(made.constraints(), 139U + 1 + 138);
    EXPECT_EQ(made.world.pins.size(), 5U);
    EXPECT_TRUE(find_constraint(made.world, "it/spoke_137"));
    EXPECT_LT(norm(made.position("center")), 0.1 * norm(made.position("particle_0")));
}

TEST(Spiderweb, ComesToRestWithEveryThreadTaut) {
    auto made = make(Spiderweb{});
    made.world.settings.damping = 2;
    for (int i = 0; i < 600; ++i) step(made.world, 1.0 / 60);
    const auto& ties = std::get<kind_number<Distance, 2>>(made.world.constraints);
    for (Row row = 0; row < ties.size(); ++row) {
        const Row a = ties.members.rows[row][0], b = ties.members.rows[row][1];
        EXPECT_GT(distance(made.world.particles.position[a], made.world.particles.position[b]), ties.high(row));
    }
    for (const auto& speed : made.world.particles.velocity) EXPECT_LT(norm(speed), 0.01);
    EXPECT_LT(norm(made.position("center")), 0.2) << "the hub stays in the middle";
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
