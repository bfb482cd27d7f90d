#include "sinew/prefab/tetrahedra.h"
#include "sinew/world/measure.h"

#include "tests/prefab/make.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

/// Figures in space: crates, wheels, limbs, and solids of tetrahedra.
namespace sinew::SINEW_TEST_FILE {
namespace {

double volume_of(const TetraMesh& mesh, const std::array<std::uint32_t, 4>& t) {
    const auto a = mesh.points[t[0]];
    return dot(mesh.points[t[1]] - a, cross(mesh.points[t[2]] - a, mesh.points[t[3]] - a)) / 6;
}

/// Every side of the surface has two triangles, in opposite directions, and all tetrahedra are upright.
void expect_sound(const TetraMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& [a, b, c] : mesh.surface)
        for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) ++sides[{from, to}];
    for (const auto& [side, count] : sides) EXPECT_EQ(sides.count({side.second, side.first}), 1U) << count;
    for (const auto& t : mesh.tetrahedra) EXPECT_GT(volume_of(mesh, t), 0);
}
double total_volume(const TetraMesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.tetrahedra) sum += volume_of(mesh, t);
    return sum;
}

// Chords are inside of a ball: the fewer cells, the more is missing. A point that would flatten a tetrahedron stays
// outside, a quarter of a cell at most.
TEST(Tetrahedra, FillABallToItsSurface) {
    for (const int cells : {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}) {
        const auto mesh = fill_with_tetrahedra(BallSolid(0.5), cells);
        ASSERT_FALSE(mesh.tetrahedra.empty()) << cells;
        expect_sound(mesh);
        const double volume = 4.0 / 3 * pi<double> * 0.125;
        EXPECT_LT(total_volume(mesh), volume) << cells;
        EXPECT_GT(total_volume(mesh), volume * (1 - 2.0 / cells / cells)) << cells;
        for (const auto& point : mesh.points) EXPECT_LE(norm(point), 0.5 + 0.25 / cells + 1e-12);
    }
}

MeshModel cuboid(double x, double y, double z) {
    MeshModel model{.points = {},
                    .corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5},
                    .ends = {4, 8, 12, 16, 20, 24}};
    for (int i = 0; i < 8; ++i) model.points.push_back({{i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0}});
    return model;
}

// Corners and edges between points of the lattice are cut off.
TEST(Tetrahedra, FillAClosedMeshWhicheverWayItsFacesTurn) {
    auto model = cuboid(1, 2, 1.5);
    EXPECT_EQ(open_edges(model), 0U);
    for (const bool inside_out : {false, true}) {
        if (inside_out) std::reverse(model.corners.begin(), model.corners.end());
        const auto mesh = fill_with_tetrahedra(model, 10);
        expect_sound(mesh);
        EXPECT_NEAR(total_volume(mesh), 3, 0.45);
        for (const auto& point : mesh.points)
            for (int i = 0; i < 3; ++i) {
                EXPECT_GE(point[i], -0.06) << i;
                EXPECT_LE(point[i], (i == 0 ? 1 : i == 1 ? 2 : 1.5) + 0.06) << i;
            }
    }
    model.ends.pop_back();
    model.corners.resize(20);
    EXPECT_EQ(open_edges(model), 4U);
}

TEST(Jelly, IsRefusedForAMeshThatIsOpen) {
    auto model = cuboid(1, 1, 1);
    EXPECT_FALSE(problem_of(Jelly{.model = std::make_shared<const MeshModel>(model)}, 3));
    model.ends.pop_back();
    model.corners.resize(20);
    EXPECT_EQ(problem_of(Jelly{.model = std::make_shared<const MeshModel>(model)}, 3),
              "a jelly fills a closed mesh, and 4 edges of this one belong to no second face");
}

TEST(Jelly, BeginsAtRest) {
    const auto made = make<3>(Jelly{.cells = 4});
    const auto& distances = std::get<kind_number<Distance, 3>>(made.world.constraints);
    EXPECT_GT(distances.size(), 100U);
    EXPECT_LT(stretch(made.world).max, 1e-12);
    EXPECT_NEAR(total_mass(made.world), 5, 1e-9);
}

// Eight points have 24 coordinates, and a body six of them: 18 rods hold a crate, and each pulls on its own.
TEST(Box, InSpaceIsRigidWithOneBraceAFace) {
    const auto made = make<3>(Box{.width = 1, .height = 2, .depth = 3});
    EXPECT_EQ(made.particles(), 8U);
    EXPECT_EQ(made.constraints(), 18U);
    EXPECT_EQ(make<3>(Box{.braces = "both"}).constraints(), 24U);
    EXPECT_EQ(make<3>(Box{.braces = "none"}).constraints(), 12U);
    EXPECT_EQ(made.position("top_right_front"), (Vec3<double>{{0.5, 1, 1.5}}));
    EXPECT_EQ(made.position("bottom_left_back"), (Vec3<double>{{-0.5, -1, -1.5}}));
}

TEST(Tire, InSpaceHasTwoRimsOnAnAxle) {
    const auto made = make<3>(Tire{.segments = 12, .radius = 0.4, .width = 0.2});
    EXPECT_EQ(made.particles(), 26U);
    EXPECT_EQ(made.constraints(), 12U * (2 + 3 + 2 + 4) + 1);
    EXPECT_EQ(made.position("center"), (Vec3<double>{{0, 0, 0.1}}));
    EXPECT_EQ(made.position("back_0"), (Vec3<double>{{0.4, 0, -0.1}}));
}

TEST(Limb, InSpaceBendsToEverySideAlike) {
    const auto made = make<3>(Limb{.bend_min = -pi<double> / 2, .bend_max = 1});
    const auto& angles = std::get<kind_number<Angle, 3>>(made.world.constraints);
    ASSERT_EQ(angles.size(), 1U);
    EXPECT_EQ(angles.low(0), 0);
    EXPECT_EQ(angles.high(0), pi<double> / 2);
}

TEST(Build, TellsWhatIsWrongAndAddsNothing) {
    World<2, double> world;
    const auto told = [&](const auto& prefab) {
        const auto built = build(world, prefab, "it");
        EXPECT_FALSE(built);
        return built.problem;
    };
    EXPECT_EQ(told(Rope{.segments = -5}), "segments is from 1 to 1e+09, found -5");
    EXPECT_EQ(told(Rope{.segments = 1'000'000'000}).substr(0, 10), "1000000001");
    EXPECT_EQ(told(Rope{.pinned = "strat"}), "pinned is one of start, end, both, none, found \"strat\"");
    EXPECT_EQ(told(Rope{.length = std::numeric_limits<double>::quiet_NaN()}).substr(0, 9), "length is");
    EXPECT_EQ(told(Rope{.angle = 90}).substr(0, 8), "angle is");
    EXPECT_EQ(told(Rope{.elasticity = {-1}}).substr(0, 13), "compliance is");
    EXPECT_EQ(told(Limb{.bend = 2, .bend_max = 1}).substr(0, 7), "bend is");
    EXPECT_EQ(world.particles.size() + world.figures.size(), 0U);
    EXPECT_TRUE(build(world, Rope{}, "rope"));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
