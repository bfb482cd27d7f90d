#include "sinew/world/measure.h"

#include "tests/stepped.h"
#include "tests/worlds.h"

#include <cmath>

/// Winches, pulleys and motors: solved at once, and in a sweep.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

using Position = Vec2<double>;

struct Solved {
    Direct direct;
    double accuracy; ///< of what is held, as a fraction
};
constexpr Solved ways[] = {{Direct::on, 1e-9}, {Direct::off, 2e-3}};

test::Stepped<2, double> made(Direct direct) {
    test::Stepped<2, double> world;
    fall(world, gravity);
    world.figures[add_figure(world, "figure")].direct = direct;
    return world;
}

ParticleId particle(test::Stepped<2, double>& world, double x, double y, double mass = 1) {
    return add_particle(world, {.position = at<Position>(x, y), .mass = mass, .figure = 0});
}
ParticleId nail(test::Stepped<2, double>& world, double x, double y) {
    const auto id = particle(world, x, y);
    pin(world, id);
    return id;
}

double height_of(const World<2, double>& world, ParticleId id) {
    return (*position_of(world, id))[1];
}

/// A weight on a winch by way of a hook.
struct Hoist {
    test::Stepped<2, double> world;
    ParticleId load;
    ConstraintId winch;

    Hoist(Direct direct, double mass, double max_force) : world(made(direct)) {
        const auto drum = nail(world, 0, 10), hook = particle(world, 0, 6, direct == Direct::on ? 0.5 : 50);
        load = particle(world, 0, 2, mass);
        winch = *add<Distance>(world, {drum, hook}, {.limits = at_most(4.0), .max_force = max_force, .figure = 0});
        add<Distance>(world, {hook, load}, {.limits = at_most(4.0), .figure = 0});
    }
};

TEST(Winch, LiftsAWeightAtItsSpeed) {
    for (const auto& [direct, accuracy] : ways) {
        Hoist hoist(direct, 500, 1e5);
        drive(hoist.world, hoist.winch, -0.5);
        run(hoist.world, 3);
        EXPECT_NEAR(height_of(hoist.world, hoist.load), 2 + 0.5 * 3, 0.01);
        EXPECT_NEAR((*velocity_of(hoist.world, hoist.load))[1], 0.5, 0.02);
        drive(hoist.world, hoist.winch, 0.0); // it flies on, and falls into the rope
        run(hoist.world, 1);
        EXPECT_NEAR(height_of(hoist.world, hoist.load), 3.5, 0.01);
        EXPECT_LT(max_speed(hoist.world), 5e-3);
        drive(hoist.world, hoist.winch, 1.0);
        run(hoist.world, 2);
        EXPECT_NEAR(height_of(hoist.world, hoist.load), 1.5, 0.01);
        EXPECT_NEAR((*velocity_of(hoist.world, hoist.load))[1], -1, 0.02);
    }
}

// 500 kg weigh 4905 N, and the hook at most 490 N. What is too heavy stays on the ground, pulled at with all the winch
// has.
TEST(Winch, StallsAtItsForceLimit) {
    for (const auto& [direct, accuracy] : ways) {
        for (const double max : {4900.0, 8000.0}) {
            Hoist hoist(direct, 500, max);
            hoist.world.bounds.push_back({at<Position>(0, 1), 2.0});
            drive(hoist.world, hoist.winch, -0.5);
            run(hoist.world, 3);
            if (max < 4905) {
                EXPECT_NEAR(height_of(hoist.world, hoist.load), 2, 1e-3);
                EXPECT_NEAR(constraint_state(hoist.world, hoist.winch)->tension / max, 1, 1e-3);
            } else {
                EXPECT_NEAR((*velocity_of(hoist.world, hoist.load))[1], 0.5, 0.05);
            }
        }
    }
}

// Above its limit the rope runs out as if braked with that force:  a = g - F/m.
TEST(Winch, SlipsWithTheForceItHas) {
    for (const auto& [direct, accuracy] : ways) {
        Hoist hoist(direct, 100, 500);
        run(hoist.world, 1);
        const double moved = total_mass(hoist.world) - 1; // without the drum
        EXPECT_NEAR(2 - height_of(hoist.world, hoist.load), (gravity - 500 / moved) / 2, 0.05) << int(direct);
        EXPECT_NEAR(constraint_state(hoist.world, hoist.winch)->tension, 500, 0.5);
    }
}

// Atwood's machine: a = g (m1 - m2) / (m1 + m2), and the rope is as long as ever.
TEST(Pulley, AtwoodsMachineFallsAsItShould) {
    for (const auto& [direct, accuracy] : ways) {
        auto world = made(direct);
        const auto wheel = nail(world, 0, 10);
        const auto heavy = particle(world, 0, 5, 3), light = particle(world, 0, 5, 2);
        const auto rope = *add<Pulley>(world, {heavy, wheel, light}, {.figure = 0});
        run(world, 1);
        const double a = gravity / 5;
        EXPECT_NEAR(5 - height_of(world, heavy), a / 2, direct == Direct::off ? 0.02 : 1e-6);
        EXPECT_NEAR(height_of(world, light) - 5, a / 2, direct == Direct::off ? 0.02 : 1e-6);
        EXPECT_NEAR(constraint_state(world, rope)->measure, 10, 10 * accuracy);
        EXPECT_NEAR(constraint_state(world, rope)->tension, 2 * 2 * 3 / 5.0 * gravity, 0.05); // 2 m1 m2 g / (m1 + m2)
    }
}

// A block hangs in the bight of a rope: half its weight holds it, and it moves half as fast.
TEST(Pulley, ATackleOfTwoPartsHoldsTwiceTheWeight) {
    for (const auto& [direct, accuracy] : ways) {
        auto world = made(direct);
        const auto eye = nail(world, 0, 10), wheel = nail(world, 0, 10);
        const auto block = particle(world, 0, 4, 40), hand = particle(world, 0, 4, 20);
        add<Pulley>(world, {eye, block, wheel, hand}, {.figure = 0});
        run(world, 1);
        EXPECT_NEAR(height_of(world, block), 4, 0.01);
        set_velocity(world, hand, at<Position>(0, -1));
        set_velocity(world, block, at<Position>(0, 0.5));
        run(world, 1);
        EXPECT_NEAR(height_of(world, hand), 3, 0.03);
        EXPECT_NEAR(height_of(world, block), 4.5, 0.03);
    }
}

// Two unequal weights that swing on one rope exchange energy, and lose none.
TEST(Pulley, ASwingOverAWheelKeepsItsEnergy) {
    auto world = made(Direct::on);
    const auto wheel = nail(world, 0, 10);
    const auto a = particle(world, -3, 8, 1), b = particle(world, 0.1, 5, 1.2);
    add<Pulley>(world, {a, wheel, b}, {.figure = 0});
    const double begun = energy(world).total(), scale = 2.2 * gravity * 10;
    for (int i = 0; i < 120; ++i) {
        step(world, 1.0 / 60);
        EXPECT_NEAR(energy(world).total(), begun, 1e-6 * scale);
    }
}

/// An arm of 1 m, level, with 10 kg at its end: 98.1 N m.
struct Arm {
    test::Stepped<2, double> world;
    ParticleId load;

    Arm(Direct direct, const ConstraintSpec<double>& motor, ConstraintId* id = nullptr) : world(made(direct)) {
        const auto a = nail(world, -1, 0), b = nail(world, 0, 0);
        load = particle(world, 1, 0, 10);
        add<Distance>(world, {b, load}, {.figure = 0});
        const auto added = add<Angle>(world, {a, b, load}, motor);
        if (id) *id = *added;
    }
};

TEST(Motor, HoldsAWeightBelowItsTorqueAndGivesWayAbove) {
    for (const auto& [direct, accuracy] : ways) {
        Arm strong(direct, {.limits = exactly(0.0), .max_force = 99, .figure = 0});
        run(strong.world, 3);
        EXPECT_NEAR(height_of(strong.world, strong.load), 0, 1e-3);
        Arm weak(direct, {.limits = exactly(0.0), .max_force = 97, .figure = 0});
        run(weak.world, 3);
        EXPECT_LT(height_of(weak.world, weak.load), -0.01);
        Arm limp(direct, {.limits = exactly(0.0), .max_force = 0, .figure = 0});
        run(limp.world, 0.4);
        EXPECT_LT(height_of(limp.world, limp.load), -0.5);
    }
}

// With a spring's softness and a lead it comes to rest where the spring holds the weight: torque / stiffness off.
TEST(Motor, TurnsToItsPoseAndRests) {
    for (const auto& [direct, accuracy] : ways) {
        ConstraintId motor;
        Arm arm(direct,
                {.limits = exactly(0.0), .compliance = 1e-4, .max_force = 400, .damping_time = 0.1, .figure = 0},
                &motor);
        drive(arm.world, motor, pi<double> / 4);
        run(arm.world, 1);
        drive(arm.world, motor, 0.0);
        run(arm.world, 3);
        const double torque = 10 * gravity * std::cos(pi<double> / 4);
        EXPECT_NEAR(constraint_state(arm.world, motor)->measure, pi<double> / 4 - torque * 1e-4, 1e-4);
        EXPECT_LT(max_speed(arm.world), 1e-3);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
