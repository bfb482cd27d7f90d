#include "sinew/math/trig.h"
#include "sinew/solver/contact/rigid_clusters.h"
#include "sinew/world/measure.h"

#include "tests/crates.h"
#include "tests/worlds.h"

#include <array>
#include <cmath>
#include <vector>

/// Rigid clusters: which links make one, and how it moves.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

// --- who belongs to one ----------------------------------------------------------------------------------------------

template <int D> using Points = std::vector<Vec<D, double>>;
using Pairs = std::vector<std::array<std::uint32_t, 2>>;

/// Clusters of links as long as their ends are apart, of points that are moved meanwhile.
template <int D> detail::RigidClusters<D> clusters_of(const Points<D>& points, const Pairs& links, double scale = 1) {
    detail::RigidClusters<D> found;
    found.begin(points.size(), 1e-9);
    for (const auto& [a, b] : links) found.add_length(a, b, distance(points[a], points[b]));
    found.find([&](std::uint32_t i) { return points[i] * scale; });
    return found;
}
template <int D> double worst_length(const detail::RigidClusters<D>& found, const Points<D>& points) {
    double worst = 0;
    for (const auto& cluster : found.clusters)
        for (auto i = cluster.first; i < cluster.last; ++i)
            for (auto k = cluster.first; k < i; ++k) {
                const auto &one = found.members[i], &other = found.members[k];
                const double due = distance(points[one.particle], points[other.particle]);
                worst = std::max(worst, std::abs(distance(one.rest, other.rest) - due));
            }
    return worst;
}

const Points<2> crate = {{{0, 0}}, {{2, 0}}, {{2, 2}}, {{0, 2}}};

TEST(RigidClusters, OfACrateAreOneWithOrWithoutTheSecondDiagonal) {
    for (const auto& links :
         {Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}}, Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {1, 3}}}) {
        const auto found = clusters_of<2>(crate, links);
        ASSERT_EQ(found.clusters.size(), 1U);
        EXPECT_EQ(found.members.size(), 4U);
        EXPECT_LT(worst_length<2>(found, crate), 1e-14);
    }
}
TEST(RigidClusters, OfWhatMovesAreNone) {
    EXPECT_TRUE(clusters_of<2>(crate, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}).clusters.empty()) << "a square without braces";
    EXPECT_TRUE(clusters_of<2>(crate, {{0, 1}}).clusters.empty()) << "a rod";
    const Points<3> wings = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 1}}};
    const auto hinge = clusters_of<3>(wings, {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}});
    ASSERT_EQ(hinge.clusters.size(), 1U) << "two triangles on a hinge: the second one is left to its links";
    EXPECT_EQ(hinge.members.size(), 3U);
}
// Two crates that share a corner turn about it.
TEST(RigidClusters, ShareNoParticle) {
    const Points<2> pair = {{{0, 0}}, {{1, 0}}, {{0, 1}}, {{2, 0.5}}, {{1.5, 1}}};
    const auto found = clusters_of<2>(pair, {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {1, 4}, {3, 4}});
    ASSERT_EQ(found.clusters.size(), 1U);
    EXPECT_EQ(found.cluster_of(3), detail::RigidClusters<2>::none);
}
// A drawn outline has points in line, which lengths hold by nothing but their sum.
TEST(RigidClusters, HoldPointsInLine) {
    Points<2> ring;
    Pairs links;
    for (int side = 0; side < 4; ++side)
        for (int i = 0; i < 6; ++i) {
            const double t = i / 6.0;
            const auto &from = crate[std::size_t(side)], &to = crate[std::size_t(side + 1) % 4];
            ring.push_back(from * (1 - t) + to * t);
        }
    const auto count = std::uint32_t(ring.size());
    for (std::uint32_t i = 0; i < count; ++i)
        for (const auto step : {1U, 2U, count / 2})
            if (step < count / 2 || i < count / 2) links.push_back({i, (i + step) % count});
    const auto found = clusters_of<2>(ring, links);
    ASSERT_EQ(found.clusters.size(), 1U);
    EXPECT_EQ(found.members.size(), count);
    EXPECT_LT(worst_length<2>(found, ring), 1e-9);
}
// Lengths decide who belongs, and positions the side alone: the same numbers wherever the particles are.
TEST(RigidClusters, AreTheSameWhateverTheTime) {
    const Points<3> tetrahedron = {{{0, 0, 0}}, {{1, 0, 0}}, {{0.3, 0.8, 0}}, {{0.4, 0.2, 0.9}}, {{0.9, 0.9, 0.7}}};
    Pairs links;
    for (std::uint32_t i = 0; i < 5; ++i)
        for (std::uint32_t k = 0; k < i; ++k) links.push_back({i, k});
    const auto one = clusters_of<3>(tetrahedron, links), other = clusters_of<3>(tetrahedron, links, 1.001);
    ASSERT_EQ(one.members.size(), 5U);
    EXPECT_LT(worst_length<3>(one, tetrahedron), 1e-14);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(one.members[i].rest, other.members[i].rest);
}

// --- motion ----------------------------------------------------------------------------------------------------------

template <class Type> struct RigidCluster : ::testing::Test {};
TYPED_TEST_SUITE(RigidCluster, Everywhere, Names);

/// A braced body of unequal masses that meets others by rows of contact, and spins.
template <class World> std::vector<ParticleId> add_spinning(World& world, double speed) {
    using Real = typename World::Real;
    using Vector = typename World::Vector;
    constexpr int D = World::dimension, count = D == 2 ? 5 : 6;
    const auto figure = add_figure(world, "body");
    set_contact(world, figure, {.figures = true});
    world.figures[figure].direct = Direct::off;
    std::vector<ParticleId> ids;
    for (int i = 0; i < count; ++i) {
        Vector position{}, velocity{};
        for (int axis = 0; axis < D; ++axis)
            position[axis] = random::symmetric<Real>(1, std::uint64_t(i), std::uint64_t(axis));
        velocity[0] = -Real(speed) * position[1], velocity[1] = Real(speed) * position[0];
        if constexpr (D == 3)
            velocity[2] = Real(0.3 * speed) * position[1], velocity[1] -= Real(0.3 * speed) * position[2];
        ids.push_back(add_particle(
            world,
            {.position = position, .velocity = velocity, .mass = Real(1 + i), .radius = Real(0.01), .figure = figure}));
    }
    const auto drift = cast<Real>(momentum(world) * (2.0 / (count * (count + 1)))); // far away floats are coarse
    for (auto& velocity : world.particles.velocity) velocity -= drift;
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) add<Distance>(world, {ids[k], ids[i]}, {.figure = figure});
    world.figures[figure].particles = ids;
    return ids;
}

// Nothing acts on the body: its momentum stays, in the plane its energy too, and in space that of the method's.
TYPED_TEST(RigidCluster, SpinsForEver) {
    using World = typename TypeParam::World;
    constexpr double exact = TypeParam::precise ? 1e-9 : 5e-4; // 1440 substeps of rounding
    for (const double speed : {0.5, 5.0, 40.0}) {
        World world;
        world.settings.substeps = 8;
        add_spinning(world, speed);
        const auto before = angular_momentum(world);
        const auto energy_before = energy(world).kinetic;
        run(world, 3);
        const auto after = angular_momentum(world);
        EXPECT_LT(norm(after - before), exact * norm(before)) << speed;
        EXPECT_LT(energy(world).kinetic, energy_before * (1 + exact)) << speed;
        EXPECT_GT(energy(world).kinetic, energy_before * (1 - (World::dimension == 2 ? exact : 0.02))) << speed;
        EXPECT_LT(stretch(world).max, TypeParam::precise ? 1e-11 : 2e-6) << speed;
    }
}

/// Lowest particle of all.
template <class World> Row lowest(const World& world) {
    Row lowest = 0;
    for (Row row = 0; row < world.particles.size(); ++row)
        if (world.particles.position[row][1] < world.particles.position[lowest][1]) lowest = row;
    return lowest;
}

// A body that falls on its lowest particle is stopped there, and keeps its angular momentum about that point: the
// floor without friction has no lever.
TYPED_TEST(RigidCluster, AnswersToABlowAsABody) {
    using World = typename TypeParam::World;
    using Real = typename World::Real;
    World world;
    world.settings.substeps = 4;
    add_spinning(world, 0);
    const Row corner = lowest(world);
    const auto at = world.particles.position[corner];
    for (Row row = 0; row < world.particles.size(); ++row) {
        world.particles.position[row] -= at;
        world.particles.position[row][1] += Real(0.01);
        world.particles.velocity[row][1] = -1;
    }
    world.bounds.push_back({World::Vector::axis(1), 0, 0, 0});
    const auto momentum = [&] { return angular_momentum(world); };
    const auto before = momentum();
    step(world, Real(1e-3));
    EXPECT_LT(norm(momentum() - before), 1e-4 * norm(before)); // the contact moves on for the rest of the step
    EXPECT_NEAR(double(world.particles.velocity[corner][1]), 0, 1e-3);
    EXPECT_GT(energy(world).kinetic, 1);
}

// A tripod of equal legs carries a weight at its top: its legs push with W / (2 cos a) each, its foot pulls.
TEST(RigidClusters, TellTheTensionOfTheirLinks) {
    FlatWorld<double> world;
    add_ground<double>(world, 0, 0);
    const auto figure = add_touching(world, 0);
    std::vector<ParticleId> ids;
    for (const auto& [x, y, mass] : {std::array{-1.0, 0.1, 0.001}, {1.0, 0.1, 0.001}, {0.0, 2.1, 3.0}})
        ids.push_back(add_particle(world, {.position = {{x, y}}, .mass = mass, .radius = 0.1, .figure = figure}));
    for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}})
        add<Distance>(world, {ids[std::size_t(a)], ids[std::size_t(b)]}, {.figure = figure});
    world.figures[figure].particles = ids;
    world.settings.substeps = 16;
    run(world, 4);
    const auto& multipliers = std::get<kind_number<Distance, 2>>(world.constraints).multiplier;
    const auto tension = [&](std::size_t link) { return -multipliers[link] * square(60.0 * 16); };
    const double leg = 30 / 2.0 * std::sqrt(5.0) / 2, foot = 30 / 2.0 / 2;
    EXPECT_NEAR(tension(0), foot, 0.01 * foot);
    EXPECT_NEAR(tension(1), -leg, 0.01 * leg);
    EXPECT_NEAR(tension(2), -leg, 0.01 * leg);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
