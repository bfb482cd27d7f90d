#include "tests/flight.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

/// Free flight of what is swept: cloth by default, and every other figure if it is asked for. An unfinished sweep takes
/// spin, which the step gives back.
namespace sinew {
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

double seconds() {
    return few_or_many(6, 60);
}

// Float rounds each velocity in each step.
TYPED_TEST(SweptFlight, KeepsItsSpin) {
    for_every_swept_figure<TypeParam>([](auto& flight, const std::string& name) {
        const auto begun = flight.spin();
        flight.fly(seconds());
        EXPECT_LE(norm(flight.spin() - begun), (TypeParam::precise ? 1e-9 : 1e-3) * norm(begun)) << name;
    });
}

TYPED_TEST(SweptFlight, GainsNoEnergy) {
    for_every_swept_figure<TypeParam>([](auto& flight, const std::string& name) {
        const double begun = inner_energy(flight.world);
        for (double time = 0; time < seconds(); time += 0.5) {
            flight.fly(0.5);
            ASSERT_LE(inner_energy(flight.world), (1 + (TypeParam::precise ? 1e-9 : 1e-4)) * begun) << name;
        }
    });
}

/// A square cloth that turns in its own plane.
template <class Type> Flight<Type::dimension, typename Type::Real> spinning_cloth(double damping) {
    constexpr int D = Type::dimension;
    return {Cloth{.columns = 16, .rows = 16, .pins = "none"}, Vec<D, double>{}, damping};
}

TYPED_TEST(SweptFlight, AClothKeepsTheEnergyOfItsRotation) {
    auto flight = spinning_cloth<TypeParam>(0);
    const double begun = inner_energy(flight.world);
    flight.fly(seconds());
    EXPECT_NEAR(inner_energy(flight.world) / begun, 1, 1e-3);
}

} // namespace
} // namespace sinew
