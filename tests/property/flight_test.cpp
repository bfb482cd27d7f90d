#include "tests/flight.h"
#include "tests/thorough.h"

#include <cmath>

/// Free flight: a figure that nothing holds or touches has a motion of its own, and gravity and the velocity of the
/// whole are no part of it.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <int D> double parted(const World<D, double>& one, const World<D, double>& other) {
    const auto from = center_of_mass(one), other_from = center_of_mass(other);
    double max = 0;
    for (Row row = 0; row < one.particles.size(); ++row)
        max = std::max(max, norm((one.particles.position[row] - from) - (other.particles.position[row] - other_from)));
    return max;
}

// The equations of the places about the centre do not contain its velocity: neither does a damping that slows every
// particle at the same rate. Later rounding parts the two, the faster the more joints come to their ends.
TEST(FreeFlight, WhatHappensInsideDoesNotDependOnTheVelocityOfTheWhole) {
    for_every_figure([]<int D>(const auto& prefab) {
        for (const double damping : {0.0, 0.5}) {
            Flight<D> still(prefab, Vec<D, double>{}, damping), flying(prefab, thrown<D>(), damping);
            if (still.world.particles.size() < 2) return; // nothing inside
            still.fly(lasting(0.25));
            flying.fly(lasting(0.25));
            EXPECT_LE(parted(still.world, flying.world), 1e-9 * still.size()) << prefab.name << " in " << D << "D";
        }
    });
}

TEST(FreeFlight, KeepsTheSpinOfWhatIsSolvedAtOnce) {
    for_every_figure([]<int D>(const auto& prefab) {
        Flight<D> flight(prefab, thrown<D>(), 0);
        const auto begun = flight.spin();
        flight.fly(lasting(5));
        if (!flight.direct() || flight.world.particles.size() == 0) return;
        EXPECT_LE(norm(flight.spin() - begun), 1e-9 * norm(begun)) << prefab.name << " in " << D << "D";
    });
}

// Slack links that snap taut, and springs, take energy; that is told.
TEST(FreeFlight, KeepsTheEnergyOfWhatIsSolvedAtOnceOrTellsItLost) {
    for_every_figure([]<int D>(const auto& prefab) {
        Flight<D> flight(prefab, thrown<D>(), 0);
        const double begun = inner_energy(flight.world);
        flight.fly(lasting(5));
        if (!flight.direct() || flight.world.particles.size() == 0) return;
        const double left = inner_energy(flight.world);
        EXPECT_LE(left, (1 + 1e-5) * begun) << prefab.name << " in " << D << "D";
        EXPECT_NEAR(left + energy(flight.world).lost, begun, 1e-3 * begun) << prefab.name << " in " << D << "D";
    });
}

/// The share of its energy that a thrown ragdoll has gained or lost in so many seconds.
template <int D> double drift_of_a_ragdoll(double seconds) {
    Flight<D> flight(Ragdoll{}, thrown<D>(), 0);
    const double begun = inner_energy(flight.world);
    flight.fly(seconds);
    EXPECT_TRUE(flight.direct());
    return std::abs(inner_energy(flight.world) / begun - 1);
}

TEST(FreeFlight, KeepsTheEnergyOfARagdoll) {
    EXPECT_LE(drift_of_a_ragdoll<2>(lasting(10)), 1e-6);
    EXPECT_LE(drift_of_a_ragdoll<3>(lasting(10)), 1e-5);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
