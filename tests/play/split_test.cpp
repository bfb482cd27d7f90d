#include "player/script.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/play/game.h"

#include <gtest/gtest.h>

/// Classic and physical mode side by side.
namespace sinew::play::SINEW_TEST_FILE {
namespace {

using games::library;
using games::pixel_of;
using games::run;

struct SplitView : testing::Test {
    SplitView() {
        play.resize(1000, 500);
        play.toggle_split();
    }
    /// Results of tell() for each pane, in order.
    template <class Tell> auto each(Tell&& tell) {
        std::vector<decltype(tell())> all;
        play.each_pane([&] { all.push_back(tell()); });
        return all;
    }
    Play play{library, "ragdoll"};
};

TEST_F(SplitView, ShowsBothModesFromTheStartInLockstep) {
    ASSERT_EQ(play.pane_count(), 2U) << play.problem();
    const auto modes = each([&] { return play.session().scene().solver.mode; });
    EXPECT_EQ(modes, (std::vector<std::string>{"classic", "physical"}));
    for (int i = 0; i < 90; ++i) play.advance(1.0 / 60);
    const auto steps = each([&] { return play.timeline().now(); });
    EXPECT_EQ(steps[0], 90U);
    EXPECT_EQ(steps[1], 90U);
    // Each is what it would be alone.
    for (const char* mode : {"classic", "physical"}) {
        Play alone(library, "ragdoll", {Override{std::string("mode=") + mode, "test"}});
        for (int i = 0; i < 90; ++i) alone.advance(1.0 / 60);
        EXPECT_EQ(each([&] { return play.hash(); })[mode == std::string("physical")], alone.hash()) << mode;
    }
}

TEST_F(SplitView, ThePointerTakesTheSameParticleInBoth) {
    run("size 1000x500\n0 key p\n0 move bob/right_hand over 0\n0.1 press\n0.1 key p\n0.2 move 100 100 over 0\n"
        "1.5 end",
        play);
    EXPECT_EQ(play.active_pane(), 0U);
    for (const bool held : each([&] { return play.session().hand() != nullptr; })) EXPECT_TRUE(held);
    const auto hands = each([&] { return pixel_of(play, "bob/right_hand"); });
    EXPECT_LT(distance(hands[0], Vec2<double>{{100, 100}}), 2);
    EXPECT_GT(hands[1][1], 0);
    EXPECT_LT(hands[1][1], 250) << "it was carried up as well";
    play.handle(Released{});
    for (const bool held : each([&] { return play.session().hand() != nullptr; })) EXPECT_FALSE(held);
}

TEST_F(SplitView, EditsCutsAndUndosHappenInBoth) {
    EXPECT_TRUE(play.set("figures.bob.height", "150")) << play.problem();
    for (const auto& height : each([&] { return play.timeline().undo_name(); }))
        EXPECT_EQ(height, "figures.bob.height");
    play.undo();
    for (const auto edits : each([&] { return play.timeline().edits(); })) EXPECT_EQ(edits, 0);
    const auto before = each([&] { return play.session().report().constraints; });
    const auto hand = pixel_of(play, "bob/right_hand");
    play.handle(Moved{{0, hand[1] - 100}});
    play.handle(Pressed{Button::right});
    for (double y = hand[1] - 100; y < hand[1] + 60; y += 20)
        for (const double x : {499, 1}) play.handle(Moved{{x, y}});
    play.handle(Released{Button::right});
    const auto after = each([&] { return play.session().report().constraints; });
    EXPECT_LT(after[0] + after[1], before[0] + before[1]);
    play.undo();
    EXPECT_EQ(each([&] { return play.session().report().constraints; }), before);
}

TEST_F(SplitView, TheHalfUnderThePointerStaysWhenTheOtherIsClosed) {
    for (int i = 0; i < 30; ++i) play.advance(1.0 / 60);
    const auto hashes = each([&] { return play.hash(); });
    play.handle(Moved{{800, 250}});
    EXPECT_EQ(play.active_pane(), 1U);
    play.handle(Key{"e"});
    EXPECT_EQ(play.pane_count(), 1U);
    EXPECT_EQ(play.hash(), hashes[1]);
    EXPECT_EQ(play.session().scene().solver.mode, "physical");
}

// Edits from before the split are still to be saved, in the mode that the scene had.
TEST_F(SplitView, AnEditBeforeItIsNotLost) {
    Play edited(games::library, "rope");
    edited.handle(Key{"g"});
    edited.toggle_split();
    ASSERT_TRUE(edited.is_split());
    EXPECT_TRUE(edited.would_lose());
    edited.handle(Key{"g"});
    EXPECT_FALSE(edited.would_lose()) << "it is as it was";
    edited.handle(Key{"g"});
    edited.handle(Moved{{{1, 1}}}); // over the classic half
    EXPECT_EQ(edited.session().scene().solver.mode, "classic");
    const ScratchFolder folder;
    ASSERT_TRUE(edited.save(folder / "mine.json"));
    EXPECT_FALSE(edited.would_lose());
    const auto saved = games::read(sinew::text_of(folder / "mine.json"), "mine");
    ASSERT_TRUE(saved.opened) << saved.problem;
    EXPECT_EQ(saved.opened->scene.solver.mode, "physical");
    EXPECT_EQ(saved.opened->scene.world.gravity, Point{});
}

TEST_F(SplitView, APictureHasBothHalvesUnderTheirNames) {
    Picture picture;
    play.draw(picture);
    EXPECT_GE(picture.width, 1000);
    EXPECT_GT(picture.height, 500);
    for (const char* mode : {"classic", "physical"})
        EXPECT_NE(std::find(picture.texts.begin(), picture.texts.end(), mode), picture.texts.end()) << mode;
    std::vector<Picture> panes;
    play.draw_panes(panes);
    ASSERT_EQ(panes.size(), 2U);
    EXPECT_EQ(panes[0].width, 500);
    EXPECT_GE(picture.items.size(), panes[0].items.size() + panes[1].items.size() - 4) << "all that panes show";
}

// The scene with the pin has the other mode's particles, too; both halves show where it is held.
TEST_F(SplitView, ShowsAPinThatWasPutByHandInBoth) {
    play.toggle_split();
    play.show_mode("physical");
    ASSERT_EQ(play.pane_count(), 1U);
    for (int i = 0; i < 30; ++i) play.advance(1.0 / 60);
    play.tool = "pin";
    play.handle(Moved{pixel_of(play, "bob/right_hand")});
    play.handle(Pressed{});
    play.handle(Released{});
    ASSERT_EQ(play.session().scene().pins.size(), 1U);
    play.toggle_split();
    ASSERT_EQ(play.pane_count(), 2U) << play.problem();
    for (const auto pins : each([&] { return play.session().scene().pins.size(); })) EXPECT_EQ(pins, 1U);
    std::vector<Picture> pictures;
    play.draw_panes(pictures);
    const auto discs = [](const Picture& picture) {
        return std::count_if(picture.items.begin(), picture.items.end(),
                             [](const auto& item) { return item.shape == Shape::disc; });
    };
    const std::vector<std::ptrdiff_t> with = {discs(pictures[0]), discs(pictures[1])};
    play.undo();
    play.change([](Scene& scene) { scene.pins.clear(); }, "no pins");
    play.draw_panes(pictures);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_GE(with[i], discs(pictures[i]) + 2) << "a pin is always to be seen";
}

} // namespace
} // namespace sinew::play::SINEW_TEST_FILE
