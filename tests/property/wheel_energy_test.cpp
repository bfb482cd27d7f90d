#include "sinew/math/random.h"
#include "sinew/world/colliders.h"

#include "tests/flight.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <algorithm>
#include <cmath>
#include <sstream>

/// No energy from nothing in wheels that the sweep solves badly: light hubs with stiff spokes, heavy rims, an area. A
/// rim's tension needs many more iterations than it gets, and the wheel grows to a multiple of its size.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

class Wheels {
  public:
    Wheels(std::uint64_t seed, double precision) : seed_(seed), precision_(precision) {}

    template <int D, class Real> void add(Stepped<D, Real>& world, const Vec<D, double>& center, double speed) {
        const int spokes = int(scale(3, 40));
        const double spin = 20 * share() - 10, size = scale(0.1, 2);
        const double spoke = share() < 0.3 ? 0 : scale(1e-8, 1e-3), rim = share() < 0.5 ? 0 : scale(1e-7, 1);
        const double tire = scale(0.1, 10), hub = tire * scale(precision_, 100);
        const auto figure = add_figure(world, "wheel");
        const auto particle = [&](const Vec<D, double>& arm, double mass) {
            const auto velocity = turned(arm) * spin + Vec<D, double>::axis(0) * speed;
            return add_particle(world, {.position = cast<Real>(center + arm),
                                        .velocity = cast<Real>(velocity),
                                        .mass = Real(mass),
                                        .radius = Real(0.02 * size),
                                        .figure = figure});
        };
        const auto link = [&](ParticleId a, ParticleId b, double compliance) {
            sinew::add<Distance>(world, {a, b}, {.compliance = Real(compliance), .figure = figure});
        };
        const auto middle = particle({}, hub);
        std::vector<ParticleId> ends;
        for (int i = 0; i < spokes; ++i) {
            const double angle = 2 * 3.14159265358979 * i / spokes, arm = size * (0.8 + 0.2 * share());
            Vec<D, double> at{};
            at[0] = arm * std::cos(angle), at[1] = arm * std::sin(angle);
            if constexpr (D == 3) at[2] = 0.1 * size * share();
            ends.push_back(particle(at, tire));
            link(middle, ends.back(), spoke);
        }
        for (int i = 0; i < spokes && rim > 0; ++i)
            link(ends[std::size_t(i)], ends[std::size_t((i + 1) % spokes)], rim);
        if constexpr (D == 2)
            add_constraint(world, kind_number<Area, D>, std::span<const ParticleId>(ends),
                           {.compliance = Real(scale(1e-6, 1)), .figure = figure});
        set_contact(world, figure, {.figures = true});
        world.figures[figure].direct = Direct::off;
        told << spokes << " spokes of " << spoke << ", rim " << rim << ", hub " << hub << " kg, tire " << tire
             << " kg, spin " << spin << "; ";
    }
    double share() { return random::uniform(seed_, next_++, 0); }
    double scale(double low, double high) { return low * std::pow(high / low, share()); }

    std::ostringstream told;

  private:
    std::uint64_t seed_, next_ = 0;
    double precision_;
};

template <class Type> struct WheelEnergy : ::testing::Test {
    static constexpr double slight = 1e-3; ///< of what was put in

    static void hold(int count, std::uint64_t seed) {
        constexpr int D = Type::dimension;
        using Real = typename Type::Real;
        Stepped<D, Real> world;
        Wheels wheels(seed, 1e-4);
        world.settings.substeps = wheels.share() < 0.5 ? 0 : int(wheels.scale(1, 65));
        world.settings.iterations = wheels.share() < 0.5 ? 1 : int(wheels.scale(1, 9));
        for (int i = 0; i < count; ++i)
            wheels.add(world, Vec<D, double>::axis(0) * (4.2 * i), count > 1 ? 10 - 20 * i : 0);
        const double begun = energy(world).kinetic;
        double most = 0;
        for (int i = 0; i < 120; ++i) {
            step(world, Real(1) / 60);
            most = std::max(most, energy(world).kinetic);
        }
        EXPECT_LE(most, (1 + slight) * begun)
            << "seed " << seed << ", " << wheels.told.str() << "substeps " << world.settings.substeps << ", iterations "
            << world.settings.iterations;
    }
};
TYPED_TEST_SUITE(WheelEnergy, Everywhere, Names);

TYPED_TEST(WheelEnergy, NeverRisesInEmptySpace) {
    for (int seed = 1; seed <= few_or_many(12, 500); ++seed) TestFixture::hold(1, std::uint64_t(seed));
}

TYPED_TEST(WheelEnergy, NeverRisesWhereWheelsMeet) {
    for (int seed = 1; seed <= few_or_many(6, 300); ++seed) TestFixture::hold(2, std::uint64_t(seed));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
