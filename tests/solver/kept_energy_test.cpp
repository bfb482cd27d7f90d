#include "sinew/world/environment.h"

#include "tests/crates.h"
#include "tests/dice.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <cmath>
#include <string>
#include <vector>

/// Figures in rooms without damping, friction and loss: nothing takes their energy.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct KeptEnergy : ::testing::Test {};
TYPED_TEST_SUITE(KeptEnergy, Everywhere, Names);

enum class Form { rod, triangle, chain };

/// One to three figures side by side, thrown and turning, in a room of 4 m.
template <int D, class Real> class Room {
  public:
    using Vector = Vec<D, Real>;
    Stepped<D, Real> world;

    Room(std::uint64_t seed, Form form, int substeps) : dice_(seed) {
        world.settings.substeps = substeps;
        if (dice_.below(3) > 0) fall(world, 9.81);
        set_bounds(world, at<Vector>(-2, 0) - depth(2), at<Vector>(2, 4) + depth(2), Real(1));
        const int count = 1 + dice_.below(3);
        for (int i = 0; i < count; ++i) add(form, -1.3 + 1.3 * i);
    }

  private:
    Dice dice_;

    static Vector depth(double reach) {
        Vector vector{};
        if constexpr (D == 3) vector[2] = Real(reach);
        return vector;
    }
    void add(Form form, double x) {
        const auto figure = add_figure(world, "figure" + std::to_string(world.figures.size()));
        const int count = form == Form::rod ? 2 : form == Form::triangle ? 3 : 4 + dice_.below(5);
        const double length = form == Form::chain ? dice_.between(0.15, 0.3) : dice_.between(0.2, 0.5);
        const double radius = dice_.between(0.01, 0.05), vx = dice_.between(-2, 2), vy = dice_.between(-2, 2);
        const double spin = dice_.between(-4, 4), vz = dice_.between(-1, 1), mass = dice_.scale(0.1, 10);
        Piece piece{.mark = form == Form::triangle ? Mark::loop : Mark::stroke};
        const double top = 2 + length * 0.5 * (count - 1);
        for (int i = 0; i < count; ++i) {
            const bool is_tip = form == Form::triangle && i == 2;
            const double right = is_tip ? length * 0.8 : 0, down = is_tip ? length * 0.5 : length * i;
            piece.particles.push_back(add_particle(
                world, {.position = at<Vector>(x + right, top - down),
                        .velocity = at<Vector>(vx + spin * (down + 2 - top), vy + spin * right) + depth(vz),
                        .mass = Real(mass),
                        .radius = Real(radius),
                        .figure = figure}));
        }
        link_in_turn(world, piece.particles, form == Form::triangle);
        world.figures[figure].particles = piece.particles;
        world.figures[figure].pieces.push_back(piece);
        set_contact(world, figure, {.figures = true, .friction = 0, .bounce = 1});
    }
};

/// Largest change in 20 s, as a share. The first step makes the velocities of the start fit the links.
template <int D, class Real> double worst_change(Form form, int substeps) {
    const int cases = few_or_many(12, 500);
    double worst = 0;
    for (int seed = 1; seed <= cases; ++seed) {
        auto world = Room<D, Real>(std::uint64_t(seed), form, substeps).world;
        run(world, 1.0 / 60);
        const double before = energy(world).total();
        run(world, lasting(20));
        const double change = std::abs(energy(world).total() / before - 1);
        worst = std::max(worst, change);
    }
    return worst;
}

TYPED_TEST(KeptEnergy, OfRigidFiguresInARoomStays) {
    for (const auto form : {Form::rod, Form::triangle})
        for (const int substeps : {8, 16})
            EXPECT_LT((worst_change<TypeParam::dimension, typename TypeParam::Real>(form, substeps)), 1e-3)
                << int(form) << ' ' << substeps;
}

/// Links do no work, however fast a chain whips: a tip turns by half a radian in one of 8 substeps.
TYPED_TEST(KeptEnergy, OfChainsInARoomStays) {
    EXPECT_LT((worst_change<TypeParam::dimension, typename TypeParam::Real>(Form::chain, 8)), 5e-2);
    EXPECT_LT((worst_change<TypeParam::dimension, typename TypeParam::Real>(Form::chain, 16)), 1e-3);
}

/// A pinned chain or rod that swings above a floor, and grazes it: the floor takes it from a direct block, and gives it
/// back. Largest gain in 5 s, as a share of weight times length.
template <int D, class Real> double gain_above_floor(std::uint64_t seed, int substeps) {
    Dice dice(seed);
    Stepped<D, Real> world;
    world.settings.substeps = substeps;
    fall(world, gravity);
    const int links = 1 + dice.below(5);
    const double length = dice.scale(0.1, 10), mass = dice.scale(0.1, 10), radius = 0.01 * length;
    const double height = length * dice.between(0.9, 0.999);
    const double tilt = dice.between(std::acos(height / length) + 0.05, 1.6); // it begins above the floor
    const auto figure = add_figure(world, "pendulum");
    std::vector<ParticleId> ids;
    for (int i = 0; i <= links; ++i) {
        const double way = length * i / links;
        ids.push_back(add_particle(world, {.position = at<Vec<D, Real>>(way * std::sin(tilt), -way * std::cos(tilt)),
                                           .mass = Real(mass),
                                           .radius = Real(radius),
                                           .figure = figure}));
    }
    link_in_turn(world, ids);
    world.figures[figure].particles = ids;
    pin(world, ids[0]);
    set_contact(world, figure, {.figures = true});
    world.bounds.push_back({Vec<D, Real>::axis(1), Real(-height - radius), Real(dice.below(2)), Real(dice.below(3))});
    const double begun = energy(world).total(), scale = mass * links * gravity * length;
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        step(world, Real(1.0 / 60));
        worst = std::max(worst, energy(world).total() - begun);
    }
    return worst / scale;
}
TYPED_TEST(KeptEnergy, OfPendulumsThatGrazeAFloorNeverRises) {
    for (const int substeps : {2, 4, 8, 16})
        for (int seed = 1; seed <= few_or_many(20, 3000); ++seed)
            EXPECT_LT((gain_above_floor<TypeParam::dimension, typename TypeParam::Real>(std::uint64_t(seed), substeps)),
                      1e-3)
                << substeps << ' ' << seed;
}

/// A pinned light chain with a heavy end, thrown in a room: it snaps taut, whips, strikes walls, and changes hands.
/// Largest gain in 3 s, as a share of the larger of kinetic energy and weight times length: 1 of 500 exceeds 1e-3, as
/// what each step may gain beside a wall (energy_tolerance) adds up.
template <int D, class Real> double gain_of_thrown(std::uint64_t seed, int substeps) {
    Dice dice(seed);
    Stepped<D, Real> world;
    world.settings.substeps = substeps;
    fall(world, gravity);
    const int links = 5 + dice.below(20);
    const double length = dice.scale(0.3, 10), mass = dice.scale(0.1, 10), load = mass * dice.scale(1, 100);
    const double tilt = dice.between(0.3, 6), speed = std::sqrt(gravity * length) * dice.scale(0.3, 4);
    const auto figure = add_figure(world, "chain");
    std::vector<ParticleId> ids;
    Vec<D, Real> velocity = at<Vec<D, Real>>(dice.between(-1, 1) * speed, dice.between(-1, 1) * speed);
    velocity[D - 1] += Real(dice.between(-1, 1) * speed);
    for (int i = 0; i <= links; ++i) {
        const double way = length * i / links;
        ids.push_back(add_particle(world, {.position = at<Vec<D, Real>>(way * std::sin(tilt), -way * std::cos(tilt)),
                                           .velocity = velocity,
                                           .mass = Real(i == links ? load : mass / links),
                                           .radius = Real(0.005 * length),
                                           .figure = figure}));
    }
    link_in_turn(world, ids);
    world.figures[figure].particles = ids;
    pin(world, ids[0]);
    set_contact(world, figure, {.figures = dice.below(2) > 0, .friction = dice.between(0, 1)});
    const double lowest = std::min(0.0, -length * std::cos(tilt)) - dice.between(0.02, 0.5) * length;
    world.bounds.push_back({Vec<D, Real>::axis(1), Real(lowest), Real(dice.between(0, 1)), Real(dice.between(0, 1))});
    step(world, Real(1.0 / 60)); // velocities of the start fit the links from here on
    const auto begun = energy(world);
    const double scale = std::max(begun.kinetic, (mass + load) * gravity * length);
    double worst = 0;
    for (int i = 0; i < 180; ++i) {
        step(world, Real(1.0 / 60));
        worst = std::max(worst, energy(world).total() - begun.total());
    }
    return worst / scale;
}
TYPED_TEST(KeptEnergy, OfThrownLightChainsNeverRises) {
    for (const int substeps : {1, 2, 4, 8, 16})
        for (int seed = 1; seed <= few_or_many(10, 1000); ++seed)
            EXPECT_LT((gain_of_thrown<TypeParam::dimension, typename TypeParam::Real>(std::uint64_t(seed), substeps)),
                      5e-3)
                << substeps << ' ' << seed;
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
