#include "sinew/prefab/prefabs.h"
#include "sinew/world/colliders.h"

#include "tests/dice.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

/// Blows on several points of a rigid body at once.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class World> struct FlatBlow : ::testing::Test {};
TYPED_TEST_SUITE(FlatBlow, Everywhere, Names);

/// A crate, or two one after the other, lands flat. Largest way aside of a corner, as a share of the size.
template <int D, class Real> double way_aside(std::uint64_t seed) {
    Dice dice(seed);
    Stepped<D, Real> world;
    world.settings.substeps = 2 << dice.below(5);
    fall(world, 9.81);
    const double size = dice.scale(0.1, 3), height = size * dice.scale(0.1, 10), friction = dice.between(0, 1);
    const int count = 1 + dice.below(2);
    world.bounds = {{at<Vec<D, Real>>(0, 1), 0, 0, Real(friction)}};
    std::vector<FigureIndex> crates;
    for (int i = 0; i < count; ++i) {
        Box box{.width = size,
                .height = size,
                .depth = size,
                .mass = dice.scale(0.1, 10),
                .thickness = 0,
                .dot = 0.04 * size};
        if (dice.below(2)) box.braces = "both";
        crates.push_back(build(world, box, "crate" + std::to_string(i),
                               {.at = at<Vec<D, Real>>(0, (i + 0.55) * size * 1.1 + (i + 1) * height)}));
        set_contact(world, crates.back(), {.figures = true, .friction = friction});
    }
    const auto places = [&] {
        std::vector<Vec<D, double>> all;
        for (const auto figure : crates)
            for (const auto id : world.figures[figure].particles) all.push_back(cast<double>(*position_of(world, id)));
        return all;
    };
    const auto before = places();
    double worst = 0;
    for (int i = 0; i < int(60 * (2 + 3 * std::sqrt(height))); ++i) {
        step(world, Real(1.0 / 60));
        const auto now = places();
        for (std::size_t k = 0; k < now.size(); ++k) worst = std::max(worst, std::abs(now[k][0] - before[k][0]) / size);
    }
    return worst;
}
/// From a tenth to ten times the size, with any friction, from 2 substeps on.
TYPED_TEST(FlatBlow, LeavesACrateWhereItFell) {
    for (int seed = 1; seed <= few_or_many(20, 1000); ++seed)
        EXPECT_LT((way_aside<TypeParam::dimension, typename TypeParam::Real>(std::uint64_t(seed))), 5e-3) << seed;
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
