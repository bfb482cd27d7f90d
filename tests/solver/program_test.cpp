#include "sinew/math/random.h"
#include "sinew/prefab/ragdoll.h"
#include "sinew/prefab/rope.h"
#include "sinew/world/edit.h"
#include "sinew/world/measure.h"

#include "tests/crowds.h"

#include <algorithm>
#include <cmath>

/// Trees and figures of rigid links, solved side by side in lanes, and flat squares with both diagonals.
namespace sinew::test::SINEW_TEST_FILE {
namespace {

template <class In> class Programs : public ::testing::Test {};
TYPED_TEST_SUITE(Programs, Everywhere, Names);

template <class World> using VectorOf = Vec<World::dimension, typename World::Real>;

template <class World> VectorOf<World> random_vector(std::uint64_t seed, double size) {
    using Real = typename World::Real;
    return VectorOf<World>::map(
        [&](int axis) { return Real(size * random::symmetric<double>(3, std::uint64_t(axis), seed)); });
}

/// A star of three arms, of two sticks each, in which lengths, masses and velocities differ from figure to figure.
template <class World> void add_star(World& world, int figure) {
    using Real = typename World::Real;
    const auto named = add_figure(world, "star_" + std::to_string(figure));
    std::vector<ParticleId> ids;
    const auto add_at = [&](double angle, double radius) {
        VectorOf<World> position{};
        position[0] = Real(3 * figure + radius * std::cos(angle)), position[1] = Real(radius * std::sin(angle));
        const auto seed = std::uint64_t(100 * figure) + ids.size();
        ids.push_back(add_particle(world, {.position = position,
                                           .velocity = random_vector<World>(seed, 2),
                                           .mass = Real(1 + figure % 3),
                                           .figure = named}));
    };
    const auto join = [&](std::size_t a, std::size_t b) {
        const auto &p = world.particles.position[*row_of(world, ids[a])],
                   &q = world.particles.position[*row_of(world, ids[b])];
        add<Distance>(world, {ids[a], ids[b]}, {.limits = exactly(distance(p, q)), .figure = named});
    };
    add_at(0, 0);
    for (std::size_t arm = 0; arm < 3; ++arm) {
        for (const double radius : {0.5, 1.0 + 0.1 * (figure % 4)}) add_at(2.1 * double(arm) + 0.1 * radius, radius);
        join(0, 2 * arm + 1), join(2 * arm + 1, 2 * arm + 2);
    }
}
/// Figures of different programs: stars, free ropes, bridges held at both ends, and ragdolls.
template <class World> void add_any(World& world, int i) {
    const auto at = [&](double x) {
        Placement<World::dimension, typename World::Real> placement;
        placement.at[0] = typename World::Real(x);
        return placement;
    };
    const auto name = "figure_" + std::to_string(i);
    if (i % 4 == 0) return add_star(world, i);
    if (i % 4 == 1)
        build(world,
              Rope{.length = 1 + 0.1 * (i % 3), .segments = 6, .angle = 0.4 * i, .pinned = "none", .links = "exact"},
              name, at(3 * i));
    if (i % 4 == 2)
        build(world,
              Rope{.length = 1 + 0.1 * (i % 3),
                   .segments = 5,
                   .angle = 0.3 * i,
                   .pinned = "both",
                   .links = i % 8 == 2 ? "at_most" : "exact"},
              name, at(3 * i));
    if (i % 4 == 3) {
        const Row first = Row(world.particles.size());
        build(world, Ragdoll{.mass = 40.0 + i}, name, at(3 * i));
        for (Row row = first; row < world.particles.size(); ++row)
            world.particles.velocity[row] = random_vector<World>(std::uint64_t(1000 * i) + row - first, 1);
    }
}

const auto add_figure_of_any_kind = [](auto& world, int i) { add_any(world, i); };
constexpr int figures = 22;

TYPED_TEST(Programs, MoveAloneAsInACrowd) {
    expect_alone_as_in_a_crowd<typename TypeParam::World>(figures, 0.7, add_figure_of_any_kind);
}

TYPED_TEST(Programs, MoveAlikeInAnyNumberOfLanesAndThreads) {
    expect_alike_in_any_lanes_and_threads<typename TypeParam::World>(figures, 0.5, add_figure_of_any_kind);
}

TYPED_TEST(Programs, NeedNothingThatIsNotInTheWorld) {
    expect_nothing_needed_but_the_world<typename TypeParam::World>(figures, 30, add_figure_of_any_kind);
}

TYPED_TEST(Programs, AreSharedByFiguresOfOneStructure) {
    using World = typename TypeParam::World;
    auto world = crowd<World>(0, figures, add_figure_of_any_kind);
    prepare(world);
    const auto& turns = world.solver.blocks.programs.turns;
    std::vector<int> sizes;
    for (const auto& turn : turns) {
        sizes.resize(std::max<std::size_t>(sizes.size(), turn.group + 1));
        ++sizes[turn.group];
    }
    std::sort(sizes.begin(), sizes.end());
    // Stars, free ropes, bridges of both kinds; ragdolls in 3D, where all joints are distances and folds.
    const auto expected = TypeParam::dimension == 2 ? std::vector<int>{2, 3, 6, 6} : std::vector<int>{2, 3, 5, 6, 6};
    EXPECT_EQ(sizes, expected);
}

/// Tumbling stars keep their energy, momentum and lengths.
TYPED_TEST(Programs, KeepTheirEnergyAndLengths) {
    using World = typename TypeParam::World;
    if (!TypeParam::precise) return;
    World world;
    for (int i = 0; i < 8; ++i) add_star(world, i);
    run(world, 0.1);
    ASSERT_EQ(world.solver.blocks.programs.turns.size(), 8U);
    const double begun = energy(world).total();
    for (int i = 0; i < 600; ++i) {
        run(world, 1 / 60.0);
        ASSERT_LT(stretch(world).max, 1e-7);
        ASSERT_NEAR(energy(world).total() / begun, 1, 1e-5);
    }
}

/// A square with both diagonals, and a limb at a corner, thrown about: random velocities first.
template <class World> World thrown_square() {
    using Real = typename World::Real;
    World world;
    std::vector<ParticleId> ids;
    const double positions[5][2] = {{0, 0}, {1, 0}, {1, 0.7}, {0, 0.7}, {1.5, 1}};
    for (const auto& position : positions)
        ids.push_back(add_particle(world, {.position = at<VectorOf<World>>(position[0], position[1]),
                                           .velocity = random_vector<World>(ids.size(), 3)}));
    const std::size_t pairs[7][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {1, 3}, {2, 4}};
    for (const auto& pair : pairs) {
        const auto &a = positions[pair[0]], &b = positions[pair[1]];
        add<Distance>(world, {ids[pair[0]], ids[pair[1]]},
                      {.limits = exactly(Real(std::hypot(a[0] - b[0], a[1] - b[1])))});
    }
    return world;
}

TEST(FlatSquare, IsHeldInItsPlaneByVolumeZero) {
    auto world = thrown_square<Stepped<3, double>>();
    prepare(world);
    const auto& blocks = world.solver.blocks;
    ASSERT_EQ(blocks.list.size(), 1U);
    EXPECT_EQ(blocks.list[0].flat_squares, 1U);
    EXPECT_EQ(blocks.list[0].links, 6U);
    EXPECT_EQ(blocks.list[0].bends, 1U);
    EXPECT_FALSE(blocks.list[0].braced());
}

TEST(FlatSquare, StaysFlatAndLosesNothingOnceThrown) {
    auto world = thrown_square<Stepped<3, double>>();
    run(world, 1 / 60.0);
    const double begun = energy(world).total();
    for (int i = 0; i < 600; ++i) {
        run(world, 1 / 60.0);
        ASSERT_LT(stretch(world).max, 1e-7) << i; // of the replaced diagonal, too
        ASSERT_NEAR(energy(world).total() / begun, 1, 1e-5) << i;
    }
}

TEST(FlatSquare, IsNoTetrahedron) {
    Stepped<3, double> world;
    std::vector<ParticleId> ids;
    for (const auto& position : {Vec<3, double>{{0, 0, 0}}, Vec<3, double>{{1, 0, 0}}, Vec<3, double>{{0, 1, 0}},
                                 Vec<3, double>{{0.3, 0.3, 0.01}}})
        ids.push_back(add_particle(world, {.position = position}));
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < i; ++j) add<Distance>(world, {ids[i], ids[j]});
    prepare(world);
    ASSERT_EQ(world.solver.blocks.list.size(), 1U);
    EXPECT_EQ(world.solver.blocks.list[0].flat_squares, 0U);
    EXPECT_EQ(world.solver.blocks.list[0].links, 6U);
}

} // namespace
} // namespace sinew::test::SINEW_TEST_FILE
