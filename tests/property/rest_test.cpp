#include "sinew/solver/measure.h"
#include "sinew/solver/step.h"

#include "tests/prefab/make.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <cmath>

/// Figures at rest move again when something works on them.
namespace sinew {
namespace {

constexpr double g = 9.81, friction = 0.5, strength = 100; ///< strength: a hand's force over the weight it holds

/// A figure that has fallen into a room and lies there.
template <class In> struct Lying {
    static constexpr int D = In::dimension;
    using Real = typename In::Real;
    using Vector = typename In::Vector;
    using Spot = Vec<D, double>;
    typename In::World world;
    double size = 0, mass = 0;

    template <class Prefab> explicit Lying(const Prefab& prefab, double turn) {
        build(world, prefab, "it", Placement<D, Real>{.turn = turn});
        while (!world.pins.empty()) unpin_all(world, world.pins[0].particle);
        for (const auto& place : world.particles.position)
            size = std::max(size, double(norm(place - center_of_mass_now())));
        mass = total_mass(world);
        test::fall(world, g);
        for (int i = 0; i < D; ++i)
            for (const int side : {-1, 1}) wall(i, side, i == 1 && side < 0 ? 1.2 : 2);
        world.settings.damping = 1;
        for (int i = 0; i < 12 * 60 && !(i > 60 && max_speed(world) < 1e-3 * size); ++i) step(world, Real(1.0 / 60));
    }
    void wall(int axis, int side, double sizes) {
        const auto normal = Vector::axis(axis) * Real(-side);
        world.bounds.push_back(
            {normal, Real(dot(normal, center_of_mass_now())) - Real(sizes * size), Real(0), Real(friction)});
    }
    Vector center_of_mass_now() const { return cast<Real>(center_of_mass(world)); }
    ParticleId id(Row row) const { return world.particles.slots.id_of(row); }
    std::string where(std::string_view prefab, Row row) const {
        return std::string(prefab) + " in " + std::to_string(D) + "D, particle " + std::to_string(row);
    }

    /// A place in the room that is so far away in one of sixteen directions.
    Vector aim(Row row, int direction) const {
        const double angle = 2 * pi<double> * direction / 16;
        Spot way = on_screen<D>(std::cos(angle), std::sin(angle));
        if (D == 3) way[D - 1] = 0.5 * std::cos(3 * angle);
        auto goal = world.particles.position[row] + cast<Real>(way * size);
        for (const auto& plane : world.bounds)
            goal +=
                plane.normal * std::max(Real(0), plane.offset + world.particles.radius[row] - dot(plane.normal, goal));
        return goal;
    }
};

/// Calls check(prefab) with what can lie on a floor, in every world it exists in.
template <class In, class Check> void for_every_lying(Check&& check) {
    Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) {
        if constexpr (Prefab::dimensions.include(In::dimension)) {
            const Prefab prefab;
            if (prefab.sizes().particles < 150) check(prefab);
        }
    });
}

template <class Type> struct Rest : ::testing::Test {};
TYPED_TEST_SUITE(Rest, test::Everywhere, test::Names);

// A pulled particle comes, or the hand pulls with its maximum force and the figure gives way as far as its joints allow.
TYPED_TEST(Rest, WhatLiesComesWhenItIsPulled) {
    using Real = typename TypeParam::Real;
    const int every = few_or_many(23, 1);
    int number = 0;
    for_every_lying<TypeParam>([&](const auto& prefab) {
        const Lying<TypeParam> lying(prefab, 0.4);
        for (Row row = 0; row < lying.world.particles.size(); ++row)
            for (int direction = 0; direction < 16; ++direction) {
                if (number++ % every != 0) continue;
                auto world = lying.world;
                const auto goal = lying.aim(row, direction);
                const Real most = Real(strength * g * lying.mass);
                move_pin(world, *pin(world, lying.id(row), {.max_force = most}), goal);
                bool stands = true;
                for (int i = 0; i < 30; ++i) {
                    const auto before = world.particles.position;
                    step(world, Real(1.0 / 60));
                    stands = stands && before == world.particles.position;
                }
                const double left = double(distance(world.particles.position[row], goal));
                const double force = double(norm(world.pins.back().multiplier)) / square(double(world.last_substep));
                EXPECT_TRUE(left <= 1e-2 * lying.size || (force >= 0.99 * double(most) && !stands))
                    << lying.where(prefab.name, row) << ", direction " << direction << ": " << left / lying.size
                    << " sizes away, force " << force / double(most) << (stands ? ", stands still" : "");
            }
    });
}

} // namespace
} // namespace sinew
