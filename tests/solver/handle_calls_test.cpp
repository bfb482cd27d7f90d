#include "sinew/prefab/prefabs.h"

#include "tests/stepped.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <array>

/// Very many calls with handles of every sort, in worlds that stay small: living, stale, of another world, of a future
/// that was undone, made up. A handle that stands for nothing does nothing and says so; the rest is up to the address
/// sanitizer.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;
using World2 = test::Stepped<2, double>;
using Vector = Vec2<double>;

struct Handles {
    std::vector<ParticleId> particles;
    std::vector<ConstraintId> constraints;
    std::vector<PinId> pins;
    std::vector<FigureId> figures;
};

struct Playground {
    World2 world;
    Handles handles;
};

class Calls {
  public:
    explicit Calls(std::uint64_t seed) : seed_(seed) {}

    int below(int count) { return int(random::whole(0, count - 1, seed_, 0, drawn_++)); }

    /// One call upon `here`; some of its handles are those of `there`.
    void call(Playground& here, const Playground& there) {
        here_ = &here, there_ = &there;
        using Call = void (Calls::*)();
        static constexpr std::array calls = {&Calls::add_row, &Calls::add_box, &Calls::join, &Calls::unjoin,
                                             &Calls::remove,  &Calls::hold,    &Calls::move, &Calls::push,
                                             &Calls::motor,   &Calls::vanish,  &Calls::ask};
        (this->*Call(calls[std::size_t(below(int(calls.size())))]))();
    }

  private:
    std::uint64_t seed_, drawn_ = 0;
    Playground* here_ = nullptr;
    const Playground* there_ = nullptr;
    static constexpr std::size_t many = 60; ///< particles: of more, no more are made

    World2& world() { return here_->world; }
    std::uint32_t any_number() {
        if (below(3) == 0) return std::uint32_t(below(100));
        return below(3) == 0 ? ~0U - std::uint32_t(below(3)) : std::uint32_t(below(std::numeric_limits<int>::max()));
    }
    Vector vector() {
        return Vector::map([&](int) { return below(30) == 0 ? 1e38 : 4 * random::uniform(seed_, 1, drawn_++) - 2; });
    }
    /// One of the last that were given out, mostly of this world.
    template <class Id> Id one_of(std::vector<Id> Handles::*list, const Id& made_up) {
        const auto& all = (below(15) == 0 ? there_->handles : here_->handles).*list;
        if (all.empty() || below(12) == 0) return made_up;
        return all[all.size() - 1 - std::size_t(below(int(std::min<std::size_t>(all.size(), many))))];
    }
    ParticleId particle() { return one_of(&Handles::particles, {any_number(), any_number()}); }
    ConstraintId constraint() { return one_of(&Handles::constraints, {below(20) - 5, {any_number(), any_number()}}); }
    PinId pinned() { return one_of(&Handles::pins, {any_number(), any_number()}); }
    FigureId figure() { return one_of(&Handles::figures, {any_number(), any_number()}); }
    FigureIndex index() { return below(3) == 0 ? FigureIndex(any_number()) : FigureIndex(below(20)); }

    /// Whether it stands for a particle, which then is known by no other handle.
    bool is_known(ParticleId id) {
        const auto row = row_of(world(), id);
        if (!row) return false;
        EXPECT_LT(*row, world().particles.size());
        EXPECT_EQ(world().particles.handles.id_of(*row), id);
        return true;
    }

    // --- calls ---------------------------------------------------------------------------------------------------

    void add_row() {
        if (world().particles.size() > many) return;
        const auto at = vector();
        for (int i = 0; i < 4; ++i) {
            auto& [particles, constraints, pins, figures] = here_->handles;
            const auto id = add_particle(world(), {.position = at + Vector{{0.2 * i, 0}}, .figure = index()});
            if (i > 0) constraints.push_back(*add<Distance>(world(), {particles.back(), id}));
            particles.push_back(id);
        }
    }
    void add_box() {
        if (world().particles.size() > many) return;
        const auto box = build(world(), Box{}, "box");
        auto& handles = here_->handles;
        handles.figures.push_back(figure_id(world(), box));
        for (const auto id : world().figures[box].particles) handles.particles.push_back(id);
        for (const auto id : world().figures[box].constraints) handles.constraints.push_back(id);
    }
    void join() {
        const std::vector members = {particle(), particle(), particle()};
        const auto id = add_constraint<2, double>(world(), below(20) - 5, members, {.figure = index()});
        if (!id) return;
        for (const auto member : members) EXPECT_TRUE(row_of(world(), member));
        here_->handles.constraints.push_back(*id);
    }
    void unjoin() { remove_constraints(world(), std::vector{constraint(), constraint()}); }
    void remove() {
        const auto id = particle();
        const bool known = is_known(id);
        EXPECT_EQ(remove_particles(world(), std::vector{id}), known ? 1U : 0U);
    }
    void hold() {
        const auto id = particle();
        const bool known = is_known(id);
        const auto held = pin(world(), id);
        EXPECT_EQ(held.has_value(), known);
        if (held) here_->handles.pins.push_back(*held);
        if (below(2) == 0) unpin(world(), pinned());
        move_pin(world(), pinned(), vector());
    }
    void move() {
        const auto id = particle();
        const bool known = is_known(id);
        EXPECT_EQ(set_position(world(), id, vector()), known);
        EXPECT_EQ(set_velocity(world(), id, vector()), known);
        teleport(world(), index(), vector());
    }
    void push() {
        const auto id = particle();
        const bool known = is_known(id);
        EXPECT_EQ(apply_force(world(), id, vector()), known);
        EXPECT_EQ(apply_impulse(world(), id, vector()), known);
        EXPECT_EQ(set_mass(world(), id, 1.0 + below(3)), known);
    }
    void motor() {
        const auto id = constraint();
        const bool known = constraint_state(world(), id).has_value();
        EXPECT_EQ(set_max_force(world(), id, 5.0), known);
        EXPECT_EQ(drive(world(), id, below(5) - 2.0), known);
    }
    void vanish() {
        const auto id = figure();
        const bool known = figure_index(world(), id).has_value();
        EXPECT_EQ(remove_figure(world(), id), known);
        if (below(4) == 0) remove_figure(world(), index());
    }
    void ask() {
        const auto id = particle();
        const bool known = is_known(id);
        EXPECT_EQ(position_of(world(), id).has_value(), known);
        EXPECT_TRUE(known || unpin_all(world(), id) == 0);
        release_quarantine(world(), index());
    }
};

void expect_whole(const World2& world) {
    const auto& p = world.particles;
    p.columns(p, [&](const auto& column) { ASSERT_EQ(column.size(), p.size()); });
    for_each_table(world, [](const auto& table) {
        table.columns(table, [&](const auto& column) { ASSERT_EQ(column.size(), table.size()); });
        ASSERT_EQ(table.members.size(), table.size());
    });
}

TEST(HandleCalls, OneThatStandsForNothingDoesNothingAndSaysSo) {
    constexpr int calls = 2000;
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(10, 500)); ++seed) {
        Calls any(seed);
        Playground here, there;
        World2 snapshot;
        for (int i = 0; i < calls; ++i) {
            any.call(here, there);
            if (any.below(3) == 0) any.call(there, here);
            if (any.below(25) == 0) snapshot = here.world;
            if (any.below(25) == 0) here.world = snapshot;
            if (any.below(200) == 0) std::swap(here.world, there.world);
            if (any.below(40) == 0) step(here.world, 1.0 / 60);
            ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << ", call " << i;
        }
        expect_whole(here.world);
        expect_whole(there.world);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
