#include "sinew/picture/draw.h"
#include "sinew/prefab/prefabs.h"
#include "sinew/session/session.h"

#include "tests/sanitized.h"
#include "tests/stepped.h"
#include "tests/worlds.h"

#include <malloc.h>

/// Figures come and go, and leave nothing.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Figures : ::testing::Test {};
TYPED_TEST_SUITE(Figures, Everywhere, Names);

TYPED_TEST(Figures, ARemovedOneTakesAllOfItsOwnAlong) {
    using Real = typename TypeParam::Real;
    auto world = menagerie<TypeParam::dimension, Real>();
    const auto before = state_hash(world);
    const auto particles = world.particles.size(), pins = world.pins.size();
    const auto rope = build(world, Rope{}, "late", {.at = at<typename TypeParam::Vector>(0, 5)});
    const auto loose = add_particle(world, {});
    const auto tied = add<Distance>(world, {world.figures[rope].particles[0], loose});
    const auto own = add<Distance>(world, {loose, world.particles.handles.id_of(0)}, {.figure = rope});
    pin(world, world.figures[rope].particles[3]);
    ASSERT_TRUE(find_figure(world, "late"));
    ASSERT_TRUE(remove_figure(world, rope));
    EXPECT_FALSE(remove_figure(world, rope));
    EXPECT_FALSE(find_figure(world, "late") || find_particle(world, "late/start"));
    EXPECT_FALSE(constraint_state(world, *tied)) << "what it was tied by";
    EXPECT_FALSE(constraint_state(world, *own)) << "what was its own between others";
    EXPECT_EQ(world.particles.size(), particles + 1);
    EXPECT_EQ(world.pins.size(), pins);
    remove_particles(world, std::vector{loose});
    EXPECT_EQ(state_hash(world), before) << "as if it had never been";
}

TYPED_TEST(Figures, OthersMoveOnAsIfItHadNeverBeen) {
    using Real = typename TypeParam::Real;
    auto world = menagerie<TypeParam::dimension, Real>();
    run(world, 0.2);
    auto never = world;
    for (int i = 0; i < 5; ++i) {
        const auto figure = build(world, Rope{}, "guest", {.at = at<typename TypeParam::Vector>(40, 5)});
        ASSERT_TRUE(remove_figure(world, figure));
        run(world, 0.1);
        run(never, 0.1);
        ASSERT_EQ(state_hash(world), state_hash(never));
    }
}

TEST(Figures, OthersKeepTheirIndicesNamesAndPieces) {
    test::Stepped<2, double> world;
    const auto a = build(world, Box{}, "a"), b = build(world, Box{}, "b", {.at = {{3, 0}}}),
               c = build(world, Box{}, "c", {.at = {{6, 0}}});
    const auto gone = figure_id(world, b), kept = figure_id(world, c);
    const auto pieces = world.figures[c].pieces.size();
    ASSERT_TRUE(remove_figure(world, gone));
    EXPECT_FALSE(figure_index(world, gone) || remove_figure(world, gone));
    EXPECT_EQ(figure_index(world, kept), c);
    EXPECT_EQ(find_figure(world, "c"), c);
    EXPECT_EQ(find_figure(world, "a"), a);
    EXPECT_TRUE(find_particle(world, "c/top_left"));
    EXPECT_EQ(world.figures[c].pieces.size(), pieces);
    EXPECT_TRUE(world.figures[b].pieces.empty());
    step(world, 1.0 / 60);

    const auto again = build(world, Box{}, "d");
    EXPECT_EQ(again, b) << "the lowest index that is free";
    EXPECT_FALSE(figure_index(world, gone)) << "which its old handle does not know";
    EXPECT_EQ(find_particle(world, "d/top_left"), world.figures[again].particles[0]);
    for (const FigureIndex index : {c, again, a}) EXPECT_TRUE(remove_figure(world, index));
    EXPECT_TRUE(world.figures.empty());
    EXPECT_EQ(world.particles.size(), 0U);
    EXPECT_TRUE(world.sweep.empty());
}

TEST(Figures, OfOneNameTheNextAnswersToItOnceTheFirstIsGone) {
    test::Stepped<2, double> world;
    std::vector<FigureIndex> all;
    for (int i = 0; i < 20; ++i) all.push_back(add_figure(world, "figure" + std::to_string(i % 10)));
    EXPECT_EQ(find_figure(world, "figure4"), all[4]);
    remove_figure(world, all[4]);
    EXPECT_EQ(find_figure(world, "figure4"), all[14]);
    remove_figure(world, all[14]);
    EXPECT_FALSE(find_figure(world, "figure4"));
}

std::size_t bytes_in_use() {
    return mallinfo2().uordblks + mallinfo2().hblkhd;
}

// Boxes and ragdolls are spawned, move and go again, beside others that stay.
TEST(Figures, AHundredThousandThatCameAndWentLeaveNoMoreThanTheFirstFew) {
    test::Stepped<2, double> world;
    fall(world, 10);
    build(world, Rope{}, "stays");
    const auto come_and_go = [&](int times) {
        for (int i = 0; i < times; ++i) {
            const auto name = "guest" + std::to_string(i);
            const bool large = i % 50 == 0;
            const auto one = large ? build(world, Ragdoll{}, name) : build(world, Rope{.segments = 2}, name);
            const auto other = build(world, Box{}, name);
            if (large) step(world, 1.0 / 60);
            ASSERT_TRUE(remove_figure(world, one) && remove_figure(world, other));
        }
    };
    come_and_go(500);
    const auto begun = bytes_in_use();
    const auto slots = world.particles.handles.indices();
    const auto capacity = world.particles.position.capacity();
    come_and_go(sanitized ? 500 : 50'000);
    EXPECT_EQ(world.figures.size(), 1U);
    EXPECT_EQ(world.figure_names.size(), 1U);
    EXPECT_EQ(world.particles.handles.indices(), slots);
    EXPECT_EQ(world.particles.position.capacity(), capacity);
    EXPECT_LE(bytes_in_use(), begun + 4096);
}

TEST(Figures, ARunningSessionLosesOneAndGoesBackToWhereItHadIt) {
    auto document = load(R"({"sinew": 1, "figures": [
        {"prefab": "box", "name": "a"},
        {"prefab": "box", "name": "b", "at": [3, 0], "looks": {"all": {"color": "red"}}},
        {"prefab": "box", "name": "c", "at": [6, 0]}]})",
                         "removal.json");
    auto opened = open_scene(document);
    ASSERT_TRUE(opened) << to_text(document.diagnostics);
    Session session(std::move(*opened));
    session.run_until(0.1);
    const auto snapshot = session;
    const auto removed = [](Session& one, FigureIndex index) {
        return std::visit([&](auto& world) { return remove_figure(world, index); }, one.world());
    };
    ASSERT_TRUE(removed(session, 1));
    session.run_until(0.3);
    Picture picture;
    picture.width = 200, picture.height = 100;
    draw(session, picture, OverlaySet{});
    EXPECT_EQ(session.report().particles, 8U);
    session = snapshot;
    EXPECT_EQ(session.report().hash, snapshot.report().hash);
    session.run_until(0.3);
    EXPECT_EQ(session.report().particles, 12U);
    removed(session, 0);
    session.restart();
    EXPECT_EQ(session.report().particles, 12U);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
