#include "sinew/math/random.h"
#include "sinew/prefab/cloth.h"
#include "sinew/solver/measure.h"

#include "tests/thorough.h"
#include "tests/worlds.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sinew {
namespace {

using namespace test;

// Of rows between two pins, a way by way of the middle is hardly longer than straight on.
TEST(Tethers, KnowTheRowsThatSpanFromPinToPin) {
    const auto spanning = [](const char* plane, const char* pins, bool tethers) {
        World<3, float> world;
        build(world, Cloth{.columns = 128, .rows = 128, .plane = plane, .pins = pins, .tethers = tethers}, "cloth");
        prepare(world);
        std::vector<std::size_t> rows;
        const auto& bands = world.swept.plan.bands;
        for (std::size_t i = 0; i < bands.size(); ++i)
            if (bands[i].tightened > 0) rows.push_back(i);
        return rows;
    };
    const std::vector<std::size_t> top{0, 1, 2, 3, 4}, both{0, 1, 2, 3, 4, 123, 124, 125, 126, 127};
    EXPECT_EQ(spanning("vertical", "corners", true), top);
    EXPECT_EQ(spanning("horizontal", "all_corners", true), both);
    EXPECT_TRUE(spanning("vertical", "none", true).empty());
    EXPECT_TRUE(spanning("vertical", "corners", false).empty());
}

// One sweep of the links leaves more of a longer row undone.
TEST(Tethers, TightenLongRowsTwice) {
    for (const auto& [columns, times] : {std::pair(64, 1U), {128, 1U}, {160, 2U}}) {
        World<3, float> world;
        build(world, Cloth{.columns = columns, .rows = 16, .plane = "vertical", .pins = "corners"}, "cloth");
        prepare(world);
        EXPECT_EQ(world.swept.plan.bands.front().tightened, times) << columns;
        EXPECT_EQ(world.swept.plan.bands.back().tightened, 0U) << columns;
    }
}

// 2.3 % where nothing tightens what spans from pin to pin: its upper rows flap for good.
TEST(Tethers, KeepShortWhatHangsFromTwoCorners) {
    World<3, float> world;
    fall(world, 9.81);
    world.settings.substeps = 10;
    build(world, Cloth{.columns = 64, .rows = 64, .spacing = 0.03, .plane = "vertical", .pins = "corners"}, "cloth");
    auto& particles = world.particles;
    for (Row row = 0; row < particles.size(); ++row) { // so that it can leave its plane
        auto place = particles.position[row];
        if (particles.mobility[row] > 0) place[2] = 3e-5F * random::symmetric<float>(1, 0, row);
        set_position(world, particles.slots.id_of(row), place);
    }
    double most = 0;
    for (int i = 0; i < few_or_many(60, 300); ++i) {
        step(world, 1.0F / 60);
        most = std::max(most, stretch(world).max);
    }
    EXPECT_LT(most, 0.01);
}

// It swings down, its hem cracks after 0.7 s, and a wave of stretch runs up again (15 % where nothing is swept again).
TEST(Tethers, KeepShortWhatSwingsDownAndSnapsTaut) {
    World<3, float> world;
    fall(world, 9.81);
    world.settings.substeps = 10;
    build(world, Cloth{.columns = 64, .rows = 64, .spacing = 0.03, .plane = "horizontal", .pins = "corners"}, "cloth");
    double most = 0;
    for (int i = 0; i < few_or_many(54, 300); ++i) {
        step(world, 1.0F / 60);
        const auto& links = std::get<kind_number<Distance, 3>>(world.constraints);
        for (Row row = 0; row < links.size(); ++row) {
            const auto ends = links.members[row];
            const auto apart = world.particles.position[ends[1]] - world.particles.position[ends[0]];
            most = std::max(most, double(norm(apart) / links.high(row) - 1)); // what folds is squeezed a little more
        }
    }
    EXPECT_LT(most, 0.05);
}

} // namespace
} // namespace sinew
