#include "tests/worlds.h"

#include <rapidcheck/gtest.h>

namespace sinew {
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
        World<2, double> world;
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
                const auto row = table.slots.find(link.id.id);
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

/// Ropes, one of them of springs and one that tears, a ladder with too many loops and ropes on it, a winch, and figures
/// with angles; all joined to a nail or two. Or nothing that tears, but cloths with tethers and many things alike.
template <class World> struct Jumble {
    using Real = typename World::Real;
    using Vector = typename World::Vector;
    World world;
    std::vector<ParticleId> particles;
    std::vector<ConstraintId> constraints;
    std::vector<PinId> pins;
    bool tears = true;

    explicit Jumble(bool cloths) : tears(!cloths) {
        fall(world, 10);
        if (cloths) {
            add_cloth(0, 6, 5);
            for (int i = 0; i < 9; ++i) add_cloth(i, 3, 3);
            add_cloth(20, 34, 34, 37);
            add_cloth(30, 9, 9, 37);
            for (int i = 0; i < 3; ++i) add_cloth(40 + i, 2, 2);
        }
        for (int i = 0; i < 3; ++i) add_rope(i, 3 + 3 * i);
        constexpr int side = 13;
        std::vector<ParticleId> mat;
        for (int i = 0; i < side * side; ++i)
            mat.push_back(particle(Real(10 + 0.3 * (i % side)), Real(-0.3 * (i / side))));
        for (int i = 0; i < side * side; ++i) {
            if (i % side + 1 < side) link(mat[std::size_t(i)], mat[std::size_t(i) + 1]);
            if (i + side < side * side) link(mat[std::size_t(i)], mat[std::size_t(i + side)]);
        }
        hold(mat[0]);
        for (int i = 0; i < 4; ++i)
            mat.push_back(particle(Real(10 + 0.3 * i), Real(-4))),
                link(mat[std::size_t(side * (side - 1))], mat.back(), {});
        for (int i = 0; i < 6; ++i)
            mat.push_back(particle(Real(14), Real(-0.3 * i))),
                link(i == 0 ? mat[side - 1] : mat[mat.size() - 2], mat.back());
    }

    ParticleId particle(Real x, Real y) {
        particles.push_back(add_particle(world, {.position = at<Vector>(double(x), double(y))}));
        return particles.back();
    }
    void link(ParticleId a, ParticleId b, const ConstraintSpec<Real>& spec = {}) {
        if (const auto id = add<Distance>(world, {a, b}, spec)) constraints.push_back(*id);
    }
    void hold(ParticleId particle) {
        if (const auto id = sinew::pin(world, particle)) pins.push_back(*id);
    }
    void add_rope(int i, int links) {
        auto last = particle(Real(i), 0), before = last;
        hold(last);
        for (int j = 1; j <= links; ++j) {
            const auto next = particle(Real(i + 0.2 * j), Real(0.1 * (j % 2)));
            link(last, next,
                 {.limits = i == 1 ? exactly(Real(0.25)) : at_most(Real(0.25)),
                  .compliance = i == 2 ? Real(1e-3) : Real(0),
                  .breaking_strain = i == 1 && tears ? Real(0.5) : Real(1e30)});
            if (j > 1 && i == 0)
                if (const auto id = add<Angle>(world, {before, last, next}, {.limits = at_most(Real(2))}))
                    constraints.push_back(*id);
            before = last, last = next;
        }
    }

    /// Swept, and tied to its first corner and its last. Particles are added this far on each time, which must have no
    /// divisor in common with their number: in no order that leads anywhere.
    void add_cloth(int x, int columns, int rows, int step = 1) {
        const auto figure = add_figure(world, "cloth" + std::to_string(world.figures.size()));
        world.figures[figure].direct = Direct::off;
        world.figures[figure].tethers = true;
        std::vector<ParticleId> spots(std::size_t(columns * rows));
        for (int k = 0; k < columns * rows; ++k) {
            const int i = k * step % (columns * rows);
            spots[std::size_t(i)] = particle(Real(x + 0.05 * (i % columns)), Real(-0.05 * (i / columns)));
            world.particles.figure.back() = figure;
        }
        const auto at = [&](int i) { return spots[std::size_t(i)]; };
        for (int i = 0; i < columns * rows; ++i)
            if (i % columns + 1 < columns) link(at(i), at(i + 1));
        for (int i = 0; i + columns < columns * rows; ++i) link(at(i), at(i + columns));
        for (int i = 0; i + columns + 1 < columns * rows; ++i)
            if (i % columns + 1 < columns) link(at(i), at(i + columns + 1));
        hold(at(0)), hold(at(columns - 1));
    }

    /// One of many small changes.
    void change(std::uint64_t seed, std::uint64_t number) {
        const auto below = [&](std::size_t count, std::uint64_t which) {
            return std::size_t(random::whole(0, std::int64_t(count) - 1, seed, number, which));
        };
        const auto one = [&](const auto& list, std::uint64_t which) { return list[below(list.size(), which)]; };
        const auto p = one(particles, 1), q = one(particles, 2);
        switch (below(11, 0)) {
        case 0:
        case 1:
            return remove_constraints(world, std::vector{one(constraints, 3)});
        case 2:
            return remove_particles(world, std::vector{p});
        case 3:
            return hold(p);
        case 4:
        case 5:
            unpin(world, one(pins, 3));
            return;
        case 6:
            return link(p, q);
        case 7:
            return add_rope(int(below(9, 3)), int(below(7, 4)));
        case 8:
            drive(world, one(constraints, 3), Real(-0.1));
            return;
        case 9:
            return add_cloth(int(below(9, 3)), int(2 + below(3, 4)), 3);
        default:
            set_mass(world, p, below(4, 3) == 0 ? std::numeric_limits<Real>::infinity() : Real(2));
            return;
        }
    }
};

// What is rebuilt of blocks and plan after a change is what would be built of the whole world.
TYPED_TEST(Edit, AWorldThatIsChangedMovesAsOneBuiltSo) {
    constexpr double dt = 1e-4; // what is tangled is not to be pulled tight
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        Jumble<typename TypeParam::World> jumble(seed >= 2);
        jumble.world.settings.substeps = 2;
        for (std::uint64_t i = 0; i < 20; ++i) {
            step(jumble.world, typename TypeParam::Real(dt));
            for (std::uint64_t k = 0; k <= i % 3; ++k) jumble.change(seed, 3 * i + k);
            auto fresh = jumble.world; // a copy finds its blocks itself
            auto changed = std::move(jumble.world);
            step(fresh, typename TypeParam::Real(dt));
            step(changed, typename TypeParam::Real(dt));
            ASSERT_EQ(state_hash(fresh), state_hash(changed)) << "after change " << i << ", seed " << seed;
            ASSERT_EQ(fresh.blocks.list.size(), changed.blocks.list.size());
            ASSERT_EQ(fresh.blocks.hanging.size(), changed.blocks.hanging.size());
            ASSERT_EQ(fresh.swept.row_of, changed.swept.row_of) << "after change " << i << ", seed " << seed;
            ASSERT_EQ(fresh.swept.plan.runs.size(), changed.swept.plan.runs.size());
            ASSERT_EQ(fresh.swept.plan.tethers.size(), changed.swept.plan.tethers.size());
            jumble.world = std::move(changed);
        }
    }
}

// And only that: a cut among many ropes leaves the others where they are.
TEST(Edit, ACutFindsNoMoreThanItsOwnRopeAgain) {
    World<2, double> world;
    for (int i = 0; i < 20; ++i) pin(world, chain(world, 12, {{double(i), 0}}, {{0, -0.1}})[0]);
    prepare(world);
    const auto nodes = world.blocks.nodes.size();
    const auto& links = std::get<kind_number<Distance, 2>>(world.constraints);
    remove_constraints(world, std::vector{ConstraintId{kind_number<Distance, 2>, links.slots.id_of(60)}});
    prepare(world);
    EXPECT_EQ(world.blocks.list.size(), 21U);
    EXPECT_EQ(world.blocks.room.members.size(), 11U) << "its particles that move";
    EXPECT_LE(world.blocks.nodes.size(), nodes + 12);
}

// What joins each particle of a large cloth is only listed when something of it changes.
TEST(Edit, ALargeClothHasNoBlocksUntilARopeHangsFromIt) {
    constexpr std::size_t side = 230; // 105,340 links
    World<2, float> world;
    world.settings.substeps = 1;
    std::vector<ParticleId> ids;
    for (std::size_t i = 0; i < side * side; ++i)
        ids.push_back(add_particle(world, {.position = {{float(i % side), float(i / side)}}}));
    for (std::size_t i = 0; i < side * side; ++i) {
        if (i % side + 1 < side) add<Distance>(world, {ids[i], ids[i + 1]});
        if (i / side + 1 < side) add<Distance>(world, {ids[i], ids[i + side]});
    }
    prepare(world);
    EXPECT_FALSE(world.blocks.bonds.listed());
    EXPECT_TRUE(world.blocks.list.empty());
    const auto rope = chain(world, 5, {{0, -1}}, {{0, -1}});
    add<Distance>(world, {ids[0], rope[0]});
    auto fresh = world; // a copy finds its blocks itself
    step(fresh, 0.01F);
    step(world, 0.01F);
    EXPECT_EQ(world.blocks.hanging.size(), 1U);
    EXPECT_EQ(fresh.blocks.hanging.size(), 1U);
    EXPECT_EQ(state_hash(world), state_hash(fresh));
}

} // namespace
} // namespace sinew
