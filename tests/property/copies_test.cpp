#include "tests/random_calls.h"
#include "tests/thorough.h"

/// A copy of a world has the same future to the last bit, whatever was done to the world before: all that decides a
/// step is state.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Copies : ::testing::Test {};
TYPED_TEST_SUITE(Copies, Everywhere, Names);

/// Spoils all that has to follow from the rest.
template <class World> void destroy_what_follows(World& world) {
    using Vector = typename World::Vector;
    using Real = typename World::Real;
    const auto nonsense = Vector::axis(0) * Real(123.5);
    std::fill(world.particles.at_end.begin(), world.particles.at_end.end(), char(1));
    std::fill(world.solver.scratch.begin(), world.solver.scratch.end(), nonsense);
    world.events.clear();
    world.energy_lost = -5;
    world.solver.options.threads = 1;
}

TYPED_TEST(Copies, HaveTheSameFutureAfterAnyCalls) {
    using Real = typename TypeParam::Real;
    constexpr std::array lengths = {1.0 / 60, 1.0 / 60, 1.0 / 30, 1.0 / 120};
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(10, 100)); ++seed) {
        RandomCalls<typename TypeParam::World> calls(seed);
        for (int round = 0; round < 25; ++round) {
            for (int i = calls.below(4); i > 0; --i) calls.call();
            auto copy = calls.world;
            destroy_what_follows(copy);
            ASSERT_EQ(state_hash(copy), state_hash(calls.world)) << "seed " << seed << ", round " << round;
            for (int i = calls.below(4); i >= 0; --i) {
                const auto dt = Real(lengths[std::size_t(calls.below(4))]);
                step(calls.world, dt);
                step(copy, dt);
                ASSERT_EQ(state_hash(copy), state_hash(calls.world)) << "seed " << seed << ", round " << round;
            }
        }
    }
}

// A winch that has wound up all of its rope, a motor that turns past straight, a way that slips.
TYPED_TEST(Copies, HaveTheSameFutureWhereALengthIsDrivenToNothing) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    for (const double rate : {-3.0, -0.5, 2.0})
        for (const double max_force : {1e30, 20.0}) {
            typename TypeParam::World world;
            fall(world, 10);
            const auto ids = chain(world, 5, Vector{}, at<Vector>(0.3, 0.01));
            pin(world, ids[0]);
            const auto side = add_particle(world, {.position = at<Vector>(0.3, 0.5)});
            for (const auto id : {ids[1], ids[2]}) add<Distance>(world, {side, id});
            const auto winch = add<Distance>(world, {ids[4], side}, {.limits = at_most(Real(0.8))});
            const auto motor = add<Angle>(world, {ids[2], ids[3], ids[4]}, {.compliance = Real(1e-3)});
            drive(world, *winch, Real(rate));
            drive(world, *motor, Real(rate));
            set_max_force(world, *winch, Real(max_force));
            for (int i = 0; i < 60; ++i) {
                auto copy = world;
                step(world, Real(1.0 / 60));
                step(copy, Real(1.0 / 60));
                ASSERT_EQ(state_hash(copy), state_hash(world)) << rate << ", " << max_force << ", step " << i;
            }
        }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
