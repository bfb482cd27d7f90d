#include "tests/stepped.h"
#include "tests/worlds.h"

/// What is rebuilt after a change, and what is kept.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

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

    /// SweepState, and tied to its first corner and its last. Particles are added this far on each time, which must
    /// have no divisor in common with their number: in no order that leads anywhere.
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
            remove_constraints(world, std::vector{one(constraints, 3)});
            return;
        case 2:
            remove_particles(world, std::vector{p});
            return;
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

template <class Type> struct Rebuilt : ::testing::Test {};
TYPED_TEST_SUITE(Rebuilt, Everywhere, Names);

// What is rebuilt of blocks and plan after a change is what would be built of the whole world.
TYPED_TEST(Rebuilt, AWorldThatIsChangedMovesAsOneBuiltSo) {
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
            ASSERT_EQ(fresh.solver.blocks.list.size(), changed.solver.blocks.list.size());
            ASSERT_EQ(fresh.solver.blocks.attached_trees.size(), changed.solver.blocks.attached_trees.size());
            ASSERT_EQ(fresh.solver.sweep_state.row_of, changed.solver.sweep_state.row_of)
                << "after change " << i << ", seed " << seed;
            ASSERT_EQ(fresh.solver.sweep_state.plan.runs.size(), changed.solver.sweep_state.plan.runs.size());
            ASSERT_EQ(fresh.solver.sweep_state.plan.tethers.size(), changed.solver.sweep_state.plan.tethers.size());
            jumble.world = std::move(changed);
        }
    }
}

// And only that: a cut among many ropes leaves the others where they are.
TEST(Rebuild, ACutFindsNoMoreThanItsOwnRopeAgain) {
    test::Stepped<2, double> world;
    for (int i = 0; i < 20; ++i) pin(world, chain(world, 12, {{double(i), 0}}, {{0, -0.1}})[0]);
    prepare(world);
    const auto nodes = world.solver.blocks.nodes.size();
    const auto& links = std::get<kind_number<Distance, 2>>(world.constraints);
    remove_constraints(world, std::vector{ConstraintId{kind_number<Distance, 2>, links.handles.id_of(60)}});
    prepare(world);
    EXPECT_EQ(world.solver.blocks.list.size(), 21U);
    EXPECT_EQ(world.solver.blocks.room.members.size(), 11U) << "its particles that move";
    EXPECT_LE(world.solver.blocks.nodes.size(), nodes + 12);
}

// What joins each particle of a large cloth is only listed when something of it changes.
TEST(Rebuild, ALargeClothHasNoBlocksUntilARopeHangsFromIt) {
    constexpr std::size_t side = 230; // 105,340 links
    test::Stepped<2, float> world;
    world.settings.substeps = 1;
    std::vector<ParticleId> ids;
    for (std::size_t i = 0; i < side * side; ++i)
        ids.push_back(add_particle(world, {.position = {{float(i % side), float(i / side)}}}));
    for (std::size_t i = 0; i < side * side; ++i) {
        if (i % side + 1 < side) add<Distance>(world, {ids[i], ids[i + 1]});
        if (i / side + 1 < side) add<Distance>(world, {ids[i], ids[i + side]});
    }
    prepare(world);
    EXPECT_FALSE(world.journal.adjacency.listed());
    EXPECT_TRUE(world.solver.blocks.list.empty());
    const auto rope = chain(world, 5, {{0, -1}}, {{0, -1}});
    add<Distance>(world, {ids[0], rope[0]});
    auto fresh = world; // a copy finds its blocks itself
    step(fresh, 0.01F);
    step(world, 0.01F);
    EXPECT_EQ(world.solver.blocks.attached_trees.size(), 1U);
    EXPECT_EQ(fresh.solver.blocks.attached_trees.size(), 1U);
    EXPECT_EQ(state_hash(world), state_hash(fresh));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
