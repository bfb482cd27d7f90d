#include "sinew/world/measure.h"

#include "tests/prefab/make.h"
#include "tests/stepped.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <cmath>

/// Figures at rest move again when something works on them.
namespace sinew::SINEW_TEST_FILE {
namespace {

constexpr std::size_t ground = 2;                          ///< its number among the walls
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
        for (const auto& position : world.particles.position)
            size = std::max(size, double(norm(position - center_of_mass_now())));
        if (size == 0) size = double(world.particles.radius[0]);
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
    /// True for an end of a link: the ends of a rail hold nothing along the rail.
    bool is_linked(Row row) const {
        const auto& links = std::get<kind_number<Distance, D>>(world.constraints).members.rows;
        return std::any_of(links.begin(), links.end(),
                           [&](const auto& ends) { return ends[0] == row || ends[1] == row; });
    }
    ParticleId id(Row row) const { return world.particles.handles.id_of(row); }
    std::string where(std::string_view prefab, Row row) const {
        return std::string(prefab) + " in " + std::to_string(D) + "D, particle " + std::to_string(row);
    }

    /// A place in the room that is so far away in one of sixteen directions.
    Vector predicted(Row row, int direction) const {
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

/// Calls check(prefab) with what can lie on a floor, in every world it exists in: what hangs together, not the ships of
/// a formation.
template <class In, class Check> void for_every_lying(Check&& check) {
    Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) {
        if constexpr (Prefab::dimensions.include(In::dimension)) {
            const Prefab prefab;
            if (prefab.sizes().particles < 150 && Prefab::name != Formation::name) check(prefab);
        }
    });
}

template <class Type> struct Rest : ::testing::Test {};
TYPED_TEST_SUITE(Rest, test::Everywhere, test::Names);

// A pulled particle comes, or the hand pulls with its maximum force and the figure gives way as far as its joints
// allow.
TYPED_TEST(Rest, WhatLiesComesWhenItIsPulled) {
    using Real = typename TypeParam::Real;
    const int every = one_of(41);
    int number = 0;
    for_every_lying<TypeParam>([&](const auto& prefab) {
        const Lying<TypeParam> lying(prefab, 0.4);
        for (Row row = 0; row < lying.world.particles.size(); ++row)
            for (int direction = 0; direction < 16; ++direction) {
                if (number++ % every != 0) continue;
                auto world = lying.world;
                const auto goal = lying.predicted(row, direction);
                const Real max = Real(strength * g * lying.mass);
                move_pin(world, *pin(world, lying.id(row), {.max_force = max}), goal);
                bool stands = true;
                for (int i = 0; i < 30; ++i) {
                    const auto before = world.particles.position;
                    step(world, Real(1.0 / 60));
                    stands = stands && before == world.particles.position;
                }
                const double left = double(distance(world.particles.position[row], goal));
                const double force = double(norm(world.pins.back().multiplier)) / square(double(world.last_substep));
                EXPECT_TRUE(left <= 1e-2 * lying.size || (force >= 0.99 * double(max) && !stands))
                    << lying.where(prefab.name, row) << ", direction " << direction << ": " << left / lying.size
                    << " sizes away, force " << force / double(max) << (stands ? ", stands still" : "");
            }
    });
}

template <class World> double height(const World& world) {
    return center_of_mass(world)[1];
}

// m a = F - m g + N, and a floor only pushes.
TYPED_TEST(Rest, WhatIsPushedUpRises) {
    using Real = typename TypeParam::Real;
    const int every = one_of(11), steps = 15;
    int number = 0;
    for_every_lying<TypeParam>([&](const auto& prefab) {
        const Lying<TypeParam> lying(prefab, 0.4);
        for (Row row = 0; row < lying.world.particles.size(); ++row) {
            if (number++ % every != 0) continue;
            auto world = lying.world;
            world.settings.damping = 0;
            std::swap(world.bounds.front(), world.bounds[ground]);
            world.bounds.resize(1);
            const double before = height(world), time = steps / 60.0;
            for (int i = 0; i < steps; ++i) {
                apply_force(world, lying.id(row), test::at<typename TypeParam::Vector>(0, 3 * g * lying.mass));
                step(world, Real(1.0 / 60));
            }
            EXPECT_GT(height(world) - before, 0.98 * g * square(time)) << lying.where(prefab.name, row);
        }
    });
}

TYPED_TEST(Rest, WhatLiesRisesWhenGravityTurnsRound) {
    for_every_lying<TypeParam>([&](const auto& prefab) {
        auto world = Lying<TypeParam>(prefab, 0.4).world;
        world.settings.damping = 0;
        world.forces.clear();
        test::fall(world, -g);
        const double before = height(world), time = 0.1;
        test::run(world, time);
        EXPECT_GT(height(world) - before, 0.48 * g * square(time)) << prefab.name;
    });
}

TYPED_TEST(Rest, WhatLiesFallsWhenItsFloorIsTakenAway) {
    for_every_lying<TypeParam>([&](const auto& prefab) {
        auto world = Lying<TypeParam>(prefab, 0.4).world;
        world.settings.damping = 0;
        world.bounds.clear();
        const double before = height(world), time = 0.5;
        test::run(world, time);
        EXPECT_NEAR((before - height(world)) / (0.5 * g * square(time)), 1, 0.02) << prefab.name;
    });
}

// A hard pin is where it is told to be, and what hangs on it comes along.
TYPED_TEST(Rest, WhatHangsComesAlongWithItsPin) {
    using Real = typename TypeParam::Real;
    const int every = one_of(17);
    int number = 0;
    for_every_lying<TypeParam>([&](const auto& prefab) {
        const Lying<TypeParam> lying(prefab, 0.4);
        for (Row row = 0; row < lying.world.particles.size(); ++row) {
            if (number++ % every != 0 || !lying.is_linked(row)) continue;
            auto world = lying.world;
            world.bounds.clear();
            const auto held = *pin(world, lying.id(row));
            test::run(world, 6);
            const auto from = world.particles.position[row];
            const auto way = TypeParam::Vector::axis(0) * Real(4 * lying.size);
            const double before = center_of_mass(world)[0];
            for (int i = 1; i <= 60; ++i) {
                move_pin(world, held, from + way * (Real(i) / 60));
                step(world, Real(1.0 / 60));
            }
            EXPECT_LE(double(distance(world.particles.position[row], from + way)), 1e-4 * lying.size)
                << lying.where(prefab.name, row);
            EXPECT_GT(center_of_mass(world)[0] - before, lying.size) << lying.where(prefab.name, row);
        }
    });
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
