#include "sinew/prefab/cloth.h"
#include "sinew/solver/contact_filter.h"

#include "tests/crates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

/// The program's word on contacts.
namespace sinew::SINEW_TEST_FILE {
namespace {

using World2 = test::Stepped<2, double>;

ColliderId add_slab(World2& world, double y, double turn = 0, double friction = 0.5) {
    return add_collider(world, collide::Collider<2, double>{
                                   .shape = collide::Box<2, double>{{{20, 0.2}}},
                                   .target = {.position = {0, y}, .rotation = collide::Rotation<2, double>::of(turn)},
                                   .friction = friction});
}
ParticleId add_stone(World2& world, double x, double y) {
    return add_particle(world, {.position = {{x, y}}, .radius = 0.1});
}
double height(const World2& world, ParticleId id) {
    return (*position_of(world, id))[1];
}

/// A loose particle is swept, a crate is held by rows.
TEST(ContactFilter, RefusedColliderIsNotThere) {
    World2 world;
    test::add_ground(world);
    add_slab(world, 2);
    const auto stone = add_stone(world, -2, 3);
    const auto crate = test::add_crate(world, 2, 3, 0.5, 1);
    auto kept = world;
    test::run(kept, 1.2);
    EXPECT_NEAR(height(kept, stone), 2.2, 0.01);
    EXPECT_NEAR(test::middle_of(kept, crate)[1], 2.35, 0.01);

    auto filter = [](const PendingContact& contact) { return contact.collider != 0; };
    world.solver.options.contact_filter = ContactFilter::of(filter);
    test::run(world, 1.2);
    EXPECT_NEAR(height(world, stone), 0.1, 0.01);
    EXPECT_NEAR(test::middle_of(world, crate)[1], 0.25, 0.01);
    EXPECT_TRUE(
        std::ranges::none_of(world.contacts.touching, [](const auto& touch) { return !is_plane(touch.collider); }));
}

/// Each crate lies on the ground, in the other one's place.
TEST(ContactFilter, RefusedFiguresPassThroughEachOther) {
    World2 world;
    test::add_ground(world);
    const auto low = test::add_crate(world, 0, 0.25, 0.5, 1), high = test::add_crate(world, 0.1, 1, 0.5, 1);
    auto kept = world;
    test::run(kept, 0.8);
    EXPECT_NEAR(test::middle_of(kept, high)[1], 0.75, 0.01);

    auto filter = [](const PendingContact& contact) { return contact.other == PendingContact::none; };
    world.solver.options.contact_filter = ContactFilter::of(filter);
    test::run(world, 0.8);
    EXPECT_NEAR(test::middle_of(world, low)[1], 0.25, 0.01);
    EXPECT_NEAR(test::middle_of(world, high)[1], 0.25, 0.01);
}

/// s = g sin(a) t^2 / 2 without friction; with friction 1 at 30 degrees nothing slides, since tan a < 1.
TEST(ContactFilter, FrictionIsThatOfTheProgram) {
    constexpr double angle = std::numbers::pi / 6, seconds = 1;
    for (const double friction : {0.0, 1.0}) {
        World2 world;
        test::fall(world, 10);
        add_slab(world, 0, -angle, 1 - friction);
        const double above = (0.1 + 0.1) / std::cos(angle);
        const auto stone = add_stone(world, 0, above);
        const auto crate =
            test::add_crate(world, -3, 3 * std::tan(angle) + (0.1 + 0.25) / std::cos(angle), 0.5, 1, -angle);
        const auto from = *position_of(world, stone), crate_from = test::middle_of(world, crate);
        auto filter = [&](PendingContact& contact) {
            contact.friction = friction;
            return true;
        };
        world.solver.options.contact_filter = ContactFilter::of(filter);
        test::run(world, seconds);
        const double way = friction > 0 ? 0 : 10 * std::sin(angle) * seconds * seconds / 2;
        EXPECT_NEAR(norm(test::middle_of(world, crate) - crate_from), way, 0.02) << friction;
        if (friction > 0) continue; // the stone would roll
        EXPECT_NEAR(norm(*position_of(world, stone) - from), way, 0.02);
    }
}

/// 5000 particles are worth several threads (workers.h), where the filter asks in one.
TEST(ContactFilter, AsksInTheOrderOfRowsWhateverTheThreads) {
    const auto asked = [](int threads) {
        World2 world;
        world.settings.substeps = 2;
        test::add_ground(world);
        for (int i = 0; i < 5000; ++i) add_stone(world, 0.3 * i, 0.09 + 0.0004 * (i % 20));
        world.solver.options.threads = threads;
        std::vector<Row> rows;
        auto filter = [&](const PendingContact& contact) {
            rows.push_back(contact.particle);
            return contact.particle % 3 != 0;
        };
        world.solver.options.contact_filter = ContactFilter::of(filter);
        test::run(world, 1.0 / 60);
        return std::pair{rows, state_hash(world)};
    };
    const auto alone = asked(1);
    EXPECT_GE(alone.first.size(), 5000U);
    EXPECT_EQ(alone, asked(4));
}

/// The filter of a simulation is not asked about another one, nor about the same one once it is taken away.
TEST(ContactFilter, IsAnOptionOfASimulation) {
    int asked = 0;
    auto filter = [&](const PendingContact&) { return ++asked > 0; };
    World2 world;
    test::add_ground(world);
    const auto stone = add_stone(world, 0, 0.1);
    auto other = world;
    world.solver.options.contact_filter = ContactFilter::of(filter);
    test::run(world, 0.1);
    EXPECT_GT(asked, 0);
    const int before = asked;
    test::run(other, 0.1);
    world.solver.options.contact_filter = {};
    test::run(world, 0.1);
    EXPECT_EQ(asked, before);
    EXPECT_NEAR(height(world, stone), 0.1, 1e-3);
}

/// The engine is built without exceptions, and a step has no state halfway.
TEST(ContactFilterDeathTest, ExceptionEndsTheProgram) {
    World2 world;
    test::add_ground(world);
    add_stone(world, 0, 0.1);
    auto filter = [](const PendingContact&) -> bool { throw std::runtime_error("of the filter"); };
    world.solver.options.contact_filter = ContactFilter::of(filter);
    EXPECT_DEATH(test::run(world, 0.1), "terminate.*of the filter");
}

/// Everything that touches, in one world: a chain, crates, stones, a sensor.
World2 crowded() {
    World2 world;
    test::add_ground(world);
    add_slab(world, 2, 0.1);
    add_collider(world, collide::Collider<2, double>{.shape = collide::Box<2, double>{{{2, 0.5}}},
                                                     .target = {.position = {{0, 1}}},
                                                     .is_sensor = true});
    for (int i = 0; i < 5; ++i) add_stone(world, -2 + 0.7 * i, 3), test::add_crate(world, -2 + i, 4, 0.5, 1, 0.2 * i);
    test::chain(world, 6, {{-1, 3.5}}, {{0.5, 3.5}});
    return world;
}

/// A filter that admits all changes no bit.
TEST(ContactFilter, ThatAdmitsAllChangesNothing) {
    auto world = crowded(), other = world;
    std::size_t asked = 0;
    auto filter = [&](const PendingContact&) { return ++asked > 0; };
    world.solver.options.contact_filter = ContactFilter::of(filter);
    for (int i = 0; i < 120; ++i) {
        test::step(world, 1.0 / 60), test::step(other, 1.0 / 60);
        ASSERT_EQ(state_hash(world), state_hash(other)) << i;
    }
    EXPECT_GT(asked, 1000U);
}

/// A chain is solved at once: refused, it falls through a slab onto the ground.
TEST(ContactFilter, IsAskedAboutBlocks) {
    World2 world;
    test::add_ground(world);
    add_slab(world, 2);
    const auto chain = test::chain(world, 6, {{-1, 3}}, {{1, 3}});
    const auto lowest = [&](const World2& of) {
        double low = 1e9;
        for (const auto id : chain) low = std::min(low, height(of, id));
        return low;
    };
    auto kept = world;
    test::run(kept, 1.5);
    EXPECT_FALSE(kept.solver.blocks.list.empty());
    EXPECT_NEAR(lowest(kept), 2.1, 0.02);
    auto filter = [](const PendingContact& contact) { return contact.collider == PendingContact::none; };
    world.solver.options.contact_filter = ContactFilter::of(filter);
    test::run(world, 1.5);
    EXPECT_NEAR(lowest(world), 0, 0.02);
    EXPECT_TRUE(
        std::ranges::none_of(world.contacts.touching, [](const auto& touch) { return !is_plane(touch.collider); }));
}

/// A refused sensor is not touched, by a stone on its way nor by a crate around it.
TEST(ContactFilter, IsAskedAboutSensors) {
    for (const bool admits : {true, false}) {
        World2 world;
        test::add_ground(world);
        add_collider(world, collide::Collider<2, double>{.shape = collide::Sphere<2, double>{0.05},
                                                         .target = {.position = {{2, 0.25}}},
                                                         .is_sensor = true});
        add_collider(world, collide::Collider<2, double>{.shape = collide::Sphere<2, double>{0.2},
                                                         .target = {.position = {{-2, 0.3}}},
                                                         .is_sensor = true});
        add_stone(world, -2, 0.6);
        test::add_crate(world, 2, 0.25, 0.5, 1);
        auto filter = [&](const PendingContact& contact) { return contact.collider == PendingContact::none || admits; };
        world.solver.options.contact_filter = ContactFilter::of(filter);
        test::run(world, 0.5);
        const auto touched =
            std::ranges::count_if(world.contacts.touching, [](const auto& touch) { return !is_plane(touch.collider); });
        EXPECT_EQ(touched, admits ? 2 : 0);
    }
}

/// A stone falls onto a level cloth that is held at its corners, or through it.
TEST(ContactFilter, IsAskedAboutFacesOfCloth) {
    for (const bool admits : {true, false}) {
        test::Stepped<3, double> world;
        test::fall(world, 10);
        const Cloth cloth{.columns = 9, .rows = 9, .spacing = 0.1, .plane = "horizontal", .pins = "all_corners"};
        const auto sheet = build(world, cloth, "sheet");
        ASSERT_TRUE(sheet) << sheet.problem;
        const auto figure = add_figure(world, "stone");
        set_contact(world, sheet, {.figures = true});
        set_contact(world, figure, {.figures = true});
        Vec3<double> middle{};
        for (const auto& position : world.particles.position) middle += position * (1 / double(world.particles.size()));
        const auto stone = add_particle(
            world,
            {.position = middle + Vec3<double>{{0.02, 0.3, 0.03}}, .mass = 0.1, .radius = 0.06, .figure = figure});
        world.figures[figure].particles.push_back(stone);
        auto filter = [&](const PendingContact&) { return admits; };
        world.solver.options.contact_filter = ContactFilter::of(filter);
        test::run(world, 1);
        const double fallen = middle[1] - (*position_of(world, stone))[1];
        if (admits)
            EXPECT_LT(fallen, 1);
        else
            EXPECT_NEAR(fallen, 5 - 0.3, 0.1);
    }
}

/// In classic mode, too.
TEST(ContactFilter, IsAskedInClassicMode) {
    World2 world;
    test::add_ground(world);
    world.settings.mode = Mode::classic;
    const auto stone = add_stone(world, 0, 1);
    auto filter = [](const PendingContact&) { return false; };
    world.solver.options.contact_filter = ContactFilter::of(filter);
    test::run(world, 1);
    EXPECT_LT(height(world, stone), -1);
}

/// Numbers out of range count as the nearest end of it, a NaN as 0.
TEST(ContactFilter, WrongNumbersDoNoHarm) {
    World2 world;
    test::add_ground(world);
    const auto stone = add_stone(world, 0, 0.5);
    auto filter = [](PendingContact& contact) {
        contact.friction = std::nan(""), contact.restitution = 1e300;
        return true;
    };
    world.solver.options.contact_filter = ContactFilter::of(filter);
    test::run(world, 2);
    EXPECT_TRUE(std::isfinite(height(world, stone)));
    EXPECT_LE(height(world, stone), 0.51);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
