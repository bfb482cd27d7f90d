#include "apps/play/script.h"
#include "tests/play/game.h"

#include <gtest/gtest.h>

/// Classic and physical mode side by side.
namespace sinew::play {
namespace {

using games::pixel_of;
using games::run;
using games::shelf;

struct Split : testing::Test {
    Split() {
        play.resize(1000, 500);
        play.toggle_split();
    }
    /// Of each pane.
    template <class Tell> auto each(Tell&& tell) {
        std::vector<decltype(tell())> all;
        play.each_pane([&] { all.push_back(tell()); });
        return all;
    }
    Play play{shelf, "ragdoll"};
};

TEST_F(Split, ShowsBothModesFromTheStartInLockstep) {
    ASSERT_EQ(play.pane_count(), 2U) << play.problem();
    const auto modes = each([&] { return play.session().scene().solver.mode; });
    EXPECT_EQ(modes, (std::vector<std::string>{"classic", "physical"}));
    for (int i = 0; i < 90; ++i) play.advance(1.0 / 60);
    const auto steps = each([&] { return play.tape().now(); });
    EXPECT_EQ(steps[0], 90U);
    EXPECT_EQ(steps[1], 90U);
    // Each is what it would be alone.
    for (const char* mode : {"classic", "physical"}) {
        Play alone(shelf, "ragdoll", {Override{std::string("mode=") + mode, "test"}});
        for (int i = 0; i < 90; ++i) alone.advance(1.0 / 60);
        EXPECT_EQ(each([&] { return play.hash(); })[mode == std::string("physical")], alone.hash()) << mode;
    }
}

TEST_F(Split, ThePointerTakesTheSameParticleInBoth) {
    run("size 1000x500\n0 key p\n0 move bob/right_hand over 0\n0.1 press\n0.2 move 100 100 over 0\n0.2 key p\n"
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

TEST_F(Split, EditsCutsAndUndosHappenInBoth) {
    EXPECT_TRUE(play.set("figures.bob.height", "150")) << play.problem();
    for (const auto& height : each([&] { return play.tape().undo_name(); })) EXPECT_EQ(height, "figures.bob.height");
    play.undo();
    for (const auto edits : each([&] { return play.tape().edits(); })) EXPECT_EQ(edits, 0);
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

TEST_F(Split, TheHalfUnderThePointerStaysWhenTheOtherIsClosed) {
    for (int i = 0; i < 30; ++i) play.advance(1.0 / 60);
    const auto hashes = each([&] { return play.hash(); });
    play.handle(Moved{{800, 250}});
    EXPECT_EQ(play.active_pane(), 1U);
    play.handle(Key{"e"});
    EXPECT_EQ(play.pane_count(), 1U);
    EXPECT_EQ(play.hash(), hashes[1]);
    EXPECT_EQ(play.session().scene().solver.mode, "physical");
}

TEST_F(Split, APictureHasBothHalves) {
    Picture picture;
    play.draw(picture);
    ASSERT_EQ(picture.images.size(), 2U);
    for (const auto& image : picture.images) {
        ASSERT_TRUE(image);
        EXPECT_EQ(image->width, 500);
        EXPECT_GT(std::count_if(image->pixels.begin(), image->pixels.end(),
                                [&](auto pixel) { return pixel != image->pixels[0]; }),
                  500);
    }
}

} // namespace
} // namespace sinew::play
