#include "sinew/solver/phases.h"

#include "tests/any_figure.h"
#include "tests/flight.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

/// No energy from nothing: kinetic plus potential energy of any figure never rises above what was put in, whatever its
/// parameters, swept or solved directly, kicked, spun, dropped on a floor.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

/// One figure or two of a kind, with any parameters, in motion.
template <int D, class Real> struct Thrown {
    Stepped<D, Real> world;
    Dice dice;
    std::string told;
    double size = 0;
    bool is_there = false, is_supported = false;

    template <class Prefab> Thrown(std::uint64_t seed, std::type_identity<Prefab>, int max_count) : dice(seed) {
        constexpr std::size_t max_particles = 400;
        Prefab prefab;
        if (!draw(prefab, dice, D, max_count)) return;
        std::ostringstream text;
        text << description_of(prefab);
        world.settings.substeps = dice.one_of(2) ? 0 : int(dice.scale(1, 65));
        world.settings.iterations = dice.one_of(2) ? 1 : 1 + dice.below(8);
        world.forces.push_back(Gravity<D, Real>{Vec<D, Real>::axis(1) * Real(-gravity)});
        build(world, prefab, "it", Placement<D, Real>{});
        if (world.particles.size() < 2 || world.particles.size() > max_particles) return;
        measure();
        const bool pair = dice.one_of(4), floor = dice.one_of(2);
        if (pair) build(world, prefab, "other", Placement<D, Real>{.at = at<Vec<D, Real>>(1.5 * size, 0.2 * size)});
        const auto direct = dice.one_of(2) ? Direct::off : Direct::automatic;
        for (auto& figure : world.figures) figure.direct = direct;
        const bool held = !pair && dice.one_of(4);
        if (!held)
            while (!world.pins.empty()) unpin_all(world, world.pins[0].particle);
        is_supported = floor || !world.pins.empty();
        Real lowest = std::numeric_limits<Real>::max();
        for (Row row = 0; row < world.particles.size(); ++row)
            lowest = std::min(lowest, world.particles.position[row][1] - world.particles.radius[row]);
        if (floor)
            world.bounds.push_back({at<Vec<D, Real>>(0, 1), lowest - Real(dice.between(0.1, 1) * size), 0,
                                    Real(dice.one_of(2) ? 0 : dice.between(0, 1))});
        const double unit = std::sqrt(gravity * size);
        // A tenth of a radian in a substep: directions turn between the ends of a faster one.
        const double fastest = 0.1 * 60 * (world.settings.substeps > 0 ? world.settings.substeps : usual_substeps);
        const double spin = dice.one_of(2) ? 0 : std::clamp(dice.between(-5, 5) * unit / size, -fastest, fastest);
        const double approach = pair ? dice.between(0, 4) * unit : 0;
        for (Row row = 0; row < world.particles.size(); ++row) {
            const bool first = world.particles.figure[row] == 0;
            auto arm = cast<double>(world.particles.position[row]);
            if (!first) arm[0] -= 1.5 * size;
            auto velocity = held ? Vec<D, double>{} : turned(arm) * spin;
            velocity[0] += first ? approach : -approach;
            set_velocity(world, world.particles.handles.id_of(row), cast<Real>(velocity));
        }
        if (dice.one_of(2)) { // kick of one particle
            const auto row = Row(dice.below(int(world.particles.size())));
            if (world.particles.mobility[row] > 0)
                set_velocity(world, world.particles.handles.id_of(row),
                             world.particles.velocity[row] + at<Vec<D, Real>>(dice.between(-3, 3) * unit, unit));
        }
        text << (pair ? ", a pair" : "") << (floor ? ", floor" : "") << (held ? ", held" : "")
             << (direct == Direct::off ? ", swept" : "") << ", substeps " << world.settings.substeps << ", iterations "
             << world.settings.iterations << ", spin " << spin << ", particles " << world.particles.size();
        told = text.str();
        is_there = !sinew::any_driven(static_cast<World<D, Real>&>(world));
    }

    void measure() {
        Vec<D, double> low, high;
        for (int i = 0; i < D; ++i) low[i] = 1e30, high[i] = -1e30;
        for (Row row = 0; row < world.particles.size(); ++row)
            for (int i = 0; i < D; ++i) {
                const double x = double(world.particles.position[row][i]), r = double(world.particles.radius[row]);
                low[i] = std::min(low[i], x - r), high[i] = std::max(high[i], x + r);
            }
        size = norm(high - low);
    }

    /// Kinetic plus potential energy; of what nothing supports, about its centre of mass: it falls by many times its
    /// size, and a float's rounding of that is more than a thousandth of its weight times size.
    double outside(const sinew::Energy& now) const {
        if (is_supported) return now.kinetic + now.potential;
        const auto whole = momentum(world);
        return now.kinetic - 0.5 * dot(whole, whole) / total_mass(world);
    }
    /// Largest rise of it above what was put in, in kinetic energy or weight times size.
    double gain(int steps) {
        const auto begun = energy(world);
        double mass = 0;
        for (Row row = 0; row < world.particles.size(); ++row)
            if (world.particles.mobility[row] > 0) mass += 1 / double(world.particles.inverse_mass[row]);
        const double scale = std::max(begun.kinetic + begun.stored, mass * gravity * size);
        const double put_in = outside(begun) + begun.stored;
        double worst = 0;
        for (int i = 0; i < steps; ++i) {
            step(world, Real(1) / 60);
            const double rise = (outside(energy(world)) - put_in) / scale;
            if (!(rise < worst)) worst = rise;
            if (!(worst < 1e3)) break;
        }
        return worst;
    }
};

template <class Type> struct Energy : ::testing::Test {};
TYPED_TEST_SUITE(Energy, Everywhere, Names);

TYPED_TEST(Energy, NeverRisesAboveWhatWasPutIn) {
    constexpr int D = TypeParam::dimension;
    using Real = typename TypeParam::Real;
    constexpr double slight = 1e-3;
    const int cases = few_or_many(1, 250), max_count = is_thorough() ? 200 : 40, steps = is_thorough() ? 180 : 60;
    Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab> type) {
        if constexpr (Prefab::dimensions.include(D)) {
            for (int seed = 1; seed <= cases; ++seed) {
                Thrown<D, Real> thrown(std::uint64_t(seed), type, max_count);
                if (thrown.is_there) {
                    EXPECT_LE(thrown.gain(steps), slight) << "seed " << seed << ": " << thrown.told;
                }
            }
        }
    });
}

// Spokes of two ropes on a hub, with springs between their ends: loops thousands of times lighter than what they hang
// on.
TYPED_TEST(Energy, OfLightLoopsOnAHeavyHubIsKept) {
    constexpr int D = TypeParam::dimension;
    using Real = typename TypeParam::Real;
    using V = Vec<D, Real>;
    for (const double ratio : {1e2, 2e4, 1e6})
        for (const double compliance : {1e-7, 5e-6, 1e-4})
            for (const int substeps : {1, 0}) {
                Stepped<D, Real> world;
                world.settings.substeps = substeps;
                const auto particle = [&](double x, double y, double mass, double speed) {
                    return add_particle(world,
                                        {.position = at<V>(x, y), .velocity = at<V>(speed, -1), .mass = Real(mass)});
                };
                const auto hub = particle(0, 0, 16 * ratio, 0), a = particle(0.8, 0.6, 16, 0.1),
                           b = particle(0.6, 0.8, 16, -0.1), c = particle(-0.6, 0.8, 16, 0.05);
                for (const auto end : {a, c}) add<Distance>(world, {hub, end});
                add<Distance>(world, {a, b}, {.compliance = Real(compliance)});
                add<Distance>(world, {b, c}, {.compliance = Real(10 * compliance)});
                const double begun = inner_energy(world);
                for (int i = 0; i < 60; ++i) {
                    step(world, Real(1) / 60);
                    ASSERT_LE(inner_energy(world), 1.001 * begun + 1e-9 * energy(world).kinetic)
                        << ratio << " " << compliance;
                }
            }
}

// Bends far stiffer than the pieces are heavy: one that shortened through zero within a substep would come out half a
// turn away.
TYPED_TEST(Energy, OfAStiffRopeThatFoldsIsKept) {
    constexpr int D = TypeParam::dimension;
    using Real = typename TypeParam::Real;
    for (const double stiffness : {17.6458, 60.0})
        for (const int segments : {91, 147}) {
            const Rope rope{.length = 0.489,
                            .segments = segments,
                            .slack = 0.176,
                            .pinned = "none",
                            .mass = 7.5,
                            .weight = 0.0088,
                            .bend_stiffness = stiffness,
                            .thickness = 0.009};
            Stepped<D, Real> world;
            build(world, rope, "rope", Placement<D, Real>{});
            for (Row row = 0; row < world.particles.size(); ++row) {
                const auto arm = cast<double>(world.particles.position[row]);
                set_velocity(world, world.particles.handles.id_of(row), cast<Real>(turned(arm) * 17.0));
            }
            const double begun = inner_energy(world);
            for (int i = 0; i < 120; ++i) {
                step(world, Real(1) / 60);
                ASSERT_LE(inner_energy(world), 1.001 * begun)
                    << stiffness << " N m^2, " << segments << " segments, step " << i;
            }
        }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
