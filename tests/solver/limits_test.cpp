#include "tests/worlds.h"

/// What a constraint does: limits, compliance, relaxation, split, tension, tearing; pins and grabs.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Limited : ::testing::Test {};
TYPED_TEST_SUITE(Limited, Everywhere, Names);

/// Two particles and what links them.
template <class Type> struct Pair {
    using Real = typename Type::Real;
    using Vector = typename Type::Vector;
    typename Type::World world;
    ParticleId a, b;

    /// Two unit masses at rest, `gap` apart along x, linked.
    ConstraintId linked(double gap, ConstraintSpec<Real> spec) {
        a = add_particle(world, {.position = at<Vector>(0, 0)});
        b = add_particle(world, {.position = at<Vector>(gap, 0)});
        return *add<Distance>(world, {a, b}, spec);
    }
    double gap() { return double(distance(*position_of(world, a), *position_of(world, b))); }
    void one_substep() {
        world.settings.substeps = 1;
        step(world, Real(1.0 / 64));
    }
    static constexpr double rounding = Type::precise ? 1e-14 : 1e-6;
};

TYPED_TEST(Limited, ExactHoldsBothWays) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    const auto near = pair.linked(1, {.limits = exactly(Real(2))});
    pair.one_substep();
    EXPECT_NEAR(pair.gap(), 2, 2 * pair.rounding);
    EXPECT_NEAR(constraint_state(pair.world, near)->error, 0, 2 * pair.rounding);
    pair = {};
    pair.linked(3, {.limits = exactly(Real(2))});
    pair.one_substep();
    EXPECT_NEAR(pair.gap(), 2, 2 * pair.rounding);
}

TYPED_TEST(Limited, ARopePullsAndNeverPushes) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    pair.linked(1, {.limits = at_most(Real(2))});
    pair.one_substep();
    EXPECT_EQ(pair.gap(), 1);
    pair = {};
    const auto taut = pair.linked(3, {.limits = at_most(Real(2))});
    pair.one_substep();
    EXPECT_NEAR(pair.gap(), 2, 2 * pair.rounding);
    EXPECT_GT(constraint_state(pair.world, taut)->tension, 0);
}

TYPED_TEST(Limited, AStrutPushesAndNeverPulls) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    pair.linked(3, {.limits = at_least(Real(2))});
    pair.one_substep();
    EXPECT_EQ(pair.gap(), 3);
    pair = {};
    const auto pressed = pair.linked(1, {.limits = at_least(Real(2))});
    pair.one_substep();
    EXPECT_NEAR(pair.gap(), 2, 2 * pair.rounding);
    EXPECT_LT(constraint_state(pair.world, pressed)->tension, 0);
}

TYPED_TEST(Limited, ARangeHoldsAtTheEndThatIsBroken) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    for (const auto& [before, after] : {std::pair{1.0, 2.0}, {2.5, 2.5}, {4.0, 3.0}}) {
        pair = {};
        pair.linked(before, {.limits = between(Real(2), Real(3))});
        pair.one_substep();
        EXPECT_NEAR(pair.gap(), after, 3 * pair.rounding);
    }
}

// A resting pair 1 too long: XPBD's multiplier is -1 / (w1 + w2 + alpha), alpha = c / h^2.
TYPED_TEST(Limited, ComplianceLeavesTheShareThatXpbdSays) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    const double h = 1.0 / 64, c = 1e-3;
    const auto link = pair.linked(3, {.limits = exactly(Real(2)), .compliance = Real(c)});
    pair.one_substep();
    const double lambda = -1 / (2 + c / (h * h));
    EXPECT_NEAR(pair.gap(), 3 + 2 * lambda, 4 * pair.rounding);
    EXPECT_NEAR(constraint_state(pair.world, link)->tension, -lambda / (h * h), 1e-2 * pair.rounding / 1e-6);
}

TYPED_TEST(Limited, RelaxationRemovesItsShareOfTheErrorInEachIteration) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    for (const int iterations : {1, 2, 5}) {
        pair = {};
        pair.world.settings.iterations = iterations;
        pair.linked(3, {.limits = exactly(Real(2)), .relaxation = Real(0.25)});
        pair.one_substep();
        EXPECT_NEAR(pair.gap(), 2 + std::pow(0.75, iterations), 4 * pair.rounding);
    }
}

TYPED_TEST(Limited, SplitSaysWhichEndMoves) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    for (const double split : {0.0, 0.25, 0.5, 1.0}) {
        pair = {};
        pair.linked(3, {.limits = exactly(Real(2)), .split = Real(split)});
        pair.one_substep();
        EXPECT_NEAR((*position_of(pair.world, pair.a))[0], split, 2 * pair.rounding);
        EXPECT_NEAR(pair.gap(), 2, 2 * pair.rounding);
    }
}

TYPED_TEST(Limited, TheHeavyMoveLess) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    pair.linked(3, {.limits = exactly(Real(2))});
    set_mass(pair.world, pair.a, Real(3));
    pair.one_substep();
    EXPECT_NEAR((*position_of(pair.world, pair.a))[0], 0.25, pair.rounding);
}

TYPED_TEST(Limited, BetweenTwoThatNothingMovesNothingHappens) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    for (const double gap : {3.0, 0.0}) { // at zero there is not even a direction
        pair = {};
        pair.linked(gap, {.limits = exactly(Real(2))});
        pin(pair.world, pair.a);
        set_mass(pair.world, pair.b, std::numeric_limits<Real>::infinity());
        run(pair.world, 0.1);
        EXPECT_EQ(*position_of(pair.world, pair.a), (at<Vector>(0, 0)));
        EXPECT_EQ(*position_of(pair.world, pair.b), (at<Vector>(gap, 0)));
    }
}

// An angle's limits are kept from every pose, straight (where a 3D angle has no direction to bend in) and folded.
TYPED_TEST(Limited, AnAngleLeavesTheStraightPoseForItsLowerLimit) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    auto& world = pair.world;
    const auto ids = chain(world, 3, at<Vector>(0, 0), at<Vector>(1, 0));
    const auto bend = *add<Angle>(world, {ids[0], ids[1], ids[2]}, {.limits = between(Real(0.5), Real(1))});
    world.settings.damping = 5;
    run(world, 2);
    EXPECT_NEAR(std::abs(constraint_state(world, bend)->error), 0, 1e-3);
    EXPECT_NEAR(stretch(world).max, 0, 1e-3);
}

TYPED_TEST(Limited, AnAngleAtFullTurnIsTheSameAsAtNoneWhereAnglesAreSigned) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    auto& world = pair.world;
    const auto ids = chain(world, 3, at<Vector>(0, 0), at<Vector>(1, 0));
    const auto bend = *add<Angle>(world, {ids[0], ids[1], ids[2]}, {.limits = exactly(Real(2 * pi<double>))});
    EXPECT_NEAR(constraint_state(world, bend)->error, TypeParam::dimension == 2 ? 0 : -2 * pi<double>, 1e-6);
}

TYPED_TEST(Limited, CoincidentParticlesPartAndKeepTheirMomentum) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    pair.linked(0, {.limits = exactly(Real(1))});
    set_mass(pair.world, pair.b, Real(3));
    pair.one_substep();
    EXPECT_NEAR(pair.gap(), 1, 8 * pair.rounding);
    EXPECT_NEAR(norm(momentum(pair.world)), 0, 1e-3 * pair.rounding / 1e-6);
}

TYPED_TEST(Limited, ATornLinkIsReportedOnceAndGone) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    const auto weak = pair.linked(1, {.compliance = Real(1e-2), .breaking_strain = Real(0.1)});
    set_velocity(pair.world, pair.b, at<typename TypeParam::Vector>(8, 0));
    int reports = 0;
    for (int i = 0; i < 60; ++i) {
        step(pair.world, Real(1.0 / 60));
        for (const auto& event : pair.world.events) {
            EXPECT_EQ(event.type, EventType::torn);
            EXPECT_EQ(event.constraint, weak);
            ++reports;
        }
    }
    EXPECT_EQ(reports, 1);
    EXPECT_FALSE(constraint_state(pair.world, weak));
    EXPECT_TRUE(pair.world.sweep.empty());
    const auto apart = pair.gap();
    run(pair.world, 0.5);
    EXPECT_GT(pair.gap(), apart + 1);
    EXPECT_EQ(energy(pair.world).stored, 0);
}

// Solved at once, a spring between links bends what is taut of them: the square of how much that is, of each arm.
TYPED_TEST(Limited, ASpringBetweenSlackLinksStoresWhatItCanGiveBack) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    const auto a = add_particle(world, {.position = at<Vector>(0.5, 0)}), b = add_particle(world, {});
    const auto c = add_particle(world, {.position = at<Vector>(0, 2)});
    add<Distance>(world, {b, a}, {.limits = at_most(Real(1))});
    add<Distance>(world, {b, c}, {.limits = at_most(Real(1))});
    const Real low = TypeParam::World::dimension == 2 ? -pi<Real> / 4 : Real(0);
    add<Angle>(world, {a, b, c}, {.limits = between(low, pi<Real> / 4), .compliance = Real(0.5)});
    prepare(world);
    ASSERT_EQ(world.solver.blocks.list.size(), 1U);
    const double bent = square(pi<double> / 4); // a right angle; one arm is half as long as when taut
    for (int i = 0; i < 3; ++i) world.particles.previous[Row(i)] = world.particles.position[Row(i)];
    EXPECT_NEAR(energy(world).stored, 0.5 * bent / 0.5 / 4, 1e-5);
    auto swept = world;
    swept.settings.mode = Mode::classic;
    EXPECT_NEAR(energy(swept).stored, 0.5 * bent / 0.5, 1e-5);
}

TYPED_TEST(Limited, IdsStayWithTheirLinksWhereOthersTear) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    World world;
    std::vector<ConstraintId> ids;
    for (int i = 0; i < 7; ++i) {
        const bool weak = i == 1 || i == 4;
        const auto a = add_particle(world, {.position = at<Vector>(0, 3 * i)}),
                   b = add_particle(world, {.position = at<Vector>(1 + i, 3 * i)});
        ids.push_back(*add<Distance>(
            world, {a, b},
            {.limits = exactly(Real(weak ? 0.5 : 1 + i)), .breaking_strain = weak ? Real(0.1) : Real(1e9)}));
        pin(world, a);
        pin(world, b);
    }
    step(world, Real(1e-3));
    EXPECT_EQ(world.events.size(), 2U);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const auto state = constraint_state(world, ids[i]);
        ASSERT_EQ(state.has_value(), i != 1 && i != 4) << i;
        EXPECT_NEAR(state ? state->measure : double(1 + i), double(1 + i), 1e-5);
    }
}

// A row of five whose second link tears: the turns at either end of it go with it, and nothing joins the halves.
TYPED_TEST(Limited, WithATornLinkGoWhatBothItsEndsBelongTo) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    World world;
    std::vector<ParticleId> p;
    for (int i = 0; i < 5; ++i) p.push_back(add_particle(world, {.position = at<Vector>(i, i == 2 ? 0.1 : 0)}));
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
        add<Distance>(world, {p[i], p[i + 1]}, {.breaking_strain = i == 1 ? Real(0.1) : Real(1e9)});
    const auto before = add<Angle>(world, {p[0], p[1], p[2]}), across = add<Angle>(world, {p[1], p[2], p[3]}),
               beyond = add<Angle>(world, {p[2], p[3], p[4]});
    set_position(world, p[0], at<Vector>(-1, 0));
    set_position(world, p[1], at<Vector>(0, 0)); // a whole length too far, at once
    pin(world, p[1]);
    pin(world, p[2]);
    step(world, Real(1e-3));
    ASSERT_EQ(world.events.size(), 1U);
    EXPECT_EQ(world.events[0].ends, (std::array{p[1], p[2]}));
    EXPECT_FALSE(constraint_state(world, *before));
    EXPECT_FALSE(constraint_state(world, *across));
    EXPECT_TRUE(constraint_state(world, *beyond));
}

// Held at twice its length it is strained by 1, 0.6 beyond its breaking strain: 0.5 s are more than 0.3, 0.48 s not.
TYPED_TEST(Limited, AToughLinkTearsAfterStrainTimesTime) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    const auto tough = pair.linked(1, {.compliance = 1, .breaking_strain = Real(0.4), .damage_limit = Real(0.295)});
    const auto position = position_of(pair.world, pair.a).value();
    pin(pair.world, pair.a);
    const auto hand = pin(pair.world, pair.b, {.target = position + at<typename TypeParam::Vector>(2, 0)}).value();
    run(pair.world, 0.25);
    EXPECT_TRUE(constraint_state(pair.world, tough));
    move_pin(pair.world, hand, position + at<typename TypeParam::Vector>(1.3, 0)); // it rests, and is not mended
    run(pair.world, 2);
    move_pin(pair.world, hand, position + at<typename TypeParam::Vector>(2, 0));
    run(pair.world, 0.2);
    EXPECT_TRUE(constraint_state(pair.world, tough));
    run(pair.world, 0.1);
    EXPECT_FALSE(constraint_state(pair.world, tough));
}

TYPED_TEST(Limited, WhatIsStrainedLessHolds) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    const auto strong = pair.linked(1, {.compliance = Real(1e-2), .breaking_strain = Real(0.8)});
    set_velocity(pair.world, pair.b, at<typename TypeParam::Vector>(8, 0));
    run(pair.world, 1); // amplitude 8 / sqrt(2 k) = 0.57
    EXPECT_TRUE(constraint_state(pair.world, strong));
}

// A chain of n links under its own weight, at rest: the i-th carries what hangs below it. One projection a substep
// converges in time, so the chain is damped to rest first.
TYPED_TEST(Limited, TensionOfAHangingChainIsTheWeightBelow) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    auto& world = pair.world;
    fall(world, 10);
    const auto ids = chain(world, 6, at<Vector>(0, 0), at<Vector>(0, -1));
    pin(world, ids[0]);
    set_mass(world, ids[5], Real(2));
    world.settings.damping = 4;
    world.settings.substeps = 8;
    run(world, 10);
    for (Row i = 0; i < 5; ++i) {
        const ConstraintId link{0, std::get<0>(world.constraints).handles.id_of(i)};
        const double weight = 10 * (5.0 - i + 1);
        // in float, one unit of the last place of a coordinate near 5 is 5e-7 m, or 5e-7 m kg / h^2 = 0.1 N
        EXPECT_NEAR(constraint_state(world, link)->tension, weight, TypeParam::precise ? 1e-6 : 0.4) << i;
    }
}

TYPED_TEST(Limited, AFixedPinHoldsExactly) {
    Pair<TypeParam> pair;
    using Vector = typename TypeParam::Vector;
    fall(pair.world, 10);
    pair.linked(1, {});
    pin(pair.world, pair.a, {.target = at<Vector>(0.25, 0.75)});
    run(pair.world, 2);
    EXPECT_EQ(*position_of(pair.world, pair.a), (at<Vector>(0.25, 0.75)));
    EXPECT_NEAR(pair.gap(), 1, 1e-3);
}

// The target is interpolated over the substeps: half a step on, half of the way; let go, the speed of the way stays.
TYPED_TEST(Limited, AMovingPinCarriesItsParticleEvenlyAndLetsItGoWithItsVelocity) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    auto& world = pair.world;
    const auto a = add_particle(world, {});
    const auto hand = *pin(world, a);
    for (int i = 1; i <= 8; ++i) {
        move_pin(world, hand, at<Vector>(0.25 * i, -0.5 * i));
        step(world, Real(0.125));
        EXPECT_NEAR(double(distance(*position_of(world, a), at<Vector>(0.25 * i, -0.5 * i))), 0, 1e-6);
        EXPECT_NEAR(double(distance(*velocity_of(world, a), at<Vector>(2, -4))), 0, TypeParam::precise ? 1e-10 : 1e-3);
    }
    unpin(world, hand);
    step(world, Real(0.125));
    EXPECT_NEAR(double(distance(*position_of(world, a), at<Vector>(2.25, -4.5))), 0, 1e-4);
}

// Held while its target is far away, a particle travels there within the step and pulls what it is tied to along.
TYPED_TEST(Limited, APinWithAFarTargetGetsThereInOneStep) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    pair.linked(1, {});
    pin(pair.world, pair.a, {.target = at<Vector>(1024, 0)});
    step(pair.world, Real(1.0 / 64));
    EXPECT_EQ(*position_of(pair.world, pair.a), at<Vector>(1024, 0));
    EXPECT_TRUE(is_finite(*position_of(pair.world, pair.b)));
}

// A soft pin is a critically damped spring: under a weight it settles mg c below its target, without overshooting.
TYPED_TEST(Limited, ASoftGrabSettlesMgcBelowItsTarget) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    auto& world = pair.world;
    fall(world, 10);
    const auto bob = add_particle(world, {.mass = 2});
    pin(world, bob, {.compliance = Real(0.01)});
    double lowest = 0;
    for (int i = 0; i < 300; ++i) {
        step(world, Real(1.0 / 60));
        lowest = std::min(lowest, double((*position_of(world, bob))[1]));
    }
    EXPECT_NEAR((*position_of(world, bob))[1], -0.2, TypeParam::precise ? 1e-9 : 1e-5);
    EXPECT_GT(lowest, -0.2 - 1e-5);
}

// Once it keeps pace the damper feels no difference and nothing lags: the spring carries no load.
TYPED_TEST(Limited, ASoftGrabFollowsASteadyHandWithoutLag) {
    Pair<TypeParam> pair;
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    auto& world = pair.world;
    const auto bob = add_particle(world, {});
    const auto hand = *pin(world, bob, {.compliance = Real(0.001)});
    for (int i = 1; i <= 240; ++i) {
        move_pin(world, hand, at<Vector>(i / 60.0, 0));
        step(world, Real(1.0 / 60));
    }
    EXPECT_NEAR((*position_of(world, bob))[0], 4, 1e-4);
}

// Two kilograms pulled by at most 3 N towards a target far away: a = 1.5 m/s^2.
TYPED_TEST(Limited, AGrabNeverPullsHarderThanItsCap) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    for (const double compliance : {0.0, 1e-6, 1e-3}) {
        typename TypeParam::World world;
        const auto bob = add_particle(world, {.mass = 2});
        pin(world, bob, {.target = at<Vector>(1000, 0), .compliance = Real(compliance), .max_force = 3});
        run(world, 2);
        EXPECT_NEAR((*velocity_of(world, bob))[0], 3, 3e-3) << compliance;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
