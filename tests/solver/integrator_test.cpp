#include "tests/stepped.h"
#include "tests/worlds.h"

#include <cmath>
#include <numbers>

/// The integrators of classic mode against exact and discrete answers.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

using World2 = test::Stepped<2, double>;

constexpr Integrator every[] = {Integrator::verlet, Integrator::explicit_euler, Integrator::symplectic_euler,
                                Integrator::velocity_verlet, Integrator::rk4};

std::string name_of(Integrator integrator) {
    return std::string(integrator_names[std::size_t(integrator)]);
}

/// Steps of length h; `previous` is then where a particle was one step ago.
World2 world_of(Integrator integrator, double h) {
    World2 world;
    world.settings.mode = Mode::classic;
    world.settings.frame = h;
    world.settings.classic.integrator = integrator;
    return world;
}

/// A spring of w = 1 towards the origin: so soft an attractor is one to 1e-12.
constexpr Attractor<2, double> spring{.strength = 1e18, .softness = 1e6};
constexpr double of_the_spring = 1e-11;

/// On the spring at (1, 0), at rest but for Verlet, which is given the place it has one step before.
World2 oscillator(Integrator integrator, double h) {
    auto world = world_of(integrator, h);
    world.forces = {spring};
    if (integrator == Integrator::verlet)
        add_particle(world, {.position = {1, 0}, .previous = Vec2<double>{1 - h * h / 2, 0}});
    else
        add_particle(world, {.position = {1, 0}});
    return world;
}

double x_of(const World2& world) {
    return world.particles.position[0][0];
}
double v_of(const World2& world) {
    return world.particles.velocity[0][0];
}

/// v^2 + x^2
double twice_energy(const World2& world) {
    return v_of(world) * v_of(world) + x_of(world) * x_of(world);
}

// (x, v) is multiplied by (1, h; -h, 1), whose square is 1 + h^2: energy grows by that in every step.
TEST(Integrator, ExplicitEulerGainsEnergyInEveryStep) {
    const double h = 0.1;
    auto world = oscillator(Integrator::explicit_euler, h);
    for (int n = 1; n <= 200; ++n) {
        step(world, h);
        EXPECT_NEAR(twice_energy(world) / std::pow(1 + h * h, n), 1, n * of_the_spring);
    }
}

// v^2 + x^2 - h x v stays what it is, for ever, so that the energy cannot leave (1 -+ h/2) / (1 +- h/2).
TEST(Integrator, SymplecticEulerKeepsAnEnergyOfItsOwn) {
    const double h = 0.3;
    auto world = oscillator(Integrator::symplectic_euler, h);
    for (int n = 0; n < 10000; ++n) {
        step(world, h);
        EXPECT_NEAR(twice_energy(world) - h * x_of(world) * v_of(world), 1, 1e-8);
        EXPECT_LT(twice_energy(world), 1 / (1 - h / 2) + 1e-8);
        EXPECT_GT(twice_energy(world), 1 / (1 + h / 2) - 1e-8);
    }
}

// x_n = cos(n t) with sin(t/2) = h/2: the frequency is a little high, the amplitude exact.
TEST(Integrator, VerletAndVelocityVerletGoThroughTheSamePlaces) {
    const double h = 0.3, angle = 2 * std::asin(h / 2);
    for (const auto integrator : {Integrator::verlet, Integrator::velocity_verlet}) {
        auto world = oscillator(integrator, h);
        for (int n = 1; n <= 1000; ++n) {
            step(world, h);
            EXPECT_NEAR(x_of(world), std::cos(n * angle), 1e-8) << name_of(integrator) << ' ' << n;
        }
    }
}

// v^2 + x^2 (1 - h^2/4) stays what it is.
TEST(Integrator, VelocityVerletKeepsAnEnergyOfItsOwn) {
    const double h = 0.3;
    auto world = oscillator(Integrator::velocity_verlet, h);
    for (int n = 0; n < 10000; ++n) {
        step(world, h);
        EXPECT_NEAR(twice_energy(world) - x_of(world) * x_of(world) * h * h / 4, 1 - h * h / 4, 1e-8);
    }
}

// |1 + z + z^2/2 + z^3/6 + z^4/24|^2 at z = ih is 1 - h^6/72 + h^8/576: RK4 loses energy.
TEST(Integrator, Rk4LosesEnergyInEveryStep) {
    const double h = 0.5, kept = 1 - std::pow(h, 6) / 72 + std::pow(h, 8) / 576;
    auto world = oscillator(Integrator::rk4, h);
    for (int n = 1; n <= 200; ++n) {
        step(world, h);
        EXPECT_NEAR(twice_energy(world) / std::pow(kept, n), 1, n * of_the_spring);
    }
}

/// A planet on an ellipse about a sun of strength 1; a round takes 2 pi.
struct Orbit {
    static constexpr double eccentricity = 0.3;

    /// Exactly where it is at a time, by Kepler's equation; farthest from the sun at time 0.
    static Vec2<double> position(double time) {
        double anomaly = time;
        for (int i = 0; i < 50; ++i) anomaly = time - eccentricity * std::sin(anomaly); // E + e sin E = t
        const double minor = std::sqrt(1 - eccentricity * eccentricity);
        return {eccentricity + std::cos(anomaly), minor * std::sin(anomaly)};
    }
    static Vec2<double> velocity() { return {0, std::sqrt((1 - eccentricity) / (1 + eccentricity))}; }

    static World2 begun(Integrator integrator, double h) {
        auto world = world_of(integrator, h);
        world.forces = {Attractor<2, double>{.strength = 1, .softness = 1e-9}};
        if (integrator == Integrator::verlet)
            add_particle(world, {.position = position(0), .previous = position(-h)});
        else
            add_particle(world, {.position = position(0), .velocity = velocity()});
        return world;
    }

    /// How far it is from where it belongs after half a round.
    static double error(Integrator integrator, int steps) {
        const double h = std::numbers::pi / steps;
        auto world = begun(integrator, h);
        for (int i = 0; i < steps; ++i) step(world, h);
        return distance(world.particles.position[0], position(std::numbers::pi));
    }
};

// Half the step, a half, a quarter or a sixteenth of the error.
TEST(Integrator, ConvergesInItsOrder) {
    const std::pair<Integrator, double> orders[] = {{Integrator::explicit_euler, 1},
                                                    {Integrator::symplectic_euler, 1},
                                                    {Integrator::verlet, 2},
                                                    {Integrator::velocity_verlet, 2},
                                                    {Integrator::rk4, 4}};
    for (const auto& [integrator, order] : orders) {
        const int steps = order == 4 ? 100 : 1600; // beyond, RK4 reaches rounding
        const double found = std::log2(Orbit::error(integrator, steps) / Orbit::error(integrator, 2 * steps));
        EXPECT_NEAR(found, order, 0.06) << name_of(integrator);
    }
}

// Over two rounds symplectic integrators show how far their energy swings, and it never swings farther; explicit Euler
// gains without end, RK4 loses.
TEST(Integrator, SymplecticOnesKeepAPlanetForEver) {
    constexpr int a_round = 80;
    const double h = 2 * std::numbers::pi / a_round;
    for (const auto integrator : every) {
        auto world = Orbit::begun(integrator, h);
        const double begin = energy(world).total();
        double early = 0, late = 0;
        for (int i = 0; i < 100 * a_round; ++i) {
            step(world, h);
            double& swing = i < 2 * a_round ? early : late;
            swing = std::max(swing, std::abs(energy(world).total() - begin));
        }
        const bool bounded = integrator != Integrator::explicit_euler && integrator != Integrator::rk4;
        EXPECT_EQ(late < 1.1 * early, bounded) << name_of(integrator) << ' ' << early << ' ' << late;
    }
}

TEST(Integrator, SymplecticEulerIsVerletUnderAnotherName) {
    auto verlet = menagerie<2, double>(Mode::classic), euler = verlet;
    euler.settings.classic.integrator = Integrator::symplectic_euler;
    run(verlet, 1);
    run(euler, 1);
    for (Row row = 0; row < verlet.particles.size(); ++row)
        EXPECT_EQ(verlet.particles.position[row], euler.particles.position[row]);
}

// Damping keeps its share of the velocity in each step, and the length of a step may change: x_n = x_0 + sum of v h.
TEST(Integrator, DampingAndUnevenStepsAreTheSameForAll) {
    for (const auto integrator : every) {
        auto world = world_of(integrator, 1);
        world.settings.classic.keep = 0.5;
        add_particle(world, {.velocity = {8, 0}});
        double x = 0, v = 8;
        for (const double h : {1.0, 0.5, 2.0, 0.25}) {
            step(world, h);
            v *= 0.5;
            x += v * h;
            EXPECT_NEAR(v_of(world), v, 1e-12) << name_of(integrator);
            EXPECT_NEAR(x_of(world), x, 1e-12) << name_of(integrator);
        }
    }
}

// Drag alone: v = exp(-c t). Orders hold for forces that depend on the velocity, too.
TEST(Integrator, DragConvergesInItsOrder) {
    const auto error = [](Integrator integrator, int steps) {
        const double h = 1.0 / steps;
        auto world = world_of(integrator, h);
        world.forces = {Drag<2, double>{1}};
        add_particle(world, {.velocity = {1, 0}});
        for (int i = 0; i < steps; ++i) step(world, h);
        return std::abs(v_of(world) - std::exp(-1.0));
    };
    const std::pair<Integrator, double> orders[] = {
        {Integrator::explicit_euler, 1}, {Integrator::velocity_verlet, 2}, {Integrator::rk4, 4}};
    for (const auto& [integrator, order] : orders)
        EXPECT_NEAR(std::log2(error(integrator, 50) / error(integrator, 100)), order, 0.06) << name_of(integrator);
}

// What a wall gives back and what a constraint corrects comes after the free motion, whatever that is.
TEST(Integrator, WallsAndConstraintsActOnAll) {
    for (const auto integrator : every) {
        auto world = world_of(integrator, 1);
        world.settings.classic.bounce = 0.5;
        world.bounds = {{{0, 1}, 0, 0, 0}};
        add_particle(world, {.position = {0, 1}, .velocity = {3, -4}});
        step(world, 1.0);
        EXPECT_NEAR(world.particles.velocity[0][1], 2, 1e-12) << name_of(integrator);
        EXPECT_NEAR(v_of(world), 3, 1e-12) << name_of(integrator);

        auto swing = world_of(integrator, 0.1);
        fall(swing, 10);
        const auto ids = chain(swing, 2, Vec2<double>{0, 0}, Vec2<double>{1, 0});
        pin(swing, ids[0]);
        swing.settings.classic.passes = 2; // the first leaves the pinned end's half
        for (int i = 0; i < 20; ++i) step(swing, 0.1);
        EXPECT_LT(distance(*position_of(swing, ids[0]), *position_of(swing, ids[1])), 1.2) << name_of(integrator);
    }
}

TEST(Integrator, AFigureCanHaveItsOwn) {
    auto mixed = world_of(Integrator::rk4, 0.1);
    mixed.forces = {spring};
    const auto own = add_figure(mixed, "own"), other = add_figure(mixed, "other");
    mixed.figures[own].integrator = Integrator::explicit_euler;
    for (const auto figure : {own, other}) add_particle(mixed, {.position = {1, 0}, .figure = figure});
    auto euler = oscillator(Integrator::explicit_euler, 0.1), rk4 = oscillator(Integrator::rk4, 0.1);
    for (int i = 0; i < 50; ++i)
        for (auto* world : {&mixed, &euler, &rk4}) step(*world, 0.1);
    EXPECT_EQ(mixed.particles.position[0], euler.particles.position[0]);
    EXPECT_EQ(mixed.particles.position[1], rk4.particles.position[0]);
}

TEST(Attractor, CanPullOneFigureAlone) {
    for (const auto mode : {Mode::physical, Mode::classic}) {
        World2 world;
        world.settings.mode = mode;
        const auto pulled = add_figure(world, "pulled"), free = add_figure(world, "free");
        for (const auto figure : {pulled, free}) add_particle(world, {.position = {1, 0}, .figure = figure});
        world.forces = {Attractor<2, double>{.strength = 1, .softness = 0.1, .figure = pulled}};
        EXPECT_LT(energy_of(world, pulled).potential, 0);
        EXPECT_EQ(energy_of(world, free).potential, 0);
        run(world, 0.5);
        EXPECT_LT(world.particles.position[0][0], 0.95);
        EXPECT_EQ(world.particles.position[1], (Vec2<double>{1, 0}));
    }
}

TEST(Energy, OfAllIsTheSumOverFigures) {
    for (const auto mode : {Mode::physical, Mode::classic}) {
        auto world = menagerie<2, double>(mode);
        run(world, 0.5);
        double sum = energy_of(world, no_figure).total();
        for (FigureIndex i = 0; i < world.figures.size(); ++i) sum += energy_of(world, i).total();
        EXPECT_NEAR(sum, energy(world).total(), 1e-9 * std::abs(sum));
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
