#include "sinew/math/random.h"
#include "sinew/prefab/cloth.h"
#include "sinew/world/measure.h"

#include "tests/stepped.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

// Of rows between two pins, a way by way of the middle is hardly longer than straight on.
TEST(Tethers, KnowTheRowsThatSpanFromPinToPin) {
    const auto spanning = [](const char* plane, const char* pins, bool tethers) {
        test::Stepped<3, float> world;
        build(world, Cloth{.columns = 128, .rows = 128, .plane = plane, .pins = pins, .tethers = tethers}, "cloth");
        prepare(world);
        std::vector<std::size_t> rows;
        const auto& tiles = world.solver.sweep_state.plan.tiles;
        for (std::size_t i = 0; i < tiles.size(); ++i)
            if (tiles[i].span_repairs > 0) rows.push_back(i);
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
        test::Stepped<3, float> world;
        build(world, Cloth{.columns = columns, .rows = 16, .plane = "vertical", .pins = "corners"}, "cloth");
        prepare(world);
        EXPECT_EQ(world.solver.sweep_state.plan.tiles.front().span_repairs, times) << columns;
        EXPECT_EQ(world.solver.sweep_state.plan.tiles.back().span_repairs, 0U) << columns;
    }
}

// Not all substeps look after them, but the last does, however many there are.
TEST(Tethers, HoldWhenAStepIsOver) {
    constexpr int side = 24;
    constexpr double cell = 0.03;
    for (const int substeps : {1, 2, 3, 4, 7}) {
        test::Stepped<3, float> world;
        fall(world, gravity);
        world.settings.substeps = substeps;
        const auto cloth =
            build(world, Cloth{.columns = side, .rows = side, .spacing = cell, .plane = "horizontal", .pins = "none"},
                  "cloth");
        pin(world, world.figures[cloth].particles[0]);
        double furthest = 0; // as a part of the shortest way along the links
        for (int i = 0; i < 30; ++i) {
            step(world, 1.0F / 60);
            const auto& position = world.particles.position;
            for (Row row = 1; row < position.size(); ++row) {
                const double right = row % side, down = row / side;
                const double way = std::max(right, down) + (std::sqrt(2.0) - 1) * std::min(right, down);
                furthest = std::max(furthest, double(norm(position[row] - position[0])) / (cell * way));
            }
        }
        EXPECT_LT(furthest, 1.00002) << substeps << " substeps";
        EXPECT_GT(furthest, 1) << substeps << " substeps"; // it does hang in them
    }
}

// 2.3 % where nothing tightens what spans from pin to pin: its upper rows flap for good.
TEST(Tethers, KeepShortWhatHangsFromTwoCorners) {
    test::Stepped<3, float> world;
    fall(world, gravity);
    world.settings.substeps = 10;
    build(world, Cloth{.columns = 64, .rows = 64, .spacing = 0.03, .plane = "vertical", .pins = "corners"}, "cloth");
    auto& particles = world.particles;
    for (Row row = 0; row < particles.size(); ++row) { // so that it can leave its plane
        auto position = particles.position[row];
        if (particles.mobility[row] > 0) position[2] = 3e-5F * random::symmetric<float>(1, 0, row);
        set_position(world, particles.handles.id_of(row), position);
    }
    double max = 0;
    for (int i = 0; i < few_or_many(60, 300); ++i) {
        step(world, 1.0F / 60);
        max = std::max(max, stretch(world).max);
    }
    EXPECT_LT(max, 0.01);
}

// It swings down, its hem cracks after 0.7 s, and a wave of stretch runs up again (15 % where nothing is swept again).
TEST(Tethers, KeepShortWhatSwingsDownAndSnapsTaut) {
    test::Stepped<3, float> world;
    fall(world, gravity);
    world.settings.substeps = 10;
    build(world, Cloth{.columns = 64, .rows = 64, .spacing = 0.03, .plane = "horizontal", .pins = "corners"}, "cloth");
    double max = 0;
    for (int i = 0; i < few_or_many(54, 300); ++i) {
        step(world, 1.0F / 60);
        const auto& links = std::get<kind_number<Distance, 3>>(world.constraints);
        for (Row row = 0; row < links.size(); ++row) {
            const auto ends = links.members[row];
            const auto apart = world.particles.position[ends[1]] - world.particles.position[ends[0]];
            max = std::max(max, double(norm(apart) / links.high(row) - 1)); // what folds is squeezed a little more
        }
    }
    EXPECT_LT(max, 0.05);
}

/// Kinetic energy that a cloth of 1.9 m still has, over its weight times its width, 14 seconds after its two pins have
/// come so near to each other.
template <class Real> double motion_left(Real between) {
    test::Stepped<3, Real> world;
    fall(world, gravity);
    world.settings.damping = 3;
    build(world, Cloth{.columns = 20, .rows = 20, .pins = "corners"}, "cloth");
    constexpr int moving = 60, frames = 15 * 60;
    const auto begun = world.pins;
    const Real width = absolute(begun[1].target[0] - begun[0].target[0]);
    for (int i = 1; i <= frames; ++i) {
        const Real share = Real(min(i, moving)) / Real(moving);
        for (std::size_t k = 0; k < begun.size(); ++k)
            world.pins[k].target[0] = begun[k].target[0] * (1 - share * (1 - between / width));
        step(world, Real(1.0 / 60));
    }
    return energy(world).kinetic / (total_mass(world) * gravity * double(width));
}

// Links of gathered cloth push: tethers and repairs, which only pull, must not keep it moving.
TEST(Tethers, LetGatheredClothRest) {
    constexpr std::array far = {1.0, 0.6, 1.4};
    for (const double between : std::span(far).first(few_or_many(1, 3))) {
        EXPECT_LT(motion_left<double>(between), 1e-6) << between << " m, double";
        EXPECT_LT(motion_left<float>(float(between)), 1e-6) << between << " m, float";
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
