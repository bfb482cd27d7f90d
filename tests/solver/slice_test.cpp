#include "sinew/topology/cut.h"
#include "sinew/world/islands.h"

#include "tests/prefab/make.h"
#include "tests/worlds.h"

/// Cells of cloth that a blade crosses: what is drawn of them follows it.
namespace sinew::SINEW_TEST_FILE {
namespace {

using Made2 = Made<2, double>;

constexpr double spacing = 0.1;

Made2 sheet(std::string_view diagonals = "none") {
    return make(Cloth{.columns = 9,
                      .rows = 9,
                      .spacing = spacing,
                      .pins = "top",
                      .diagonals = std::string(diagonals),
                      .drawn = "fill"});
}

template <class WorldT> Vec3<double> in_space(const WorldT& world, ParticleId id) {
    Vec3<double> wide{};
    for (int i = 0; i < WorldT::dimension; ++i) wide[i] = double(position_of(world, id).value()[i]);
    return wide;
}

Vec3<double> bilinear(const std::array<Vec3<double>, 4>& corner, double u, double v) {
    return (corner[0] * (1 - u) + corner[1] * u) * (1 - v) + (corner[3] * (1 - u) + corner[2] * u) * v;
}

/// The polygons that are drawn of a figure's cloth.
template <class WorldT> std::vector<std::vector<Vec3<double>>> polygons_of(const WorldT& world) {
    std::vector<std::vector<Vec3<double>>> polygons;
    for (const auto& figure : world.figures)
        for (const auto& piece : figure.pieces) {
            const auto position = [&](std::size_t i) { return in_space(world, piece.particles[i]); };
            if (piece.mark == Mark::surface) polygons.push_back({position(0), position(1), position(2), position(3)});
            if (piece.mark != Mark::fragment) continue;
            const auto& fragment = figure.fragments[piece.fragment];
            std::array<Vec3<double>, 4> corner{};
            for (std::size_t i = 0; i < 4; ++i)
                corner[i] = position_of(fragment.corners[i], position, WorldT::dimension == 2);
            fragment.each_tile([&](std::span<const Vec2<float>> tile) {
                polygons.emplace_back();
                for (const auto& uv : tile) polygons.back().push_back(bilinear(corner, double(uv[0]), double(uv[1])));
            });
        }
    return polygons;
}

double area_of(const std::vector<Vec3<double>>& polygon) {
    Vec3<double> twice{};
    for (std::size_t i = 2; i < polygon.size(); ++i)
        twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return norm(twice) / 2;
}

template <class WorldT> double area_drawn(const WorldT& world) {
    double sum = 0;
    for (const auto& polygon : polygons_of(world)) sum += area_of(polygon);
    return sum;
}

std::size_t count(const World<2, double>& world, Mark mark) {
    const auto& pieces = world.figures[0].pieces;
    return std::size_t(std::ranges::count_if(pieces, [&](const Piece& piece) { return piece.mark == mark; }));
}

/// How far polygons reach over to the other side of a blade's line, as far as the blade is long.
double reach_across(const std::vector<std::vector<Vec3<double>>>& polygons, const Blade& blade) {
    const auto along = direction(blade.to - blade.from);
    double worst = 0;
    for (const auto& polygon : polygons) {
        double left = 0, right = 0;
        for (const auto& point : polygon) {
            const Vec2<double> way = Vec2<double>{{point[0], point[1]}} - blade.from;
            if (dot(way, along) < 0 || dot(way, along) > distance(blade.from, blade.to)) continue;
            left = std::max(left, cross(along, way) + blade.radius);
            right = std::max(right, blade.radius - cross(along, way));
        }
        worst = std::max(worst, std::min(left, right));
    }
    return worst;
}

/// The rows of what links join to a particle.
std::vector<Row> reached_from(const World<2, double>& world, ParticleId first) {
    std::vector<char> seen(world.particles.size(), 0);
    std::vector<Row> rows{row_of(world, first).value()};
    seen[rows[0]] = 1;
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (const auto& ends : std::get<kind_number<Distance, 2>>(world.constraints).members.rows)
            for (const auto& [a, b] : {std::pair(ends[0], ends[1]), std::pair(ends[1], ends[0])})
                if (a == rows[i] && !seen[b]) seen[b] = 1, rows.push_back(b);
    return rows;
}

/// Right through, askew: no two cells are crossed alike.
const Blade askew{{{-0.6, -0.13}}, {{0.6, -0.71}}};

TEST(Slice, NoPolygonReachesAcrossTheBladeAndNothingIsLost) {
    for (const auto* diagonals : {"none", "one", "both"}) {
        auto made = sheet(diagonals);
        const double before = area_drawn(made.world);
        EXPECT_GT(reach_across(polygons_of(made.world), askew), 0.01);
        EXPECT_GT(cut(made.world, askew).links, 10U);
        EXPECT_LT(reach_across(polygons_of(made.world), askew), 1e-8);
        EXPECT_NEAR(area_drawn(made.world), before, 1e-6 * before) << diagonals;
        EXPECT_EQ(islands(made.world)[0], 2U) << diagonals;
    }
}

// Of 8 x 8 cells of 0.1 m the band of 0.06 m takes its area, but for the parts without a corner that hang on nothing:
// slivers, of which each is smaller than a quarter of a cell.
TEST(Slice, AThickBladeTakesABandOfItsWidth) {
    auto made = sheet();
    const double before = area_drawn(made.world);
    const Blade thick{askew.from, askew.to, 0.03};
    cut(made.world, thick);
    EXPECT_LT(reach_across(polygons_of(made.world), thick), 1e-8);
    const double band = 0.06 * 0.8 / (1.2 / distance(askew.from, askew.to));
    EXPECT_NEAR(before - area_drawn(made.world), band, 0.25 * band);
    EXPECT_GE(before - area_drawn(made.world), 0.99 * band);
}

// What hangs on a side keeps its shape as that side moves: where all particles are turned, enlarged and shifted, the
// fragments are too.
TEST(Slice, FragmentsFollowTheirSide) {
    auto made = sheet();
    cut(made.world, askew);
    const auto before = polygons_of(made.world);
    const auto moved = [](const Vec3<double>& p) {
        return Vec3<double>{{0.3 + 0.8 * p[0] - 0.5 * p[1], -0.2 + 0.5 * p[0] + 0.8 * p[1], 0}};
    };
    for (auto& position : made.world.particles.position) {
        const auto to = moved({{position[0], position[1], 0}});
        position = {{to[0], to[1]}};
    }
    const auto after = polygons_of(made.world);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i)
        for (std::size_t k = 0; k < before[i].size(); ++k)
            EXPECT_NEAR(distance(after[i][k], moved(before[i][k])), 0, 1e-9);
}

TEST(Slice, AWholeSideMovesAwayWithItsEdge) {
    auto made = sheet();
    const double before = area_drawn(made.world);
    cut(made.world, askew);
    const auto along = direction(askew.to - askew.from);
    for (auto& position : made.world.particles.position)
        if (cross(along, position - askew.from) < 0) position += Vec2<double>{{0.1, -1}};
    EXPECT_NEAR(area_drawn(made.world), before, 1e-6 * before);
    Blade both = askew; // the lower edge is where it went
    both.from += Vec2<double>{{0.1, -1}}, both.to += Vec2<double>{{0.1, -1}};
    EXPECT_LT(reach_across(polygons_of(made.world), both), 1e-8);
    EXPECT_LT(reach_across(polygons_of(made.world), askew), 1e-8);
}

TEST(Slice, ASecondBladeSlicesFragmentsToo) {
    auto made = sheet();
    const double before = area_drawn(made.world);
    const Blade other{{{0.13, 0.1}}, {{-0.21, -1}}};
    cut(made.world, askew);
    cut(made.world, other);
    EXPECT_LT(reach_across(polygons_of(made.world), askew), 1e-8);
    EXPECT_LT(reach_across(polygons_of(made.world), other), 1e-8);
    EXPECT_GT(area_drawn(made.world), before - spacing * spacing); // a part without a corner may be lost
    EXPECT_EQ(islands(made.world)[0], 4U);
}

// The first blade ends in a cell that the second one runs through: no fragment holds on to both sides.
TEST(Slice, ABladeThroughTheEndOfAnotherPartsItsCell) {
    auto made = sheet();
    cut(made.world, Blade{{{-0.5, -0.2}}, {{0.08, -0.5}}});
    cut(made.world, Blade{{{0.03, 0.1}}, {{0.06, -1}}});
    ASSERT_EQ(islands(made.world)[0], 3U);
    const double before = area_drawn(made.world);
    const auto fallen = *find_particle(made.world, "it/particle_2_8");
    for (const Row row : reached_from(made.world, fallen)) made.world.particles.position[row] += Vec2<double>{{0, -5}};
    EXPECT_NEAR(area_drawn(made.world), before, 1e-6);
}

// The blade ends inside of the cloth: the cell around its end is slit, and the rest is whole.
TEST(Slice, ABladeThatEndsInsideLeavesASlit) {
    auto made = sheet();
    const double before = area_drawn(made.world);
    const Blade slit{{{0.02, -0.33}}, {{0.02, -0.58}}};
    EXPECT_EQ(cut(made.world, slit).links, 2U);
    EXPECT_LT(reach_across(polygons_of(made.world), slit), 1e-8);
    EXPECT_NEAR(area_drawn(made.world), before, 1e-6 * before);
    EXPECT_EQ(islands(made.world)[0], 1U);
    EXPECT_EQ(count(made.world, Mark::fragment), 6U); // three cells, each in two
    EXPECT_EQ(count(made.world, Mark::surface), 61U);
}

TEST(Slice, WhatTearsOrIsSnippedAfterwardsKeepsTheOtherFragments) {
    auto made = sheet();
    cut(made.world, askew);
    const auto fragments = count(made.world, Mark::fragment);
    const auto id = find_constraint(made.world, "it/across_0_8");
    ASSERT_TRUE(id);
    cut(made.world, std::span<const ConstraintId>(&*id, 1));
    EXPECT_EQ(count(made.world, Mark::fragment), fragments);
    EXPECT_EQ(made.figure().fragments.size(), fragments);
    EXPECT_LT(reach_across(polygons_of(made.world), askew), 1e-8);
}

// Seen askew, from near: a cell's perspective is not linear, and its edge still lies on the blade.
TEST(Slice, InSpaceTheyFollowTheBladeAsItIsSeen) {
    auto made = make<3, double>(Cloth{.columns = 9, .rows = 9, .spacing = spacing, .pins = "top", .drawn = "fill"});
    const Projection<3> see = [](const Vec3<double>& p) {
        const double depth = 1 + 0.6 * p[0] + p[2];
        return Vec2<double>{{p[0] / depth, p[1] / depth}};
    };
    const auto seen = [&] {
        auto polygons = polygons_of(made.world);
        for (auto& polygon : polygons)
            for (auto& point : polygon) point = {{see(point)[0], see(point)[1], 0}};
        return polygons;
    };
    const double before = area_drawn(made.world);
    EXPECT_GT(reach_across(seen(), askew), 0.01);
    cut(made.world, askew, see);
    EXPECT_LT(reach_across(seen(), askew), 1e-6);
    EXPECT_NEAR(area_drawn(made.world), before, 1e-5 * before);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
