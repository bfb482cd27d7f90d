#include "sinew/prefab/prefabs.h"

#include "tests/sanitized.h"
#include "tests/stepped.h"
#include "tests/worlds.h"

#include <cmath>

/// The accuracy that docs/measured/accuracy.md states, under its conditions. All bounds are the documented ones.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

/// T = 2 pi sqrt(L/g) / agm(1, cos(a/2)): the complete elliptic integral by the arithmetic-geometric mean.
double exact_period(double g, double amplitude) {
    double a = 1, b = std::cos(amplitude / 2);
    for (int i = 0; i < 30; ++i) {
        const double mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    return 2 * pi<double> / std::sqrt(g) / a;
}

/// The times at which a measure passes zero, each by linear interpolation.
class Crossings {
  public:
    explicit Crossings(double first) : before_(first) {}

    void at(double time, double step, double now) {
        if ((before_ > 0) != (now > 0)) times_.push_back(time - step * now / (now - before_));
        before_ = now;
    }
    std::size_t count() const { return times_.size(); }
    /// Mean over all whole periods.
    double period() const {
        const auto half_periods = (times_.size() - 1) / 2 * 2;
        return (times_[half_periods] - times_[0]) / double(half_periods / 2);
    }

  private:
    double before_;
    std::vector<double> times_;
};

/// The relative error of the mean of ten periods, a pendulum of 1 m released at the amplitude.
template <class Real> double period_error(double g, double amplitude, double rate, int substeps) {
    test::Stepped<2, Real> world;
    world.settings.substeps = substeps;
    fall(world, g);
    const auto pivot = add_particle(world, {.mass = std::numeric_limits<Real>::infinity()});
    const auto bob = add_particle(world, {.position = at<Vec2<Real>>(std::sin(amplitude), -std::cos(amplitude))});
    add<Distance>(world, {pivot, bob}, {.limits = exactly(Real(1))});
    Crossings crossings(double((*position_of(world, bob))[0]));
    for (int i = 1; crossings.count() < 21; ++i) {
        step(world, Real(1 / rate));
        crossings.at(i / rate, 1 / rate, double((*position_of(world, bob))[0]));
    }
    return std::abs(crossings.period() / exact_period(g, amplitude) - 1);
}

struct Swing {
    double amplitude, in_float, in_double;
};

void expect_periods(std::initializer_list<Swing> swings, double rate, int substeps) {
    for (const double g : {10.0, 1.62})
        for (const auto& [amplitude, in_float, in_double] : swings) {
            EXPECT_LT(period_error<float>(g, amplitude, rate, substeps), in_float) << amplitude << " rad, g " << g;
            EXPECT_LT(period_error<double>(g, amplitude, rate, substeps), in_double) << amplitude << " rad, g " << g;
        }
}

TEST(Accuracy, OfAPendulumsPeriodByItsSwing) {
    if (sanitized) return;
    expect_periods({{0.3, 1e-6, 1e-8}, {0.9, 2e-5, 1e-8}, {1.3, 1e-4, 1e-8}, {2.8, 1e-3, 1e-8}}, 240, 64);
    expect_periods({{0.3, 1e-6, 2e-6}, {0.9, 1e-5, 2e-6}, {2, 1e-5, 2e-6}, {2.8, 1e-4, 2e-6}}, 60, 0);
}

/// The amplitude that an undamped spring of that angular frequency, drawn out by 1 m, has left.
double amplitude_left(double frequency, int substeps, double seconds, Direct direct) {
    test::Stepped<2, double> world;
    world.settings.substeps = substeps;
    const auto figure = add_figure(world, "spring");
    world.figures[figure].direct = direct;
    const auto wall = add_particle(world, {.mass = std::numeric_limits<double>::infinity(), .figure = figure});
    const auto bob = add_particle(world, {.position = {2, 0}, .figure = figure});
    add<Distance>(world, {wall, bob},
                  {.limits = exactly(1.0), .compliance = 1 / (frequency * frequency), .figure = figure});
    run(world, seconds);
    double left = 0;
    for (double time = 0; time < 2 * pi<double> / frequency; time += 1.0 / 600) {
        step(world, 1.0 / 600);
        left = std::max(left, std::abs((*position_of(world, bob))[0] - 1));
    }
    return left;
}

// Backward Euler: a free oscillation of angular frequency w decays at w^2 h / 2 where the spring is swept, at half of
// that where it is solved directly.
TEST(Accuracy, OfAnUndampedSpringIsBackwardEulersDecay) {
    constexpr double seconds = 5;
    for (const double frequency : {3.0, 10.0, 18.0})
        for (const int substeps : {16, 64}) {
            const double decay = frequency * frequency / 60 / substeps / 2 * seconds;
            EXPECT_GT(amplitude_left(frequency, substeps, seconds, Direct::off), 0.97 * std::exp(-decay)) << frequency;
            EXPECT_GT(amplitude_left(frequency, substeps, seconds, Direct::on), 0.97 * std::exp(-decay / 2))
                << frequency;
        }
}

/// A rigid lattice of triangles, one square cell wide and some long, that hangs from the middle of its upper edge.
struct Lattice {
    test::Stepped<2, double> world;
    ParticleId left{}, right{}; ///< its lowest corners
    double length = 0;
    double inertia = 0, moment = 0; ///< about the pivot

    Lattice(int cells, Direct direct, double angle) {
        constexpr double side = 0.1;
        fall(world, gravity);
        const auto figure = add_figure(world, "lattice");
        world.figures[figure].direct = direct;
        length = side * cells;
        std::vector<ParticleId> p;
        const auto turned = [&](double x, double y) {
            return Vec2<double>{std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y};
        };
        for (int i = 0; i <= cells; ++i)
            for (const double x : {-side / 2, side / 2}) {
                p.push_back(add_particle(world, {.position = turned(x, -i * side), .figure = figure}));
                inertia += square(x) + square(i * side);
                moment += i * side;
            }
        const auto pivot = add_particle(world, {.figure = figure});
        pin(world, pivot);
        const auto link = [&](ParticleId a, ParticleId b) { add<Distance>(world, {a, b}, {.figure = figure}); };
        for (std::size_t i = 0; i + 1 < p.size(); i += 2) link(p[i], p[i + 1]);
        for (std::size_t i = 0; i + 3 < p.size(); i += 2)
            link(p[i], p[i + 2]), link(p[i + 1], p[i + 3]), link(p[i], p[i + 3]);
        for (std::size_t i = 0; i < 4; ++i) link(pivot, p[i]);
        left = p[p.size() - 2];
        right = p.back();
    }

    double turn() const {
        const auto middle = (*position_of(world, left) + *position_of(world, right)) * 0.5;
        return std::atan2(middle[0], -middle[1]);
    }
    /// For small swings, to the square of the amplitude.
    double period(double amplitude) const {
        return 2 * pi<double> * std::sqrt(inertia / (moment * gravity)) * (1 + square(amplitude) / 16);
    }
};

double lattice_error(int cells, Direct direct, int substeps) {
    constexpr double amplitude = 0.1;
    Lattice lattice(cells, direct, amplitude);
    lattice.world.settings.substeps = substeps;
    Crossings crossings(lattice.turn());
    for (int i = 1; i <= 60 * 20; ++i) {
        step(lattice.world, 1.0 / 60);
        crossings.at(i / 60.0, 1.0 / 60, lattice.turn());
    }
    return std::abs(crossings.period() / lattice.period(amplitude) - 1);
}

TEST(Accuracy, OfACompoundPendulumsPeriod) {
    if (sanitized) return;
    for (const int cells : {1, 4, 10}) {
        EXPECT_LT(lattice_error(cells, Direct::automatic, 0), 5e-4) << cells;
        EXPECT_LT(lattice_error(cells, Direct::automatic, 16), 1e-5) << cells;
        EXPECT_LT(lattice_error(cells, Direct::off, 16), 1e-3) << cells;
    }
}

/// The most energy gained in 20 s, as a share of that of the swing.
double lattice_gain(int cells, Direct direct, int substeps) {
    constexpr double amplitude = 0.1;
    Lattice lattice(cells, direct, amplitude);
    lattice.world.settings.substeps = substeps;
    const double begun = energy(lattice.world).total(), swing = lattice.moment * gravity * (1 - std::cos(amplitude));
    double gain = 0;
    for (int i = 0; i < 60 * 20; ++i) {
        step(lattice.world, 1.0 / 60);
        gain = std::max(gain, energy(lattice.world).total() - begun);
    }
    return gain / swing;
}

TEST(Accuracy, OfTheEnergyOfARigidLattice) {
    if (sanitized) return;
    for (const int cells : {1, 4, 10}) {
        for (const int substeps : {0, 1, 16})
            EXPECT_LT(lattice_gain(cells, Direct::automatic, substeps), 1e-3) << cells;
        EXPECT_LT(lattice_gain(cells, Direct::off, 16), 1e-3) << cells;
    }
}

/// The share of its angular momentum that a free cloth has left, spinning in its plane.
double spin_left(double rate, int substeps, double seconds) {
    test::Stepped<3, double> world;
    world.settings.substeps = substeps;
    build(world, Cloth{.columns = 16, .rows = 16, .pins = "none"}, "cloth");
    const auto center = center_of_mass(world);
    for (Row row = 0; row < world.particles.size(); ++row) {
        const auto arm = world.particles.position[row] - center;
        world.particles.velocity[row] = {-rate * arm[2], 0, rate * arm[0]};
    }
    step(world, 1.0 / 60);
    const auto begun = angular_momentum(world);
    run(world, seconds);
    return dot(angular_momentum(world), begun) / dot(begun, begun);
}

// A mesh is corrected along the directions at the end of a substep, which takes w^2 h of its spin a second.
TEST(Accuracy, OfTheSpinOfAFreeClothThatIsSwept) {
    constexpr double seconds = 10;
    for (const double rate : {0.3, 1.0}) {
        const double decay = rate * rate / 60 / 16 * seconds;
        EXPECT_GT(spin_left(rate, 16, seconds), 1 - 1.1 * decay) << rate;
        EXPECT_LT(spin_left(rate, 16, seconds), 1 + 1e-6) << rate;
    }
}

template <class Type> struct AccuracyOf : ::testing::Test {};
TYPED_TEST_SUITE(AccuracyOf, Everywhere, Names);

/// Extremes of a figure in some seconds at the default settings. Energy is a share of its weight times its length.
struct Reached {
    double energy = 0, stretch = 0;
};

template <class World> Reached reached(World& world, double seconds, double scale) {
    using Real = typename World::Real;
    const double begun = energy(world).total();
    Reached max;
    for (int i = 0; i < int((sanitized ? 0.2 : seconds) * 60); ++i) {
        step(world, Real(1.0 / 60));
        max.energy = std::max(max.energy, std::abs(energy(world).total() - begun) / scale);
        max.stretch = std::max(max.stretch, stretch(world).max);
    }
    return max;
}

TYPED_TEST(AccuracyOf, TheEnergyOfRodsThatSwing) {
    for (const int links : {2, 20}) {
        typename TypeParam::World world;
        fall(world, gravity);
        build(world, Rope{.length = 10, .segments = links, .angle = 0.9, .mass = double(links), .links = "exact"},
              "rope");
        EXPECT_LT(reached(world, 30, links * gravity * 10).energy, 1e-6) << links;
    }
}

TYPED_TEST(AccuracyOf, TheLengthOfARopeWhateverHangsOnIt) {
    constexpr int links = 100;
    for (const double weight : {1.0, 1000.0, 100000.0})
        for (const double angle : {0.0, 0.9}) {
            typename TypeParam::World world;
            fall(world, gravity);
            build(world, Rope{.length = 10, .segments = links, .angle = angle, .mass = links, .weight = weight},
                  "rope");
            EXPECT_LT(reached(world, 3, 1).stretch, TypeParam::precise ? 1e-5 : 1e-4) << weight << " from " << angle;
        }
}

template <int D, class Real> void expect_ragdoll_keeps_its_energy(double part) {
    constexpr double tall = 1.6, mass = 70;
    for (const double turn : {0.9, -0.9}) {
        test::Stepped<D, Real> world;
        fall(world, gravity);
        build(world, Ragdoll{.height = tall, .mass = mass}, "bob", {.turn = turn});
        pin(world, *find_particle(world, "bob/left_hand"));
        EXPECT_LT(reached(world, 30, mass * gravity * tall).energy, part) << turn;
    }
}

TEST(Accuracy, OfTheEnergyOfARagdollOnOneHandInThePlane) {
    expect_ragdoll_keeps_its_energy<2, float>(1e-5);
    expect_ragdoll_keeps_its_energy<2, double>(1e-5);
}

TEST(Accuracy, OfTheEnergyOfARagdollOnOneHandInSpace) {
    expect_ragdoll_keeps_its_energy<3, float>(2e-4);
    expect_ragdoll_keeps_its_energy<3, double>(2e-4);
}

/// A rope of 20 links of 0.1 m, so many times a link's mass in its middle, let go straight from an angle; in space, its
/// tail is pushed out of the plane.
template <int D> test::Stepped<D, double> bead_in_a_rope(double times, double angle) {
    constexpr int links = 20;
    test::Stepped<D, double> world;
    fall(world, gravity);
    const auto down = at<Vec<D, double>>(0.1 * std::sin(angle), -0.1 * std::cos(angle));
    std::vector<ParticleId> p;
    for (int i = 0; i <= links; ++i)
        p.push_back(add_particle(world, {.position = down * i, .mass = i == links / 2 ? 0.01 * times : 0.01}));
    pin(world, p[0]);
    if constexpr (D == 3) set_velocity(world, p[links - 1], Vec<3, double>::axis(2) * 1e-3);
    for (std::size_t i = 0; i < links; ++i)
        add<Distance>(world, {p[i], p[i + 1]}, {.limits = between(0.0, norm(down))});
    return world;
}

/// All energy of the tail may go where its links snap taut.
template <int D> void expect_bead_keeps_its_energy(double times, double angle) {
    auto world = bead_in_a_rope<D>(times, angle);
    const double begun = energy(world).total(), weight_times_length = 0.01 * times * gravity;
    for (int i = 0; i < 240; ++i) {
        const auto before = world.particles.position;
        step(world, 1.0 / 60);
        EXPECT_NE(before, world.particles.position) << times << ", step " << i;
        EXPECT_LE(energy(world).total() - begun, 1e-6 * weight_times_length) << times << ", step " << i;
    }
    EXPECT_GT(energy(world).total() - begun, -(1e-4 + 10 / times) * weight_times_length) << times << ", " << angle;
}

TEST(Accuracy, OfTheEnergyOfAHeavyBeadInARopeWithALightTail) {
    for (const double times : {9e4, 4e5, 5e7})
        for (const double angle : {0.9, 1.5}) {
            expect_bead_keeps_its_energy<2>(times, angle);
            expect_bead_keeps_its_energy<3>(times, angle);
        }
}

/// The worst a link or a range is too long or too short, while a ragdoll falls on a floor and lies there.
template <class Real> double stretch_of_a_fall(double damping, double turn) {
    test::Stepped<3, Real> world;
    fall(world, gravity);
    build(world, Ragdoll{.height = 1.6, .mass = 70}, "bob", {.turn = Real(turn)});
    world.bounds.push_back({{0, 1, 0}, Real(-2), Real(0.2), Real(0.5)});
    world.settings.damping = Real(damping);
    return reached(world, 5, 1).stretch;
}

TEST(Accuracy, OfTheLengthsOfARagdollThatFallsInSpace) {
    for (const double turn : {0.4, 1.5, 3.0}) {
        EXPECT_LT(stretch_of_a_fall<double>(1, turn), 1e-4) << turn;
        EXPECT_LT(stretch_of_a_fall<float>(1, turn), 1e-4) << turn;
        EXPECT_LT(stretch_of_a_fall<double>(0, turn), 2e-3) << turn;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
