#include "tests/stepped.h"
#include "tests/worlds.h"

#include <rapidcheck/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Edit : ::testing::Test {};
TYPED_TEST_SUITE(Edit, Everywhere, Names);

TYPED_TEST(Edit, IdsSurviveRemovalsAndAreNeverReused) {
    typename TypeParam::World world;
    const auto ids = chain(world, 5, at<typename TypeParam::Vector>(0, 0), at<typename TypeParam::Vector>(1, 0));
    remove_particles(world, std::vector{ids[1], ids[2]});
    EXPECT_FALSE(position_of(world, ids[1]));
    EXPECT_EQ((*position_of(world, ids[3]))[0], 3);
    EXPECT_EQ(std::get<0>(world.constraints).size(), 1U) << "only 3-4 has both its ends";
    EXPECT_EQ(std::get<0>(world.constraints).members[0][0], *row_of(world, ids[3]));

    const auto fresh = add_particle(world, {});
    EXPECT_NE(fresh, ids[1]);
    EXPECT_NE(fresh, ids[2]);
    EXPECT_FALSE(row_of(world, ids[1]));
    EXPECT_FALSE(set_velocity(world, ids[2], {})) << "a slot used again does not answer to its old id";
}

TYPED_TEST(Edit, RemovingAParticleTakesItsConstraintsPinsAndNamesAlong) {
    typename TypeParam::World world;
    const auto ids = chain(world, 3, at<typename TypeParam::Vector>(0, 0), at<typename TypeParam::Vector>(1, 0));
    const auto figure = add_figure(world, "rope");
    world.figures[figure].particles = ids;
    world.figures[figure].particle_names = {{"top", ids[0]}, {"end", ids[2]}};
    const auto held = pin(world, ids[0]);
    ASSERT_EQ(find_particle(world, "rope/top"), ids[0]);
    remove_particles(world, std::vector{ids[0]});
    EXPECT_FALSE(find_particle(world, "rope/top"));
    EXPECT_EQ(find_particle(world, "rope/end"), ids[2]);
    EXPECT_FALSE(row_of(world, world.figures[figure].particles[0]))
        << "its place in the figure stays, and finds nothing";
    EXPECT_TRUE(row_of(world, world.figures[figure].particles[1]));
    EXPECT_TRUE(world.pins.empty());
    EXPECT_FALSE(move_pin(world, *held, {}));
    EXPECT_EQ(world.sweep.size(), 1U);
    EXPECT_EQ(world.sweep[0].count, 1U);
}

TYPED_TEST(Edit, SpeakingToSomethingGoneDoesNothingAndSaysSo) {
    typename TypeParam::World world;
    const auto ids = chain(world, 2, {}, at<typename TypeParam::Vector>(1, 0));
    const auto held = pin(world, ids[0]);
    ASSERT_TRUE(unpin(world, *held));
    const auto hash = state_hash(world);
    EXPECT_FALSE(unpin(world, *held));
    EXPECT_FALSE(set_position(world, ParticleId{}, {}) || set_velocity(world, ParticleId{}, {}) ||
                 set_mass(world, ParticleId{}, typename TypeParam::Real(1)) || apply_force(world, ParticleId{}, {}) ||
                 apply_impulse(world, ParticleId{}, {}) || pin(world, ParticleId{}) ||
                 constraint_state(world, ConstraintId{}));
    EXPECT_FALSE(add<Distance>(world, {ids[0], ids[0]})) << "a member named twice";
    EXPECT_FALSE(add<Distance>(world, {ids[0], ParticleId{}})) << "a member that is gone";
    EXPECT_FALSE(add<Angle>(world, {ids[0], ids[1]})) << "too few members";
    EXPECT_EQ(state_hash(world), hash);
}

// A random history of additions and removals, against a plain list of what should be there.
TEST(Edit, AnyHistoryOfAddingAndRemovingKeepsWhoIsWhoAndTheSweepsOrder) {
    EXPECT_TRUE(rc::check([] {
        test::Stepped<2, double> world;
        struct Link {
            ConstraintId id;
            double rest;
            ParticleId a, b, c;
            bool angle;
        };
        std::vector<std::pair<ParticleId, double>> points;
        std::vector<Link> links;
        double serial = 0;
        const int events = *rc::gen::inRange(1, 60);
        for (int i = 0; i < events; ++i) {
            const int what = *rc::gen::inRange(0, 6);
            const auto some = [&](std::size_t n) { return std::size_t(*rc::gen::inRange(0, int(n))); };
            if (what <= 1 || points.size() < 4) {
                points.emplace_back(add_particle(world, {.position = {serial, 0}}), serial);
                serial += 1;
            } else if (what <= 3) {
                const auto n = points.size(), k = some(n);
                const auto a = points[k].first, b = points[(k + 1) % n].first, c = points[(k + 2) % n].first;
                const bool angle = what == 3;
                serial += 1;
                const ConstraintSpec<double> spec{.limits = exactly(serial)};
                links.push_back({angle ? *add<Angle>(world, {a, b, c}, spec) : *add<Distance>(world, {a, b}, spec),
                                 serial, a, b, angle ? c : b, angle});
            } else if (what == 4 && !links.empty()) {
                const auto k = some(links.size());
                remove_constraints(world, std::vector{links[k].id});
                links.erase(links.begin() + std::ptrdiff_t(k));
            } else {
                const auto k = some(points.size());
                const auto gone = points[k].first;
                remove_particles(world, std::vector{gone});
                points.erase(points.begin() + std::ptrdiff_t(k));
                std::erase_if(links, [&](const Link& l) { return l.a == gone || l.b == gone || l.c == gone; });
            }
        }
        for (const auto& [id, x] : points) RC_ASSERT((*position_of(world, id))[0] == x);
        std::vector<double> in_sweep_order, expected;
        Row next[3] = {};
        for (const auto& run : world.sweep)
            for (Row i = 0; i < run.count; ++i)
                visit_table(world, run.kind,
                            [&](const auto& table) { in_sweep_order.push_back(table.low(next[run.kind]++)); });
        for (const auto& link : links) {
            expected.push_back(link.rest);
            visit_table(world, link.id.kind, [&](const auto& table) {
                const auto row = table.handles.find(link.id.id);
                RC_ASSERT(row.has_value());
                RC_ASSERT(table.low(*row) == link.rest);
                RC_ASSERT(table.members[*row][0] == *row_of(world, link.a));
                RC_ASSERT(table.members[*row][1] == *row_of(world, link.b));
            });
        }
        RC_ASSERT(in_sweep_order == expected);
    }));
}

TYPED_TEST(Edit, WorldsCanBeEditedBetweenAnyTwoSteps) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    fall(world, 10);
    auto ids = chain(world, 3, at<Vector>(0, 0), at<Vector>(1, 0));
    pin(world, ids[0]);
    for (int i = 0; i < 100; ++i) {
        const auto end = add_particle(world, {.position = *position_of(world, ids.back()) + at<Vector>(1, 0)});
        add<Distance>(world, {ids.back(), end});
        ids.push_back(end);
        step(world, Real(1.0 / 60));
        if (i % 3 == 2) {
            remove_particles(world, std::vector{ids.back()});
            ids.pop_back();
        }
    }
    EXPECT_EQ(world.particles.size(), ids.size());
    EXPECT_EQ(*position_of(world, ids[0]), Vector{});
    EXPECT_TRUE(is_finite(*position_of(world, ids.back())));
}

TYPED_TEST(Edit, RestIsWhatAConstraintMeasuresWhenItIsAdded) {
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    const auto a = add_particle(world, {}), b = add_particle(world, {.position = at<Vector>(3, 4)});
    const auto link = *add<Distance>(world, {a, b});
    const auto state = *constraint_state(world, link);
    EXPECT_EQ(state.measure, 5);
    EXPECT_EQ(state.error, 0);
    EXPECT_EQ(std::get<0>(world.constraints).low(0), 5);
}

TYPED_TEST(Edit, StateTellsErrorAndStrainAgainstTheLimitThatBroke) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    const auto a = add_particle(world, {}), b = add_particle(world, {.position = at<Vector>(3, 0)});
    const auto strain = [&](Interval<Real> limits) {
        return constraint_state(world, *add<Distance>(world, {a, b}, {.limits = limits}))->strain;
    };
    EXPECT_DOUBLE_EQ(strain(exactly(Real(2))), 0.5);
    EXPECT_DOUBLE_EQ(strain(at_most(Real(2))), 0.5);
    EXPECT_DOUBLE_EQ(strain(at_least(Real(4))), -0.25);
    EXPECT_DOUBLE_EQ(strain(at_least(Real(2))), 0);
    EXPECT_DOUBLE_EQ(strain(between(Real(1), Real(4))), 0);
}

TYPED_TEST(Edit, ReversedLimitsAreHeldAtTheLower) {
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    const auto ids = chain(world, 2, {}, at<typename TypeParam::Vector>(1, 0));
    add<Distance>(world, {ids[0], ids[1]}, {.limits = between(Real(3), Real(2))});
    EXPECT_EQ(std::get<0>(world.constraints).high(1), 3);
}

TYPED_TEST(Edit, ALengthIsNeverNegative) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    const auto ids = chain(world, 3, at<Vector>(0, 0), at<Vector>(1, 0));
    const auto link = *add<Distance>(world, {ids[0], ids[2]});
    EXPECT_FALSE(set_limits(world, link, exactly(Real(-1))));
    EXPECT_FALSE(add<Distance>(world, {ids[0], ids[2]}, {.limits = at_most(Real(-1))}));
    EXPECT_FALSE(add<Pulley>(world, {ids[0], ids[1], ids[2]}, {.limits = exactly(Real(-1))}));
    IdList<ConstraintId> added;
    add_distances(world, std::vector<std::array<ParticleId, 2>>{{ids[0], ids[2]}}, {.limits = exactly(Real(-1))},
                  added);
    EXPECT_TRUE(added.empty());
    run(world, 0.1);
    EXPECT_EQ(constraint_state(world, link)->measure, 2);
    EXPECT_TRUE(set_limits(world, link, {Real(-1), Real(3)})) << "a lower limit that nothing reaches";
    EXPECT_TRUE(set_limits(world, link, exactly(Real(0))));
}

TYPED_TEST(Edit, AnImpulseChangesMomentumByItself) {
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    const auto a = add_particle(world, {.velocity = at<Vector>(1, 0), .mass = 4});
    apply_impulse(world, a, at<Vector>(8, -4));
    EXPECT_EQ(*velocity_of(world, a), at<Vector>(3, -1));
    EXPECT_EQ(momentum(world)[0], 12);
}

TYPED_TEST(Edit, AForceActsForOneStep) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    const auto a = add_particle(world, {.mass = 2});
    run(world, 0.5); // the first kick of all spans half a substep; from then on, whole ones
    apply_force(world, a, at<Vector>(3, 0));
    apply_force(world, a, at<Vector>(3, 0));
    step(world, Real(0.5));
    // 6 N on 2 kg for 0.5 s; the substep is 30 times as long as the last, so its first kick is corrected: 15.5 / 16
    const double first_kick = 0.5 * (1.0 / 30 + 1), expected = 3 * 0.5 * (15 + first_kick) / 16;
    EXPECT_NEAR((*velocity_of(world, a))[0], expected, 1e-5);
    const auto before = *velocity_of(world, a);
    step(world, Real(0.5));
    EXPECT_EQ(*velocity_of(world, a), before);
}

TYPED_TEST(Edit, InfiniteMassIsNotMoved) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    fall(world, 10);
    const auto rock = add_particle(world, {.mass = std::numeric_limits<Real>::infinity()});
    const auto bob = add_particle(world, {.position = at<Vector>(1, 0)});
    add<Distance>(world, {rock, bob});
    run(world, 1);
    EXPECT_EQ(*position_of(world, rock), Vector{});
    EXPECT_EQ(total_mass(world), 1);
}

TYPED_TEST(Edit, TeleportMovesAFigureAndItsPinsAndKeepsOrResetsItsVelocity) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    for (const Mode mode : {Mode::physical, Mode::classic}) {
        typename TypeParam::World world, still;
        for (auto* w : {&world, &still}) {
            w->settings.mode = mode;
            const auto figure = add_figure(*w, "stick");
            auto ids = chain(*w, 3, at<Vector>(0, 0), at<Vector>(1, 0));
            for (auto& owner : w->particles.figure) owner = figure;
            w->figures[figure].particles = ids;
            pin(*w, ids[0]);
            set_velocity(*w, ids[2], at<Vector>(0, 1));
            run(*w, 0.5);
        }
        const auto bystander = add_particle(world, {});
        teleport(world, 0, at<Vector>(64, 32));
        for (int i = 0; i < 10; ++i) {
            step(world, Real(1.0 / 60));
            step(still, Real(1.0 / 60));
        }
        for (Row row = 0; row < 3; ++row) // 64 costs a coordinate near 1 its last six digits of two
            EXPECT_LT(
                double(distance(world.particles.position[row], still.particles.position[row] + at<Vector>(64, 32))),
                sizeof(Real) == 4 ? 2e-4 : 1e-12);
        EXPECT_EQ(*position_of(world, bystander), Vector{});
        teleport(world, 0, at<Vector>(1, 0), Momentum::reset);
        EXPECT_EQ(max_speed(world), 0);
        const auto there = world.particles.position[2];
        step(world, Real(1.0 / 60));
        EXPECT_LT(double(distance(world.particles.position[2], there)), 1e-4) << "nothing drives it any more";
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
