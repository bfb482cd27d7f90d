#include "sinew/world/environment.h"

#include "tests/crates.h"
#include "tests/worlds.h"

#include <cmath>
#include <vector>

/// Blows between figures that rebound.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Blow : ::testing::Test {};
TYPED_TEST_SUITE(Blow, Everywhere, Names);

template <class World> FigureIndex add_bouncy(World& world, double bounce) {
    const auto figure = add_figure(world, "ball");
    set_contact(world, figure, {.figures = true, .friction = 0, .bounce = bounce});
    return figure;
}
template <class World> struct Ball {
    double x = 0, y = 0, mass = 1, speed = 0, bounce = 1;

    ParticleId add_to(World& world) const {
        using Real = typename World::Real;
        using Vector = Vec<World::dimension, Real>;
        const auto figure = add_bouncy(world, bounce);
        const auto id = add_particle(world, {.position = at<Vector>(x, y),
                                             .velocity = at<Vector>(speed, 0),
                                             .mass = Real(mass),
                                             .radius = Real(0.1),
                                             .figure = figure});
        world.figures[figure].particles = {id};
        return id;
    }
};
template <class World> double along(const World& world, ParticleId id) {
    return double((*velocity_of(world, id))[0]);
}

// Newton's law: the speed of separation is e times that of approach, whatever the masses.
TYPED_TEST(Blow, TwoBallsPartAtTheirRestitution) {
    using World = typename TypeParam::World;
    constexpr double tolerance = sizeof(typename World::Real) == 4 ? 1e-4 : 1e-9;
    for (const double e : {0.3, 0.7, 1.0})
        for (const double mass : {1.0, 10.0, 1000.0})
            for (const double other : {0.0, e}) { // the larger restitution counts
                World world;
                const auto striker = Ball<World>{.speed = 2, .bounce = e}.add_to(world);
                const auto struck = Ball<World>{.x = 0.5, .mass = mass, .bounce = other}.add_to(world);
                run(world, 0.5);
                const double a = along(world, striker), b = along(world, struck);
                EXPECT_NEAR(b - a, 2 * e, 2 * tolerance) << e << " " << mass;
                EXPECT_NEAR(a + mass * b, 2, 2 * tolerance * mass) << e << " " << mass;
            }
}

/// Balls side by side on rods; `out` of them begin at the height of their rods' upper ends.
template <class World> std::vector<ParticleId> add_cradle(World& world, int balls, int out) {
    using Real = typename World::Real;
    using Vector = Vec<World::dimension, Real>;
    fall(world, 9.81);
    std::vector<ParticleId> ids;
    for (int i = 0; i < balls; ++i) {
        const double x = 0.2 * i, angle = i < out ? pi<double> / 4 : 0;
        const auto figure = add_bouncy(world, 1);
        const auto hook = add_particle(world, {.position = at<Vector>(x, 0), .figure = figure});
        pin(world, hook);
        ids.push_back(add_particle(
            world,
            {.position = at<Vector>(x - std::sin(angle), -std::cos(angle)), .radius = Real(0.1), .figure = figure}));
        world.figures[figure].particles = {hook, ids.back()};
        world.figures[figure].pieces.push_back({.mark = Mark::stroke, .particles = {hook, ids.back()}});
        add<Distance>(world, {hook, ids.back()}, {.figure = figure});
    }
    return ids;
}

// As many balls leave a row as have struck it, as high as those fell from; the others stay.
TYPED_TEST(Blow, ARowOfBallsPassesABlowOn) {
    using World = typename TypeParam::World;
    for (const int out : {1, 2, 3}) {
        World world;
        const auto balls = add_cradle(world, 5, out);
        std::vector<double> furthest(5, 0);
        for (int i = 0; i < 66; ++i) { // 1.1 s: half a period is 1.04
            step(world, typename World::Real(1.0 / 60));
            for (std::size_t k = std::size_t(out); k < 5; ++k)
                furthest[k] =
                    std::max(furthest[k], std::abs(double((*position_of(world, balls[k]))[0]) - 0.2 * double(k)));
        }
        for (std::size_t k = std::size_t(out); k < 5; ++k) {
            const double due = k < 5 - std::size_t(out) ? 0 : std::sin(pi<double> / 4);
            EXPECT_NEAR(furthest[k], due, 0.01) << out << " " << k;
        }
    }
}

// Balls that meet each other and the walls of a room keep their energy, and without walls their momentum.
TYPED_TEST(Blow, BilliardBallsKeepTheirEnergy) {
    using World = typename TypeParam::World;
    using Real = typename World::Real;
    for (const bool has_room : {true, false}) {
        World world;
        const auto corner = Vec<World::dimension, Real>::map([](int) { return Real(1); });
        if (has_room) set_bounds(world, -corner, corner, Real(1));
        std::vector<ParticleId> ids{Ball<World>{.x = -0.8, .y = 0.03, .speed = 3}.add_to(world)};
        for (int row = 0; row < 3; ++row)
            for (int i = 0; i <= row; ++i)
                ids.push_back(Ball<World>{.x = 0.19 * row, .y = 0.22 * (i - 0.5 * row)}.add_to(world));
        const double begun = energy(world).kinetic;
        run(world, 3);
        EXPECT_NEAR(energy(world).kinetic, begun, 1e-3 * begun) << has_room;
        if (has_room) continue;
        double momentum = 0;
        for (const auto id : ids) momentum += along(world, id);
        EXPECT_NEAR(momentum, 3, 1e-4);
    }
}

// Crates rebound as wholes: two corners of one strike another at once.
TEST(BlowOfCrates, TwoCratesPartAtTheirRestitution) {
    for (const double e : {0.5, 1.0}) {
        FlatWorld<double> world;
        std::vector<ParticleId> first;
        for (const double x : {0.0, 1.0}) {
            const auto corners = add_crate(world, x, 0, 0.5, 1);
            set_contact(world, world.particles.figure[0], {.figures = true, .friction = 0, .bounce = e});
            for (const auto id : corners) set_velocity(world, id, {{x == 0 ? 2.0 : 0.0, 0}});
            first.push_back(corners[0]);
        }
        run(world, 1);
        EXPECT_NEAR(along(world, first[1]) - along(world, first[0]), 2 * e, 0.02 * e) << e;
        EXPECT_NEAR(along(world, first[1]) + along(world, first[0]), 2, 1e-6) << e;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
