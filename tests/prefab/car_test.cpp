#include "sinew/prefab/steer.h"
#include "sinew/world/colliders.h"

#include "tests/worlds.h"

#include <cmath>
#include <gtest/gtest.h>

/// Laws of a car with motors, brakes and springs.
namespace sinew::SINEW_TEST_FILE {
namespace {

using World2 = test::Stepped<2, double>;
using V2 = Vec<2, double>;
constexpr double dt = 1.0 / 60, g = 9.81;

struct Racer {
    World2 world;
    Car car{};
    FigureIndex figure = no_figure;

    explicit Racer(double slope = 0, double friction = 1, V2 at = {}) {
        test::fall(world, g);
        world.bounds.push_back({{{-std::sin(slope), std::cos(slope)}}, 0, 0, friction});
        figure = build(world, car, "racer", {.at = at, .turn = slope});
    }
    ParticleId id(const char* part) const { return *world.figures[figure].particle_names.find(part); }
    V2 place(const char* part) const { return *position_of(world, id(part)); }
    V2 velocity(const char* part = "rear") const { return *velocity_of(world, id(part)); }
    double spin(const char* wheel) const { return world.particles.spin[*row_of(world, id(wheel))][0]; }
    double lean() const {
        const auto base = place("front") - place("rear");
        return std::atan2(base[1], base[0]);
    }
    void step(const Controls& controls) {
        steer(world, figure, car, controls, dt);
        test::step(world, dt);
    }
    void play(double seconds, const Controls& controls = {}) {
        for (int i = 0; i < int(std::lround(seconds / dt)); ++i) step(controls);
    }
};

/// Both motors push with 2 torque / radius, which moves the mass and turns both wheels: m + 2 I / r^2. So little that
/// no wheel slips.
TEST(Car, AcceleratesByItsTorque) {
    Racer racer;
    racer.car.torque = 40;
    racer.play(1);
    const auto& c = racer.car;
    const double from = racer.velocity()[0], push = 2 * c.torque / c.wheel_radius;
    const double rolling = c.mass + c.mass * c.wheel_share * 0.8;
    racer.play(0.5, {.along = 1});
    EXPECT_NEAR(racer.velocity()[0] - from, push / rolling * 0.5, 0.05 * push / rolling * 0.5);
}

/// Without grip it accelerates by no more than friction times gravity, and the wheels turn faster than it rolls.
TEST(Car, SpinsItsWheelsOnIce) {
    Racer racer(0, 0.1);
    racer.play(1);
    racer.play(1, {.along = 1});
    EXPECT_NEAR(racer.velocity()[0], 0.1 * g, 0.1 * g * 0.1);
    EXPECT_LT(racer.spin("rear_wheel") * racer.car.wheel_radius, -3 * racer.velocity()[0]);
}

TEST(Car, ReachesItsTopSpeedAndRollsOn) {
    Racer racer;
    racer.play(1);
    racer.play(6, {.along = 1});
    EXPECT_NEAR(racer.velocity()[0], racer.car.top_speed, 0.03 * racer.car.top_speed);
    racer.play(1);
    EXPECT_NEAR(racer.velocity()[0], racer.car.top_speed, 0.03 * racer.car.top_speed);
    EXPECT_NEAR(racer.spin("rear_wheel") * racer.car.wheel_radius, -racer.velocity()[0], 0.1);
}

/// s = v^2 / 2 mu g with wheels that do not turn; the brakes are strong enough to stop them.
TEST(Car, BrakesWithinTheWayOfFriction) {
    Racer racer;
    racer.play(1);
    racer.play(1.5, {.along = 0.5});
    const double speed = racer.velocity()[0], from = racer.place("rear")[0];
    racer.play(3, {.jump = true});
    EXPECT_NEAR(racer.velocity()[0], 0, 0.02);
    const double way = racer.place("rear")[0] - from;
    EXPECT_GT(way, 0.9 * speed * speed / (2 * g));
    EXPECT_LT(way, 1.5 * speed * speed / (2 * g));
}

/// The springs carry the body: each axle is pressed by half of its weight over the stiffness.
TEST(Car, RestsOnItsSprings) {
    Racer racer;
    const double before = racer.place("rear")[1] - racer.place("rear_wheel")[1];
    racer.play(3);
    const auto& c = racer.car;
    const double sag = before - (racer.place("rear")[1] - racer.place("rear_wheel")[1]);
    const double expected = c.mass * (1 - c.wheel_share) / 2 * g / c.stiffness;
    EXPECT_GT(sag, 0.3 * expected);
    EXPECT_LT(sag, 3 * expected);
    EXPECT_NEAR(racer.lean(), 0, 0.02);
    EXPECT_NEAR(racer.place("rear_wheel")[1], c.wheel_radius, 0.005);
}

TEST(Car, DrivesUpAHillAndHoldsOnItByItsBrakes) {
    Racer racer(0.3);
    racer.play(0.5, {.jump = true});
    const auto from = racer.place("rear");
    racer.play(2, {.jump = true});
    EXPECT_LT(norm(racer.place("rear") - from), 0.1);
    racer.play(2, {.along = 1});
    EXPECT_GT(racer.place("rear")[1] - from[1], 1);
}

/// In the air `up` turns the body, and on the ground it does not.
TEST(Car, LeansInTheAir) {
    Racer racer(0, 1, {{0, 20}});
    racer.play(0.5, {.up = 1});
    EXPECT_GT(racer.lean(), 0.2);
    Racer other;
    other.play(1);
    other.play(0.5, {.up = 1});
    EXPECT_NEAR(other.lean(), 0, 0.03);
}

/// The reaction of the torque lifts the nose.
TEST(Car, SquatsWhenItAccelerates) {
    Racer racer;
    racer.play(1);
    const double before = racer.lean();
    racer.play(0.3, {.along = 1});
    EXPECT_GT(racer.lean(), before + 0.005);
}

TEST(Car, WrongNumbersDoNoHarm) {
    Racer racer;
    for (const double wrong : {std::nan(""), 1e300, -1e300, double(INFINITY)}) {
        racer.play(0.2, {.along = wrong, .up = wrong});
        EXPECT_TRUE(is_finite(racer.place("rear"))) << wrong;
    }
    steer(racer.world, no_figure, racer.car, {}, dt);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
