#include "bench/cases.h"
#include "bench/measure.h"
#include "bench/textbook.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

/// What everything is compared with has to be right itself.
namespace sinew::bench::SINEW_TEST_FILE {
namespace {

Work two_points(float apart, float rest) {
    return {.positions = {{{0, 0, 0}}, {{apart, 0, 0}}},
            .velocities = {{{}}, {{0, 3, 0}}},
            .inverse_masses = {1, 0.5F},
            .sticks = {{0, 1, rest}},
            .struts = {},
            .gravity = {{0, 0, -6}}};
}

TEST(Textbook, MovesAndSharesACorrectionByInverseMasses) {
    Textbook textbook(two_points(3, 3), {.substeps = 1, .iterations = 1});
    textbook.step();
    // By hand: both fall by 6/3600; the second moves on by 3/60; the stick is then sqrt(3^2 + 0.05^2) long, and what it
    // is too long is taken off by two thirds at the lighter end.
    const double fallen = -6.0 / 3600, length = std::sqrt(9 + 0.05 * 0.05), s = (length - 3) / (length * 1.5);
    EXPECT_NEAR(textbook.position(0)[0], 3 * s, 1e-6);
    EXPECT_NEAR(textbook.position(0)[1], 0.05 * s, 1e-6);
    EXPECT_NEAR(textbook.position(0)[2], fallen, 1e-6);
    EXPECT_NEAR(textbook.position(1)[0], 3 - 3 * s / 2, 1e-6);
    EXPECT_NEAR(textbook.position(1)[1], 0.05 - 0.05 * s / 2, 1e-6);
    EXPECT_NEAR(textbook.position(1)[2], fallen, 1e-6);
    textbook.step(); // Verlet: as far again as last time, and twice the fall
    EXPECT_NEAR(textbook.position(1)[2], 3 * fallen, 1e-6);
}

TEST(Textbook, SweepsOneAfterTheOtherAndAllOfTheIterations) {
    Work work{.positions = {{{0, 0, 0}}, {{2, 0, 0}}, {{3, 0, 0}}},
              .velocities = {3, Position{}},
              .inverse_masses = {0, 1, 1},
              .sticks = {{0, 1, 1}, {1, 2, 1}},
              .struts = {},
              .gravity = {}};
    Textbook once(work, {.substeps = 1, .iterations = 1});
    once.step();
    EXPECT_NEAR(once.position(1)[0], 1.5, 1e-6); // to 1 at the wall, then half of what the second lacks back
    EXPECT_NEAR(once.position(2)[0], 2.5, 1e-6);
    Textbook twice(work, {.substeps = 1, .iterations = 2});
    twice.step();
    EXPECT_NEAR(twice.position(1)[0], 1.25, 1e-6);
    EXPECT_NEAR(twice.position(2)[0], 2.25, 1e-6);
    EXPECT_EQ(once.position(0), (Found{}));
}

TEST(Textbook, KeepsStrutsFromFoldingAndLetsThemStretch) {
    Work work{.positions = {{{0, 0, 0}}, {{1, 0, 0}}, {{5, 0, 0}}, {{9, 0, 0}}},
              .velocities = {4, Position{}},
              .inverse_masses = {1, 1, 1, 1},
              .sticks = {},
              .struts = {{0, 1, 2}, {2, 3, 2}},
              .gravity = {}};
    Textbook textbook(work, {.substeps = 1, .iterations = 1});
    textbook.step();
    EXPECT_NEAR(textbook.position(0)[0], -0.5, 1e-6);
    EXPECT_NEAR(textbook.position(1)[0], 1.5, 1e-6);
    EXPECT_EQ(textbook.position(3)[0], 9);
}

TEST(Textbook, InEitherOrderComesToTheSameRest) {
    const auto work = work_of(*find_case("cloth-5"));
    Textbook listed(work, {.substeps = 2, .iterations = 200});
    Textbook shuffled(work, {.substeps = 2, .iterations = 200}, Textbook::Order::shuffled);
    listed.step(), shuffled.step();
    for (std::size_t i = 0; i < work.positions.size(); ++i)
        EXPECT_LT(distance(listed.position(i), shuffled.position(i)), 1e-3);
}

TEST(Strain, IsTheWorstAndTheMeanOfAllSticks) {
    const Work work{
        .positions = {}, .velocities = {}, .inverse_masses = {}, .sticks = {{0, 1, 1}, {1, 2, 2}}, .struts = {}};
    const std::vector<Found> positions{{{0, 0, 0}}, {{1.5, 0, 0}}, {{1.5, 1.5, 0}}};
    EXPECT_NEAR(strain_of(work, positions).max, 0.5, 1e-6);
    EXPECT_EQ(strain_of(work, positions).last, strain_of(work, positions).max);
    EXPECT_NEAR(strain_of(work, positions).mean, 0.375, 1e-6);
    const double lost = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(strain_of(work, std::vector<Found>{{{lost, 0, 0}}, positions[1], positions[2]}).max));
    EXPECT_TRUE(std::isnan(strain_of(work, std::vector<Found>{positions[0], positions[1], {{0, lost, 0}}}).mean));
}

} // namespace
} // namespace sinew::bench::SINEW_TEST_FILE
