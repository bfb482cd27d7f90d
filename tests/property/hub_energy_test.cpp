#include "sinew/math/random.h"
#include "sinew/solver/phases.h"

#include "tests/flight.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <cmath>

/// No energy from nothing in wheels that nobody drew: spokes on a hub with springs between their ends.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct HubEnergy : ::testing::Test {};
TYPED_TEST_SUITE(HubEnergy, Everywhere, Names);

double share(std::uint64_t seed, std::uint64_t counter) {
    return random::uniform(seed, counter, 0);
}
double scale(double low, double high, double share) {
    return low * std::pow(high / low, share);
}

// Rims a thousand times lighter and heavier than the hub, at random places; spun, in empty space.
TYPED_TEST(HubEnergy, NeverRisesAboveWhatWasPutIn) {
    constexpr int D = TypeParam::dimension;
    using Real = typename TypeParam::Real;
    using V = Vec<D, Real>;
    constexpr double slight = 1e-3;
    const int cases = few_or_many(12, 500);
    for (std::uint64_t seed = 1; seed <= std::uint64_t(cases); ++seed) {
        Stepped<D, Real> world;
        world.settings.substeps = share(seed, 1) < 0.5 ? 0 : int(scale(1, 65, share(seed, 2)));
        const int spokes = int(scale(3, 61, share(seed, 3)));
        const double rim = scale(1e-9, 1, share(seed, 4)), spin = 4 * share(seed, 5) - 2;
        const double light = scale(1e-3, 1, share(seed, 6));
        const auto particle = [&](const V& at, double mass) {
            const auto velocity = turned(cast<double>(at)) * spin;
            return add_particle(world, {.position = at, .velocity = cast<Real>(velocity), .mass = Real(mass)});
        };
        const auto hub = particle({}, scale(1e-3, 1, share(seed, 7)));
        ParticleId last{};
        for (int i = 0; i < spokes; ++i) {
            V at;
            for (int k = 0; k < D; ++k) at[k] = Real(0.6 * share(seed, 100 + std::uint64_t(i * D + k)) - 0.3);
            const auto end = particle(at, i % 7 == 3 ? light : 0.7);
            add<Distance>(world, {hub, end});
            if (i > 0) add<Distance>(world, {last, end}, {.compliance = Real(rim)});
            last = end;
        }
        const double begun = inner_energy(world);
        double most = 0;
        for (int i = 0; i < 120; ++i) {
            step(world, Real(1) / 60);
            most = std::max(most, inner_energy(world) - energy(world).stored);
        }
        EXPECT_LE(most, (1 + slight) * begun) << "seed " << seed << ", " << spokes << " spokes, rim " << rim
                                              << ", light " << light << ", substeps " << world.settings.substeps;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
