#include "tests/random_calls.h"
#include "tests/thorough.h"

/// Finite numbers in any call leave a world finite and within its limits, before and after the next step.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct ExtremeCalls : ::testing::Test {};
TYPED_TEST_SUITE(ExtremeCalls, Everywhere, Names);

template <class World>::testing::AssertionResult is_within_limits(const World& world) {
    using Real = typename World::Real;
    using Vector = typename World::Vector;
    const auto within = [](const Vector& vector, Real max) {
        return std::ranges::all_of(vector.component, [&](Real x) { return absolute(x) <= max; });
    };
    const auto& p = world.particles;
    constexpr auto furthest = limit::coordinate<Real>;
    for (Row row = 0; row < p.size(); ++row) {
        if (!within(p.position[row], furthest)) return ::testing::AssertionFailure() << "position " << row;
        if (!within(p.previous[row], furthest)) return ::testing::AssertionFailure() << "previous " << row;
        if (!within(p.velocity[row], limit::speed<Real>)) return ::testing::AssertionFailure() << "velocity " << row;
        if (!within(p.force[row], limit::force<Real>)) return ::testing::AssertionFailure() << "force " << row;
        if (!(p.radius[row] >= 0 && p.radius[row] <= furthest))
            return ::testing::AssertionFailure() << "radius " << row;
        if (!(p.inverse_mass[row] >= 0 && p.inverse_mass[row] <= limit::mass<Real>))
            return ::testing::AssertionFailure() << "mass " << row;
    }
    for (const auto& pin : world.pins)
        if (!within(pin.from, furthest) || !within(pin.target, furthest)) return ::testing::AssertionFailure() << "pin";
    for (const auto& event : world.events)
        if (event.type == EventType::quarantined) return ::testing::AssertionFailure() << "quarantined";
    return ::testing::AssertionSuccess();
}

/// Forty calls, and a step after every fourth.
template <class World> void expect_limits_are_kept(std::uint64_t seed) {
    RandomCalls<World> calls(seed, Numbers::extreme);
    for (int i = 0; i < 40; ++i) {
        calls.call();
        ASSERT_TRUE(is_within_limits(calls.world)) << "seed " << seed << ", call " << i;
        if (i % 4 == 3) step(calls.world, typename World::Real(1.0 / 60));
        ASSERT_TRUE(is_within_limits(calls.world)) << "seed " << seed << ", after call " << i;
    }
}

TYPED_TEST(ExtremeCalls, LeaveEverythingWithinItsLimits) {
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(20, 500)); ++seed) {
        expect_limits_are_kept<typename TypeParam::World>(seed);
        if (::testing::Test::HasFatalFailure()) return;
    }
}

// A free group of joined figures in one point at the edge of the world: it has no inertia by which to turn.
TEST(ExtremeRounds, AGroupThatIsAPointIsNoFasterThanAnything) {
    expect_limits_are_kept<In<2, double>::World>(382);
}

// Walls go, particles come, and a joined figure has to be swept twice: rebounds from walls must not be forgotten then,
// because there is no room for them.
TEST(ExtremeRounds, WallsThatAreGoneLeaveNoRebounds) {
    expect_limits_are_kept<In<2, float>::World>(107);
}

TYPED_TEST(ExtremeCalls, AnImpulseAndTwoLeapsBeyondAllLimitsAreHeldAtThem) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    constexpr auto max = std::numeric_limits<Real>::max();
    for (const Mode mode : {Mode::physical, Mode::classic}) {
        typename TypeParam::World world;
        world.settings.mode = mode;
        const auto figure = add_figure(world, "leaps");
        const auto light = add_particle(world, {.mass = Real(1e-12), .figure = figure});
        const auto heavy = add_particle(world, {.position = at<Vector>(1, 0), .figure = figure});
        world.figures[figure].particles = {light, heavy};
        add<Distance>(world, {light, heavy});
        pin(world, heavy);
        for (int i = 0; i < 3; ++i) {
            EXPECT_TRUE(apply_impulse(world, light, at<Vector>(1e30, -1e30)));
            EXPECT_EQ((*velocity_of(world, light))[0], limit::speed<Real>);
            EXPECT_TRUE(apply_force(world, light, Vector::axis(0) * max));
            EXPECT_TRUE(teleport(world, figure, Vector::axis(0) * max));
            EXPECT_EQ((*position_of(world, heavy))[0], limit::coordinate<Real>);
            ASSERT_TRUE(is_within_limits(world));
            step(world, Real(1.0 / 60));
            ASSERT_TRUE(is_within_limits(world));
        }
    }
}

TYPED_TEST(ExtremeCalls, AMotorOfNoNumberIsRefused) {
    typename TypeParam::World world;
    const auto ids = chain(world, 2, {}, at<typename TypeParam::Vector>(1, 0));
    const ConstraintId link{0, std::get<0>(world.constraints).handles.id_of(0)};
    const auto hash = state_hash(world);
    EXPECT_FALSE(drive(world, link, typename TypeParam::Real(NAN)));
    EXPECT_FALSE(set_max_force(world, link, typename TypeParam::Real(NAN)));
    EXPECT_EQ(state_hash(world), hash);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
