#include "sinew/solver/measure.h"

#include "tests/prefab/make.h"
#include "tests/stepped.h"
#include "tests/thorough.h"

#include <cmath>

/// Free flight: a figure that nothing holds or touches has a motion of its own, and gravity and the velocity of the
/// whole are no part of it.
namespace sinew::SINEW_TEST_FILE {
namespace {

constexpr double turning = 3; ///< rad/s

Vec3<double> moment(const Vec2<double>& arm, const Vec2<double>& momentum) {
    return {{0, 0, cross(arm, momentum)}};
}
Vec3<double> moment(const Vec3<double>& arm, const Vec3<double>& momentum) {
    return cross(arm, momentum);
}
Vec2<double> turned(const Vec2<double>& arm) {
    return {{-arm[1], arm[0]}};
}
Vec3<double> turned(const Vec3<double>& arm) {
    return cross(Vec3<double>{{0.36, 0.48, 0.8}}, arm);
}

template <int D> Vec<D, double> thrown() {
    Vec<D, double> velocity;
    for (int i = 0; i < D; ++i) velocity[i] = 5 - 2.5 * i;
    return velocity;
}

template <int D> struct Flight {
    test::Stepped<D, double> world;

    Flight(const AnyPrefab& prefab, const Vec<D, double>& velocity, double damping) {
        build(world, prefab, "it", Placement<D, double>{});
        while (!world.pins.empty()) unpin_all(world, world.pins[0].particle);
        world.forces.push_back(Gravity<D, double>{Vec<D, double>::axis(1) * -9.81});
        world.settings.damping = damping;
        const auto center = center_of_mass(world);
        for (Row row = 0; row < world.particles.size(); ++row)
            set_velocity(world, world.particles.slots.id_of(row),
                         velocity + turned(world.particles.position[row] - center) * turning);
    }
    bool direct() const {
        const auto& in_block = world.particles.in_block;
        return std::all_of(in_block.begin(), in_block.end(), [](char in) { return in != 0; });
    }
    /// Angular momentum about the centre.
    Vec3<double> spin() const { return angular_momentum(world) - moment(center_of_mass(world), momentum(world)); }
    double size() const {
        double most = 0;
        for (const auto& place : world.particles.position)
            most = std::max(most, distance(place, center_of_mass(world)));
        return most;
    }
    void fly(double seconds) {
        for (int i = 0; i < int(seconds * 60); ++i) step(world, 1.0 / 60);
    }
};

/// Calls check(prefab) with every prefab in every dimension it exists in.
template <class Check> void for_every_figure(Check&& check) {
    Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) {
        if constexpr (Prefab::dimensions.include(2)) check.template operator()<2>(Prefab{});
        if constexpr (Prefab::dimensions.include(3)) check.template operator()<3>(Prefab{});
    });
}

template <int D> double parted(const World<D, double>& one, const World<D, double>& other) {
    const auto from = center_of_mass(one), other_from = center_of_mass(other);
    double most = 0;
    for (Row row = 0; row < one.particles.size(); ++row)
        most =
            std::max(most, norm((one.particles.position[row] - from) - (other.particles.position[row] - other_from)));
    return most;
}

/// Kinetic energy about the centre, and what springs hold.
template <int D> double inner_energy(const World<D, double>& world) {
    const auto whole = momentum(world);
    return energy(world).kinetic - 0.5 * dot(whole, whole) / total_mass(world) + energy(world).stored;
}

// The equations of the places about the centre do not contain its velocity: neither does a damping that slows every
// particle at the same rate. Later rounding parts the two, the faster the more joints come to their ends.
TEST(FreeFlight, WhatHappensInsideDoesNotDependOnTheVelocityOfTheWhole) {
    for_every_figure([]<int D>(const auto& prefab) {
        for (const double damping : {0.0, 0.5}) {
            Flight<D> still(prefab, Vec<D, double>{}, damping), flying(prefab, thrown<D>(), damping);
            if (still.world.particles.size() == 0) return;
            still.fly(lasting(0.25));
            flying.fly(lasting(0.25));
            EXPECT_LE(parted(still.world, flying.world), 1e-8 * still.size()) << prefab.name << " in " << D << "D";
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
