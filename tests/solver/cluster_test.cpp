#include "tests/worlds.h"

#include <cmath>
#include <vector>

/// Particles that more links than needed hold together: one rigid body where figures touch.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Clusters : ::testing::Test {};
TYPED_TEST_SUITE(Clusters, Everywhere, Names);

/// D + 2 particles at unequal places with unequal masses, all linked to each other. With `tail` a rod of two links hangs
/// on the second one. A figure that touches itself is held by rows of contact wherever it is.
template <class World> std::vector<ParticleId> add_body(World& world, double rate, bool tail) {
    constexpr int D = World::dimension;
    using Real = typename World::Real;
    const auto figure = add_figure(world, "body");
    set_contact(world, figure, {.figures = true, .itself = true});
    std::vector<ParticleId> ids;
    const auto add_at = [&](const Vec<D, double>& position, double mass) {
        Vec<D, double> velocity{};
        velocity[0] = -rate * position[1], velocity[1] = rate * position[0];
        ids.push_back(add_particle(world, {.position = cast<Real>(position),
                                           .velocity = cast<Real>(velocity),
                                           .mass = Real(mass),
                                           .figure = figure}));
    };
    const auto link = [&](std::size_t a, std::size_t b) { add<Distance>(world, {ids[a], ids[b]}, {.figure = figure}); };
    for (int i = 0; i < D + 2; ++i)
        add_at(Vec<D, double>::map([&](int k) { return std::cos(2.1 * i + 1.3 * k + 0.4 * i * k); }), 1 + 0.3 * i);
    for (std::size_t a = 0; a < ids.size(); ++a)
        for (std::size_t b = a + 1; b < ids.size(); ++b) link(a, b);
    if (tail) {
        for (const double away : {0.5, 1.1}) {
            auto position = cast<double>(*position_of(world, ids[1]));
            position[0] += away;
            add_at(position, 0.4);
        }
        link(1, ids.size() - 2), link(ids.size() - 2, ids.size() - 1);
    }
    world.figures[figure].particles = ids;
    return ids;
}

/// Spins keep to rounding: the momenta are those of the particles. The energy does where the body turns about one axis;
/// in space the axis wanders, by the second order of a substep's angle.
TYPED_TEST(Clusters, ABodyThatSpinsKeepsItsSpinAndItsShape) {
    using World = typename TypeParam::World;
    for (const double rate : {0.5, 10.0, 60.0}) {
        World world;
        add_body(world, rate, false);
        const double spin = angular_momentum(world)[2], kinetic = energy(world).kinetic;
        run(world, 1);
        const double exact = TypeParam::precise ? 1e-9 : 2e-4;
        EXPECT_NEAR(angular_momentum(world)[2], spin, exact * spin) << rate;
        const double wander = World::dimension == 2 ? 0 : 0.3 * square(rate / 960);
        EXPECT_NEAR(energy(world).kinetic, kinetic, (exact + wander) * kinetic) << rate;
        EXPECT_LT(stretch(world).max, TypeParam::precise ? 1e-9 : 5e-6) << rate;
    }
}

/// So does one on which links hang.
TYPED_TEST(Clusters, LinksOnABodyKeepTheirLengths) {
    using World = typename TypeParam::World;
    for (const double rate : {0.5, 8.0}) {
        World world;
        add_body(world, rate, true);
        const auto begun = momentum(world);
        const double spin = angular_momentum(world)[2], kinetic = energy(world).kinetic;
        run(world, 1);
        const double exact = TypeParam::precise ? 1e-9 : 2e-4;
        EXPECT_NEAR(angular_momentum(world)[2], spin, 1e-3 * spin) << rate; // arms of a substep
        EXPECT_LT(norm(momentum(world) - begun), exact * norm(begun) + exact);
        EXPECT_LE(energy(world).kinetic, kinetic * (1 + exact));
        EXPECT_GT(energy(world).kinetic, kinetic * 0.99) << rate;
        EXPECT_LT(stretch(world).max, TypeParam::precise ? 1e-9 : 1e-5) << rate;
    }
}

/// A body falls as its particles do, whatever hangs on it.
TYPED_TEST(Clusters, ABodyFallsAsAParticleDoes) {
    using World = typename TypeParam::World;
    World world;
    fall(world, 10);
    add_body(world, 3, true);
    const auto begun = center_of_mass(world);
    run(world, 1);
    const double due = 5; // and half a substep's fall more: 10 h / 2
    EXPECT_NEAR(begun[1] - center_of_mass(world)[1], due, 0.01);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
