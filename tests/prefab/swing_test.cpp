#include "tests/prefab/make.h"
#include "tests/stepped.h"

#include <cmath>

namespace sinew::SINEW_TEST_FILE {
namespace {

/// A swing whose seat stays level is a pendulum as long as its ropes: T = 2 pi sqrt(l/g) (1 + theta^2/16). Ropes that
/// weigh a millionth of the rest do not slow it.
TEST(Swing, SwingsAsAPendulumAsLongAsItsRopes) {
    constexpr double length = 1.8, aside = 0.1;
    auto made = make(Swing{.length = length, .angle = aside, .mass = 2e-6, .weight = 30});
    made.world.forces.push_back(Gravity<2, double>{{{0, -gravity}}});
    const double period = 2 * pi<double> * std::sqrt(length / gravity) * (1 + aside * aside / 16);
    const double middle = 0.3; // of seat_right
    double before = 0, crossed = 0;
    int crossings = 0;
    for (int frame = 1; frame <= 10 * int(fps); ++frame) {
        step(made.world, 1 / fps);
        const double x = made.position("seat_right")[0] - middle;
        EXPECT_NEAR(made.position("seat_right")[1], made.position("seat_left")[1], 1e-6);
        if (frame > 1 && (x < 0) != (before < 0)) {
            crossed = (frame - x / (x - before)) / fps;
            ++crossings;
        }
        before = x;
    }
    ASSERT_GE(crossings, 6);
    EXPECT_NEAR(crossed / (crossings - 0.5), period / 2, 1e-3 * period);
}

TEST(Swing, CarriesHalfOfItsSeatOnEachRope) {
    auto made = make(Swing{.segments = 4, .mass = 4, .weight = 30});
    made.world.forces.push_back(Gravity<2, double>{{{0, -gravity}}});
    for (int frame = 0; frame < 60; ++frame) step(made.world, 1 / fps);
    for (const auto* lowest : {"left_link_3", "right_link_3"})
        EXPECT_NEAR(made.constraint(lowest).tension, (16 + 0.125) * gravity, 1e-3 * gravity);
}

/// Pieces of a fifth of a millimetre, two metres from the origin: a float tells their ends apart to a part in a
/// thousand, too coarse for a rope to hang by. What rounding takes is kept, so that it swings as in double.
TEST(Swing, OfTenThousandPiecesSwingsInFloatToo) {
    auto made = make<2, float>(Swing{.segments = 10000, .angle = 0.7});
    made.world.forces.push_back(Gravity<2, float>{{{0, float(-gravity)}}});
    const auto before = made.position("seat_left");
    for (int frame = 0; frame < 3; ++frame) step(made.world, float(1 / fps));
    const auto fallen = norm(made.position("seat_left") - before);
    EXPECT_NEAR(fallen, 0.5 * gravity * sine(0.7) * square(3 / fps), 0.05 * fallen);
}

/// Both banks together carry what hangs between them: upwards on the first joint pull the plank and the bank, and of
/// its weight the bank carries half a plank alone.
TEST(Bridge, HangsByItsWeightFromBothBanks) {
    for (const double rail : {0.0, 0.6}) {
        const Bridge bridge{.planks = 12, .rail = rail, .mass = 24};
        auto made = make(bridge);
        made.world.settings.damping = 2;
        made.world.forces.push_back(Gravity<2, double>{{{0, -gravity}}});
        for (int frame = 0; frame < 900; ++frame) step(made.world, 1 / fps);
        double carried = 0;
        const auto up = [&](const char* link, const Vec2<double>& from, const Vec2<double>& to) {
            const auto along = (from - to) * (1 / norm(from - to));
            carried += made.constraint(link).tension * along[1];
        };
        up("plank_0", made.position("left_bank"), made.position("joint_1"));
        up("plank_11", made.position("right_bank"), made.position("joint_11"));
        if (rail > 0) {
            up("rail_link_0", made.position("rail_0"), made.position("rail_1"));
            up("rail_link_11", made.position("rail_12"), made.position("rail_11"));
        }
        EXPECT_NEAR(carried, 24 * 11.0 / 12 * gravity, 1e-3 * 24 * gravity) << "rail " << rail;
        EXPECT_NEAR(made.position("joint_6")[0], 2, 1e-3) << "as far from both banks";
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
