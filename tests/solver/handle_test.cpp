#include "tests/random_calls.h"
#include "tests/stepped.h"
#include "tests/thorough.h"

#include <map>

/// A handle stands for what it was given out for, or for nothing.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;
using World2 = test::Stepped<2, double>;

/// A particle that can be told by its radius.
ParticleId numbered(World2& world, double number) {
    return add_particle(world, {.radius = number});
}

TEST(Handle, FromAFutureThatWasUndoneStandsForNothing) {
    World2 world;
    numbered(world, 1);
    const auto removed = numbered(world, 2);
    numbered(world, 3);
    remove_particles(world, std::vector{removed}); // from now on slots are not rows
    const auto snapshot = world;
    const auto undone = numbered(world, 4);
    ASSERT_TRUE(row_of(world, undone));
    world = snapshot;
    EXPECT_FALSE(row_of(world, undone)) << "its slot is free";
    const auto other = numbered(world, 5);
    EXPECT_EQ(other.index, undone.index);
    EXPECT_FALSE(row_of(world, undone)) << "its slot is another's";
    EXPECT_FALSE(set_mass(world, undone, 7.0));
    EXPECT_TRUE(row_of(world, other));
}

TEST(Handle, OfAnotherWorldStandsForNothing) {
    World2 world, other;
    const auto foreign = chain(other, 3, {}, {{1, 0}});
    const auto own = chain(world, 3, {}, {{1, 0}});
    const auto held = *pin(other, foreign[0]);
    pin(world, own[0]);
    const auto hash = state_hash(world);
    EXPECT_FALSE(row_of(world, foreign[0]));
    EXPECT_FALSE(unpin(world, held) || move_pin(world, held, {}) || pin(world, foreign[1]));
    EXPECT_FALSE(add<Distance>(world, {own[0], foreign[1]}));
    EXPECT_EQ(remove_particles(world, std::span<const ParticleId>(foreign)), 0U);
    EXPECT_EQ(unpin_all(world, foreign[0]), 0U);
    EXPECT_EQ(state_hash(world), hash);
}

TEST(Handle, GivenOutBeforeACopyIsKnownToBoth) {
    World2 world;
    const auto ids = chain(world, 3, {}, {{1, 0}});
    auto copy = world;
    EXPECT_EQ(row_of(copy, ids[2]), row_of(world, ids[2]));
    const auto here = numbered(world, 1), there = numbered(copy, 2);
    EXPECT_FALSE(row_of(copy, here));
    EXPECT_FALSE(row_of(world, there));
    auto moved = std::move(world);
    EXPECT_TRUE(row_of(moved, here)) << "a world that is moved stays the same";
    EXPECT_TRUE(row_of(moved, numbered(moved, 3)));
}

TEST(Handle, MadeUpStandsForNothingWhateverItSays) {
    World2 world;
    const auto ids = chain(world, 4, {}, {{1, 0}});
    const auto held = *pin(world, ids[0]);
    remove_particles(world, std::vector{ids[1]});
    const auto hash = state_hash(world);
    for (const std::uint32_t slot : {0U, 1U, 2U, 5U, 1000U, ~0U - 1, ~0U})
        for (const std::uint32_t generation : {0U, 1U, ~0U}) {
            if (generation == ids[0].generation || generation == held.generation) continue;
            const ParticleId id{slot, generation};
            EXPECT_FALSE(row_of(world, id) || set_position(world, id, {}) || unpin(world, {slot, generation}));
            for (const int kind : {-1, 0, 1, 99}) {
                const ConstraintId made_up{kind, {slot, generation}};
                EXPECT_FALSE(constraint_state(world, made_up) || drive(world, made_up, 1.0) ||
                             set_max_force(world, made_up, 1.0));
                EXPECT_EQ(remove_constraints(world, std::vector{made_up}), 0U);
            }
            EXPECT_FALSE(figure_index(world, {slot, generation}));
            EXPECT_FALSE(remove_figure(world, FigureIndex(slot)) || teleport(world, FigureIndex(slot), {{1, 0}}) ||
                         release_quarantine(world, FigureIndex(slot)));
        }
    EXPECT_EQ(state_hash(world), hash);
}

TEST(Handle, AMadeUpFigureOwnsNothing) {
    World2 world;
    const auto a = add_particle(world, {.figure = 3}), b = add_particle(world, {.position = {{1, 0}}, .figure = 0});
    add<Distance>(world, {a, b}, {.figure = 0});
    add_figure(world, "late");
    EXPECT_EQ(world.particles.figure, (std::vector{no_figure, no_figure}));
    EXPECT_TRUE(remove_figure(world, 0U));
    EXPECT_EQ(world.particles.size(), 2U);
}

/// A world, and what each of its handles stands for: particles by their radius.
struct Ledger {
    World2 world;
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> living;
};

// Additions, removals, copies and ways back at random, against a plain list of who lives where.
TEST(Handle, StandsForTheSameThroughAnyHistory) {
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(20, 400)); ++seed) {
        std::vector<Ledger> ledgers(3);
        std::vector<ParticleId> all;
        std::uint64_t drawn = 0;
        const auto below = [&](std::size_t count) {
            return std::size_t(random::whole(0, std::int64_t(count) - 1, seed, 0, drawn++));
        };
        for (int number = 1; number <= 300; ++number) {
            auto& [world, living] = ledgers[below(ledgers.size())];
            switch (below(4)) {
            case 0:
            case 1:
                all.push_back(numbered(world, number));
                living[{all.back().index, all.back().generation}] = number;
                break;
            case 2:
                if (all.empty()) break;
                if (const auto gone = all[below(all.size())]; remove_particles(world, std::vector{gone}) > 0)
                    living.erase({gone.index, gone.generation});
                break;
            default:
                if (below(4) == 0) ledgers[below(ledgers.size())] = Ledger(ledgers[below(ledgers.size())]);
            }
            for (const auto& ledger : ledgers)
                for (const auto id : all) {
                    const auto row = row_of(ledger.world, id);
                    const auto known = ledger.living.find({id.index, id.generation});
                    ASSERT_EQ(row.has_value(), known != ledger.living.end()) << "seed " << seed << ", " << number;
                    if (row) {
                        ASSERT_EQ(ledger.world.particles.radius[*row], known->second);
                    }
                }
        }
    }
}

// Every call with any handle, stale, foreign or of a future that was undone: what the address sanitizer says is what
// counts. Columns stay equally long.
TEST(Handle, OfAnyKindDoNoHarmToAnyCall) {
    const int calls = few_or_many(400, 1000);
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(8, 20)); ++seed) {
        RandomCalls<World2> one(seed), other(seed + 1000);
        auto snapshot = one.world;
        for (int i = 0; i < calls; ++i) {
            one.call();
            if (one.one_in(3)) other.call();
            if (one.one_in(20)) snapshot = one.world;
            if (one.one_in(20)) one.world = snapshot;
            if (one.one_in(40)) {
                std::swap(one.particles, other.particles);
                std::swap(one.constraints, other.constraints);
                std::swap(one.pins, other.pins);
                std::swap(one.figures, other.figures);
            }
            if (one.one_in(10)) step(one.world, 1.0 / 60);
        }
        const auto& p = one.world.particles;
        p.columns(p, [&](const auto& column) { ASSERT_EQ(column.size(), p.size()); });
        for_each_table(one.world, [](const auto& table) {
            table.columns(table, [&](const auto& column) { ASSERT_EQ(column.size(), table.size()); });
            ASSERT_EQ(table.members.size(), table.size());
        });
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
