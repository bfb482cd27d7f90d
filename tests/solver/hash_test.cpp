#include "tests/worlds.h"

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct StateHash : ::testing::Test {};
TYPED_TEST_SUITE(StateHash, Everywhere, Names);

TYPED_TEST(StateHash, ACopyHasTheSameHashAndTheSameFuture) {
    using Real = typename TypeParam::Real;
    for (const Mode mode : {Mode::physical, Mode::classic}) {
        auto world = menagerie<TypeParam::dimension, Real>(mode);
        run(world, 0.5);
        auto copy = world;
        EXPECT_EQ(state_hash(copy), state_hash(world));
        run(world, 0.5);
        run(copy, 0.5);
        EXPECT_EQ(state_hash(copy), state_hash(world));
    }
}

template <int kind, class World> void move_limits(World& world, int low, int high) {
    using Real = typename World::Real;
    auto& table = std::get<kind>(world.constraints);
    table.limits.set(0, table.low(0) + Real(low), table.high(0) + Real(high));
}

TYPED_TEST(StateHash, ChangesWithEverythingThatDecidesTheFuture) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    const auto edits = {
        +[](World& w) { w.particles.position[2][1] += 1; },
        +[](World& w) { w.particles.previous[2][1] += 1; },
        +[](World& w) { w.particles.velocity[2][1] += 1; },
        +[](World& w) { w.particles.residual[2][1] += 1; },
        +[](World& w) { apply_force(w, w.particles.handles.id_of(1), at<Vector>(1, 0)); },
        +[](World& w) { set_mass(w, w.particles.handles.id_of(1), typename World::Real(7)); },
        +[](World& w) { w.particles.radius[1] += 1; },
        +[](World& w) { w.particles.quarantined[1] = 1; },
        +[](World& w) { w.particles.mobility[1] = 0; },
        +[](World& w) { w.figures[0].direct = Direct::off; },
        +[](World& w) { w.figures[0].tethers = true; },
        +[](World& w) { std::get<0>(w.constraints).figure.set(0, 0); },
        +[](World& w) { add_particle(w, {}); },
        +[](World& w) { move_limits<0>(w, -1, 0); },
        +[](World& w) { move_limits<1>(w, 0, 1); },
        +[](World& w) { std::get<2>(w.constraints).compliance.set(0, 1); },
        +[](World& w) { std::get<0>(w.constraints).relaxation.set(0, typename World::Real(0.5)); },
        +[](World& w) { std::get<0>(w.constraints).split.set(0, typename World::Real(0.6)); },
        +[](World& w) { std::get<0>(w.constraints).breaking_strain.set(0, 1); },
        +[](World& w) { std::get<0>(w.constraints).damage_limit.set(0, 1); },
        +[](World& w) { std::get<0>(w.constraints).members[0][0] = 3; },
        +[](World& w) { std::swap(w.sweep[0].count, w.sweep[1].count); },
        +[](World& w) { unpin(w, w.pin_handles.id_of(0)); },
        +[](World& w) { move_pin(w, w.pin_handles.id_of(0), at<Vector>(9, 9)); },
        +[](World& w) { w.pins[0].compliance = 1; },
        +[](World& w) { w.forces.remove(w.forces.id_of(Row(w.forces.size() - 1))); },
        +[](World& w) { std::get<Wind<World::dimension, typename World::Real>>(w.forces[2]).seed += 1; },
        +[](World& w) { std::get<Attractor<World::dimension, typename World::Real>>(w.forces[3]).softness += 1; },
        +[](World& w) { w.bounds[0].restitution = 0; },
        +[](World& w) { w.bounds.pop_back(); },
        +[](World& w) { w.settings.substeps += 1; },
        +[](World& w) { w.settings.damping += 1; },
        +[](World& w) { w.settings.mode = Mode::classic; },
        +[](World& w) { w.settings.classic.halved_acceleration = true; },
        +[](World& w) { w.settings.classic.dropped_leftover = true; },
        +[](World& w) { w.settings.classic.moves_each_pass = true; },
        +[](World& w) { w.pins[0].hold = Hold::corrected; },
        +[](World& w) { w.pins[0].steer[0] = 1; },
        +[](World& w) { w.pins[0].steer_damping = 1; },
        +[](World& w) { w.settings.classic.integrator = Integrator::rk4; },
        +[](World& w) { w.figures[0].integrator = Integrator::verlet; },
        +[](World& w) { std::get<Attractor<World::dimension, typename World::Real>>(w.forces[3]).figure = 0; },
        +[](World& w) { w.time += 1; },
        +[](World& w) { w.steps += 1; },
        +[](World& w) { w.last_step *= 2; },
        +[](World& w) { w.last_substep *= 2; },
    };
    auto world = menagerie<TypeParam::dimension, typename TypeParam::Real>();
    run(world, 0.25);
    int number = 0;
    for (const auto& edit : edits) {
        auto changed = world;
        edit(changed);
        EXPECT_NE(state_hash(changed), state_hash(world)) << "edit " << number;
        ++number;
    }
}

TYPED_TEST(StateHash, IsTheSameHoweverColumnsAreHeld) {
    auto world = menagerie<TypeParam::dimension, typename TypeParam::Real>();
    const auto before = state_hash(world);
    for_each_table(world, [](auto& table) {
        table.columns(table, [](auto& column) {
            if constexpr (requires { column.set_apart(); }) column.set_apart();
        });
    });
    EXPECT_EQ(state_hash(world), before);
}

TEST(Column, HoldsOneValueUntilARowDiffers) {
    Column<double> column;
    column.append(4, 2);
    column.set(1, 2);
    EXPECT_TRUE(column.each().empty());
    column.set(1, 3);
    column.append(1, 4);
    EXPECT_EQ(column.rows(), (std::vector<double>{2, 3, 2, 2, 4}));
    erase_rows(column, std::vector<char>{1, 0, 0, 1, 0});
    EXPECT_EQ(column.rows(), (std::vector<double>{3, 2, 4}));
    column.fill(5);
    EXPECT_EQ(column.rows(), (std::vector<double>{5, 5, 5}));

    Column<double> zeros;
    for (const double zero : {0.0, 0.0, -0.0}) zeros.append(1, zero);
    EXPECT_TRUE(std::signbit(zeros[2])) << "the same to the last bit";
    Column<double> alike;
    alike.append(3, 7);
    erase_rows(alike, std::vector<char>{0, 1, 0});
    EXPECT_EQ(alike.size(), 2U);
    EXPECT_FALSE(alike.any_of([](double value) { return value != 7; }));
}

TYPED_TEST(StateHash, IgnoresNamesAndDrawing) {
    auto world = menagerie<TypeParam::dimension, typename TypeParam::Real>();
    const auto hash = state_hash(world);
    world.figures[0].name = "somebody else";
    world.figures[0].pieces.emplace_back().part = "arm";
    EXPECT_EQ(state_hash(world), hash);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
