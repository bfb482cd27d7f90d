#include "sinew/prefab/prefabs.h"
#include "sinew/scene/scene.h"
#include "sinew/topology/cut.h"
#include "sinew/world/edit.h"
#include "sinew/world/environment.h"
#include "sinew/world/measure.h"

#include "tests/stepped.h"
#include "tests/worlds.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

/// Wind with a density: pressure on areas, lines and balls, F = 1/2 density drag_coefficient A |w| w.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Where> class Winds : public ::testing::Test {};
TYPED_TEST_SUITE(Winds, Everywhere, Names);

TYPED_TEST(Winds, BallFallsAtItsTerminalSpeed) {
    for (const double rate : {60.0, 240.0}) {
        typename TypeParam::World world;
        using Real = typename TypeParam::World::Real;
        using Vector = typename TypeParam::World::Vector;
        constexpr int D = TypeParam::World::dimension;
        set_gravity(world, at<Vector>(0, -9.81));
        const double density = 1.2, coefficient = 0.5, radius = 0.2, mass = 2, depth = 3;
        add_wind(world, {.density = Real(density), .drag_coefficient = Real(coefficient), .metre = Real(depth)});
        const auto figure = add_figure(world, "ball");
        const auto ball = add_particle(world, {.mass = Real(mass), .radius = Real(radius), .figure = figure});
        world.figures[figure].particles.push_back(ball);
        run(world, 60, rate);
        const double area = D == 3 ? std::numbers::pi * radius * radius : 2 * radius * depth;
        const double speed = std::sqrt(2 * mass * 9.81 / (density * coefficient * area));
        EXPECT_NEAR(-double((*velocity_of(world, ball))[1]), speed, 0.55 * 9.81 / rate) << rate; // half a step's gain
    }
}

/// A world of a scene, after some seconds.
template <class Seen> void after(const std::string& text, double seconds, Seen&& seen) {
    auto document = load(text, "test", {});
    auto opened = open_scene(document);
    ASSERT_TRUE(opened) << to_text(document.diagnostics);
    std::visit(
        [&]<int D, class Real>(World<D, Real>& world) {
            Solver<D, Real> solver;
            const double dt = std::min(seconds, 1.0 / 60);
            for (int i = 0; i < int(seconds / dt + 0.5); ++i) solver.step(world, Real(dt));
            seen(world);
        },
        opened->world);
}

/// Total force of the wind on a plate of 1.8 m^2, from its momentum after a hundredth of a millisecond.
Vec3<double> force_on_plate(const std::string& drawn, double angle, int columns) {
    Vec3<double> force{};
    const double spacing = 1.8 / (columns - 1);
    after(fmt::format(R"({{"sinew": 1, "dimension": 3, "solver": {{"substeps": 1}}, "world": {{"gravity": [0, 0, 0],
              "forces": [{{"force": "wind", "velocity": [{}, 0, {}], "density": 1.5, "drag_coefficient": 1.1}}]}},
              "figures": [{{"prefab": "cloth", "columns": {}, "rows": {}, "spacing": {}, "pins": "none",
                           "drawn": "{}"}}]}})",
                      10 * std::sin(angle), 10 * std::cos(angle), columns, (columns - 1) * 5 / 9 + 1, spacing, drawn),
          1e-5, [&]<int D, class Real>(const World<D, Real>& world) {
              const auto total = momentum(world);
              for (int k = 0; k < D; ++k) force[k] = 2 * double(total[k]) * 1e5; // velocities: means of substeps
          });
    return force;
}

TEST(Wind, PlateIsPressedByTheAngleAlongItsNormal) {
    for (const auto* drawn : {"fill", "threads"})
        for (const int columns : {10, 37})
            for (const double angle : {0.0, 0.5, 1.0, std::numbers::pi / 2}) {
                const auto force = force_on_plate(drawn, angle, columns);
                const double along = 0.5 * 1.5 * 1.1 * 1.8 * std::pow(10 * std::cos(angle), 2);
                EXPECT_NEAR(force[2], along, 2e-3 * along + 1e-9) << drawn << columns << " at " << angle;
                EXPECT_NEAR(force[0], 0, 1e-6) << drawn << columns << " at " << angle;
                EXPECT_NEAR(force[1], 0, 1e-6) << drawn << columns << " at " << angle;
            }
}

/// Area of cloth that hangs on particles, with cells of 1 m^2.
double area_of(const Figure& figure) {
    double area = 0;
    for (const auto& piece : figure.pieces) {
        if (piece.mark == Mark::surface) ++area;
        if (piece.mark != Mark::fragment || piece.particles.size() == 0) continue;
        figure.fragments[piece.fragment].each_tile([&](std::span<const Vec2<float>> tile) {
            for (std::size_t i = 0; i < tile.size(); ++i)
                area += cross(cast<double>(tile[i]), cast<double>(tile[(i + 1) % tile.size()])) / 2;
        });
    }
    return area;
}

TEST(Wind, ClothInPiecesIsPressedByWhatIsLeftOfItsCells) {
    World<3, double> world;
    add_wind(world, {.velocity = {0, 0, 10}, .density = 1.5, .drag_coefficient = 1});
    const FigureIndex cloth =
        build(world, Cloth{.columns = 3, .rows = 3, .spacing = 1, .pins = "none", .drawn = "fill"}, "cloth");
    const auto center = center_of_mass(world);
    for (int blades = 0; blades < 20; ++blades) {
        auto blown = world;
        Solver<3, double> solver;
        constexpr double dt = 1e-8; // or light scraps would follow the wind
        solver.step(blown, dt);     // velocities of what flies freely are half a substep old
        const auto begun = momentum(blown)[2];
        solver.step(blown, dt);
        const double area = area_of(world.figures[cloth]);
        EXPECT_GT(area, 2.5) << blades;
        EXPECT_NEAR(momentum(blown)[2] - begun, 75 * area * dt, 75e-3 * area * dt) << blades;
        const double angle = 0.3 + blades, x = center[0] + 0.31, y = center[1] + 0.27;
        cut(world, Blade{{{x - 2 * std::cos(angle), y - 2 * std::sin(angle)}},
                         {{x + 2 * std::cos(angle), y + 2 * std::sin(angle)}}});
    }
}

/// Angle from the vertical at which a figure hangs in the wind.
double lean(int dimension, const std::string& figure, const std::string& wind) {
    double angle = 0;
    after(fmt::format(R"({{"sinew": 1, "dimension": {}, "world": {{"gravity": [0, -9.81{}], "damping": 1,
              "forces": [{{"force": "wind", {}, "density": 1.2}}]}}, "figures": [{}]}})",
                      dimension, dimension == 3 ? ", 0" : "", wind, figure),
          20, [&](const auto& world) {
              const auto center = center_of_mass(world);
              angle = std::atan2(std::hypot(double(center[0]), dimension == 3 ? double(center[2]) : 0.0),
                                 -double(center[1]));
          });
    return angle;
}

TEST(Wind, FlagLeansAlikeHoweverFine) {
    for (const int dimension : {2, 3})
        for (const auto* drawn : {"fill", "threads"}) {
            const auto flag = [&](int columns) {
                return lean(
                    dimension,
                    fmt::format(R"({{"prefab": "cloth", "at": [-0.9, 0{}], "columns": {}, "rows": {}, "mass": 0.5,
                                        "spacing": {}, "drawn": "{}"}})",
                                dimension == 3 ? ", 0" : "", columns, columns, 1.8 / (columns - 1), drawn),
                    dimension == 3 ? R"("velocity": [0, 0, 1.5])" : R"("velocity": [1, 0])");
            };
            const double coarse = flag(10), fine = flag(37);
            EXPECT_GT(fine, 0.03) << dimension << drawn;
            EXPECT_NEAR(coarse, fine, 0.1 * fine) << dimension << drawn;
        }
}

TEST(Wind, RopeLeansAlikeHoweverFine) {
    for (const int dimension : {2, 3}) {
        const auto rope = [&](int segments) {
            return lean(dimension,
                        fmt::format(R"({{"prefab": "rope", "angle": -90, "length": 2, "segments": {}, "mass": 0.5,
                                    "thickness": 0.03}})",
                                    segments),
                        dimension == 3 ? R"("velocity": [12, 0, 0])" : R"("velocity": [2, 0])");
        };
        const double coarse = rope(10), fine = rope(37);
        EXPECT_GT(fine, 0.05) << dimension;
        EXPECT_NEAR(coarse, fine, 0.1 * fine) << dimension;
    }
}

TEST(Wind, NothingBlowsUpHoweverLight) {
    after(R"({"sinew": 1, "dimension": 3, "world": {"gravity": [0, -9.81, 0],
              "forces": [{"force": "wind", "velocity": [30, 0, 40], "density": 1000, "gust": [20, 20, 20]}]},
              "figures": [{"prefab": "cloth", "columns": 12, "rows": 12, "mass": 1e-6, "pins": "corners"},
                          {"prefab": "rope", "at": [5, 0, 0], "mass": 1e-6}]})",
          5, [&](const auto& world) {
              for (const auto& velocity : world.particles.velocity) EXPECT_LT(double(norm(velocity)), 500);
          });
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
