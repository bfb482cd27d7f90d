#include "sinew/prefab/prefabs.h"
#include "sinew/world/colliders.h"
#include "sinew/world/measure.h"

#include "tests/prefab/make.h"
#include "tests/worlds.h"

#include <algorithm>

/// Ropes that are pinned into the ground.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Buried : ::testing::Test {};
TYPED_TEST_SUITE(Buried, Everywhere, Names);

/// A rope from 0.6 m above a floor to a place below, with contact.
template <int D, class Real> void pin_into_ground(Stepped<D, Real>& world, double angle, double slack, bool exact) {
    fall(world, 9.81);
    world.bounds.push_back({Vec<D, Real>::axis(1)});
    Rope rope{.length = 1.5, .segments = 12, .angle = angle * pi<double> / 180, .slack = slack, .pinned = "both"};
    if (exact) rope.links = "exact";
    build(world, rope, "rope", Placement<D, Real>{.at = at<Vec<D, Real>>(0, 0.6)});
    set_contact(world, 0, {.figures = true});
}

// Lengths right to 1e-6 leave a taut rope a thousandth of its length across.
TYPED_TEST(Buried, ATautRopeRests) {
    const double slow = sizeof(typename TypeParam::Real) == sizeof(float) ? 0.8 : 0.02; // m/s
    for (const double angle : {20.0, 45.0, 60.0})
        for (const bool exact : {false, true}) {
            Stepped<TypeParam::dimension, typename TypeParam::Real> world;
            pin_into_ground(world, angle, 0, exact);
            double fastest = 0;
            for (int i = 0; i < 240; ++i) {
                step(world, typename TypeParam::Real(1) / 60);
                if (i >= 60) fastest = std::max(fastest, max_speed(world));
            }
            EXPECT_LT(fastest, slow) << "at " << angle << " degrees" << (exact ? ", of rods" : "");
        }
}

TYPED_TEST(Buried, ASlackRopeComesOut) {
    Stepped<TypeParam::dimension, typename TypeParam::Real> world;
    pin_into_ground(world, 45, 0.3, false);
    run(world, 4.0);
    int below = 0;
    for (Row row = 0; row < world.particles.size(); ++row) below += world.particles.position[row][1] < -0.01;
    EXPECT_LE(below, 3) << "its end, and two more that cannot reach the surface";
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
