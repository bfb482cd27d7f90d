#include "sinew/prefab/prefabs.h"

#include "tests/dice.h"
#include "tests/sheets.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <algorithm>
#include <array>
#include <limits>

/// Cloth and the faces of crates in space: no vertex passes through a face.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Real> struct ClothOnSolid : ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ClothOnSolid, Precisions);

using Point = Vec3<double>;
constexpr double gravity = 9.81;

/// A sheet and a crate, both of which collide.
template <class Real> struct Pair {
    Space<Real> world;
    Sheet sheet;
    FigureIndex crate = no_figure;
    static constexpr double dot = 0.01;

    Pair(double cell, int cells, double size, double mass, double friction) {
        const FigureContactSpec contact{.figures = true, .friction = friction};
        sheet =
            add_sheet(world, {.size = cells + 1, .cell = cell, .mass = 0.2 * cell * cell, .contact = contact},
                      [&](int i, int k) { return point<Real>(cell * (i - 0.5 * cells), 0, cell * (k - 0.5 * cells)); });
        crate =
            build(world, Box{.width = size, .height = size, .depth = size, .mass = mass, .thickness = dot, .dot = dot},
                  "crate", {});
        set_contact(world, crate, contact);
    }
    std::vector<Point> places(FigureIndex figure) const {
        std::vector<Point> all;
        for (const auto id : world.figures[figure].particles) all.push_back(cast<double>(*position_of(world, id)));
        return all;
    }
    template <class Change> void move(FigureIndex figure, Change&& change) {
        for (const auto id : world.figures[figure].particles)
            set_position(world, id, cast<Real>(change(cast<double>(*position_of(world, id)))));
    }
    void throw_at(FigureIndex figure, const Point& velocity) {
        for (const auto id : world.figures[figure].particles) set_velocity(world, id, cast<Real>(velocity));
    }
    /// Moves the crate: turned about the axis y, with its middle at a place.
    void place_crate(const Point& middle, double angle) {
        Point now{};
        for (const auto& x : places(crate)) now += x * 0.125;
        const double c = std::cos(angle), s = std::sin(angle);
        move(crate, [&](const Point& x) {
            const auto r = x - now;
            return middle + Point{{c * r[0] + s * r[2], r[1], c * r[2] - s * r[0]}};
        });
    }
    /// Largest depth of a vertex below a face of the crate.
    double depth() const {
        const auto corner = places(crate);
        double deepest = -std::numeric_limits<double>::infinity();
        for (const auto& x : places(sheet.figure)) {
            double depth = std::numeric_limits<double>::infinity();
            for (const std::size_t k : {1, 2, 4}) {
                const auto side = corner[k] - corner[0];
                const double length = norm(side), along = sinew::dot(x - corner[0], side) / length;
                depth = std::min({depth, along, length - along});
            }
            deepest = std::max(deepest, depth);
        }
        return deepest;
    }
    double deepest_in(double seconds) {
        double deepest = -std::numeric_limits<double>::infinity();
        for (int i = 0; i < int(seconds * 60); ++i) {
            step(world, Real(1.0 / 60));
            deepest = std::max(deepest, depth());
        }
        return deepest;
    }
    Point momentum() const {
        Point sum{};
        for (Row row = 0; row < world.particles.size(); ++row)
            sum += cast<double>(world.particles.velocity[row]) * (1 / double(world.particles.mobility[row]));
        return sum;
    }
};

/// Cloth of cells from a fortieth to a third of a crate falls on it, and drapes it.
TYPED_TEST(ClothOnSolid, LiesOnACrate) {
    for (int seed = 1; seed <= few_or_many(6, 200); ++seed) {
        Dice dice{std::uint64_t(seed)};
        const double size = dice.scale(0.2, 2), cells = 8 + dice.below(24);
        Pair<TypeParam> pair(1.6 * size / cells, int(cells), size, dice.scale(1, 1000), dice.between(0, 0.8));
        pair.world.settings.substeps = 4 << dice.below(3);
        fall(pair.world, gravity);
        pair.world.bounds = {{at<Vec3<TypeParam>>(0, 1), 0, TypeParam(0.5), 0}};
        pair.place_crate({{dice.between(-0.2, 0.2) * size, 0.5 * size + 0.005, 0}}, dice.between(0, 3));
        pair.move(pair.sheet.figure, [&](Point x) { return x + Point{{0, size * 1.1 + 0.02, 0}}; });
        EXPECT_LT(pair.deepest_in(3), 0) << seed;
    }
}

/// Crates of a tenth to a hundred times the mass of a sheet, thrown at it or it at them, by at most half a crate in a
/// substep.
TYPED_TEST(ClothOnSolid, NoBlowPassesAFace) {
    for (int seed = 1; seed <= few_or_many(12, 500); ++seed) {
        Dice dice{std::uint64_t(seed)};
        const double size = dice.scale(0.2, 1), speed = dice.scale(1, 100);
        const int cells = 6 + dice.below(16);
        Pair<TypeParam> pair(2 * size / cells, cells, size, 0.2 * square(2 * size) * dice.scale(0.1, 100),
                             dice.between(0, 0.8));
        pair.world.settings.substeps = 1 << dice.below(5);
        while (speed > 30 * pair.world.settings.substeps * size) pair.world.settings.substeps *= 2;
        pair.place_crate({{dice.between(-0.3, 0.3) * size, -0.7 * size, dice.between(-0.3, 0.3) * size}},
                         dice.between(0, 3));
        const bool is_cloth_thrown = dice.below(2) == 0;
        const Point velocity{{0.1 * speed, is_cloth_thrown ? -speed : speed, 0}};
        pair.throw_at(is_cloth_thrown ? pair.sheet.figure : pair.crate, velocity);
        const auto momentum = pair.momentum();
        EXPECT_LT(pair.deepest_in(0.5), 0) << seed;
        const double exact = sizeof(TypeParam) == 8 ? 1e-9 : 1e-3;
        EXPECT_LT(norm(pair.momentum() - momentum), exact * norm(momentum)) << seed;
    }
}

/// Cloth that begins through a crate parts from it as far as it hangs together, and gently.
TYPED_TEST(ClothOnSolid, ComesOutOfACrateGently) {
    for (const double height : {-0.45, 0.0, 0.3}) {
        Pair<TypeParam> pair(0.05, 20, 0.5, 20, 0.3);
        pair.world.settings.substeps = 8;
        pair.place_crate({{0.01, 0, 0.02}}, 0.3);
        pair.move(pair.sheet.figure, [&](const Point& x) { return x + Point{{0, 0.5 * height, 0}}; });
        double most = 0;
        for (int i = 0; i < 60; ++i) {
            step(pair.world, TypeParam(1.0 / 60));
            most = std::max(most, energy(pair.world).kinetic);
        }
        EXPECT_LT(most, 0.01) << height;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
