#include "sinew/world/colliders.h"

#include "tests/flight.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <cmath>

/// Free flight of what is swept: cloth by default, and every other figure if it is asked for. An unfinished sweep takes
/// spin, which the step gives back.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct SweptFlight : ::testing::Test {};
TYPED_TEST_SUITE(SweptFlight, Everywhere, Names);

/// Calls check(flight, name) with every figure that exists in the world of a test, swept.
template <class Type, class Check> void for_every_swept_figure(Check&& check) {
    constexpr int D = Type::dimension;
    Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) {
        if constexpr (Prefab::dimensions.include(D)) {
            Flight<D, typename Type::Real> flight(Prefab{}, thrown<D>(), 0, Direct::off);
            if (flight.world.particles.size() > 1) check(flight, std::string(Prefab::name));
        }
    });
}

/// Float is flown less far: coordinates of what falls for a minute are rounded to millimetres.
template <class Type> double seconds() {
    return Type::precise ? few_or_many(6, 60) : 4;
}

template <class World> bool has_springs(const World& world) {
    bool found = false;
    for_each_table(world, [&](const auto& table) {
        for (Row row = 0; row < table.size(); ++row) found = found || table.compliance[row] > 0;
    });
    return found;
}

TYPED_TEST(SweptFlight, KeepsItsSpin) {
    for_every_swept_figure<TypeParam>([](auto& flight, const std::string& name) {
        const auto begun = flight.spin();
        flight.fly(seconds<TypeParam>());
        EXPECT_LE(norm(flight.spin() - begun), (TypeParam::precise ? 1e-8 : 1e-3) * norm(begun)) << name;
    });
}

// Balls and formations touch each other meanwhile.
TYPED_TEST(SweptFlight, KeepsItsSpinWhereItMayTouchOthers) {
    for_every_swept_figure<TypeParam>([](auto& flight, const std::string& name) {
        for (FigureIndex i = 0; i < flight.world.figures.size(); ++i) set_contact(flight.world, i, {.figures = true});
        const auto begun = flight.spin();
        flight.fly(seconds<TypeParam>());
        EXPECT_LE(norm(flight.spin() - begun), 1e-3 * norm(begun)) << name;
    });
}

TYPED_TEST(SweptFlight, GainsNoEnergy) {
    for_every_swept_figure<TypeParam>([](auto& flight, const std::string& name) {
        if (has_springs(flight.world)) return;
        const double begun = inner_energy(flight.world);
        for (double time = 0; time < seconds<TypeParam>(); time += 0.5) {
            flight.fly(0.5);
            ASSERT_LE(inner_energy(flight.world), (1 + (TypeParam::precise ? 1e-4 : 1e-3)) * begun) << name;
        }
    });
}

/// A square cloth that turns.
template <class Type> Flight<Type::dimension, typename Type::Real> spinning_cloth(double damping) {
    constexpr int D = Type::dimension;
    return {Cloth{.columns = 16, .rows = 16, .pins = "none"}, Vec<D, double>{}, damping};
}

TYPED_TEST(SweptFlight, AClothKeepsItsEnergy) {
    auto flight = spinning_cloth<TypeParam>(0);
    const double begun = inner_energy(flight.world);
    flight.fly(seconds<TypeParam>());
    EXPECT_NEAR(inner_energy(flight.world) / begun, 1, 1e-3);
}

TYPED_TEST(SweptFlight, DampingTakesItsShareOfTheSpin) {
    constexpr double damping = 0.5, time = 3;
    auto flight = spinning_cloth<TypeParam>(damping);
    const auto begun = flight.spin();
    flight.fly(time);
    const double left = norm(flight.spin()) / norm(begun);
    EXPECT_NEAR(left / std::exp(-damping * time), 1,
                TypeParam::precise ? 1e-3 : 2e-3); // the first kick is half as long
}

// A central force has no moment about its centre, wherever the particles are.
TYPED_TEST(SweptFlight, AnAttractorLeavesTheMomentumAboutItself) {
    constexpr int D = TypeParam::dimension;
    using Real = typename TypeParam::Real;
    auto flight = spinning_cloth<TypeParam>(0);
    auto& world = flight.world;
    const auto center = at<Vec<D, Real>>(1, 0.5);
    world.forces = {Attractor<D, Real>{.center = center, .strength = 3}};
    const auto about = [&] { return angular_momentum(world) - moment_of(cast<double>(center), momentum(world)); };
    const auto begun = about();
    flight.fly(3);
    EXPECT_LE(norm(about() - begun), (TypeParam::precise ? 1e-9 : 1e-4) * norm(begun));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
