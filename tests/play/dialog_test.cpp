#include "player/tour.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/play/game.h"

#include <fstream>

/// Dialogs hold everything; keys that everybody tries; the tour of a new player.
namespace sinew::play::SINEW_TEST_FILE {
namespace {

using games::library;
using games::Listening;
using games::pixel_of;

void wait(Play& play, int frames = 30) {
    for (int i = 0; i < frames; ++i) play.advance(1.0 / 60);
}

/// Deeds of a hand: keys of every action, buttons, the wheel, two fingers.
void try_everything(Play& play) {
    for (const auto& action : key_actions())
        if (action.name != "close" && action.name != "settings" && action.name != "help")
            play.handle(Key{std::string(action.key)});
    for (const auto* tool : {"q", "k", "n", "delete", "1"}) play.handle(Key{tool});
    play.handle(Moved{pixel_of(play, "bob/right_hand")});
    play.handle(Pressed{});
    play.handle(Moved{{400, 300}});
    play.handle(Released{});
    play.handle(Scrolled{3});
    play.handle(Pinched{{{30, 10}}, 1.2});
}

TEST(Dialog, NothingMovesAndNoKeyActsBehindIt) {
    const auto ask = [](Play& play) { play.question = Question{"?", "", {{"yes", "Yes", {}}}}; };
    const auto request = [](Play& play) { play.ask_for_path(Purpose::picture); };
    const auto complain = [](Play& play) { play.report_problem("no"); };
    const auto set_up = [](Play& play) { play.settings = true; };
    const auto help = [](Play& play) { play.help = true; };
    for (const auto& open :
         {std::function<void(Play&)>(ask), std::function<void(Play&)>(request), std::function<void(Play&)>(complain),
          std::function<void(Play&)>(set_up), std::function<void(Play&)>(help)}) {
        Play play(library, "ragdoll");
        wait(play);
        open(play);
        const auto hash = play.hash(), tool = play.tool;
        const auto view = play.view().scale();
        Listening listening(play);
        try_everything(play);
        wait(play);
        EXPECT_EQ(play.hash(), hash);
        EXPECT_EQ(play.tool, tool);
        EXPECT_EQ(play.view().scale(), view);
        EXPECT_TRUE(play.overlay.none());
        EXPECT_TRUE(play.panel);
        EXPECT_TRUE(listening.told.empty()) << listening.told.front().what;
        EXPECT_FALSE(play.clock().paused());
        play.handle(Key{"escape"});
        EXPECT_FALSE(play.has_dialog());
        wait(play);
        EXPECT_NE(play.hash(), hash) << "it goes on";
    }
}

TEST(Dialog, EnterTakesTheReportOfAProblemAway) {
    Play play(library, "ragdoll");
    play.report_problem("no");
    play.handle(Key{"return"});
    EXPECT_EQ(play.problem(), "");
}

TEST(Dialog, AMovieHasNoPicturesOfADialog) {
    ScratchFolder folder;
    Play play(library, "ragdoll");
    Picture picture;
    play.toggle_recording(folder / "a.webp");
    ASSERT_TRUE(play.recording()) << play.problem();
    const auto picture_after = [&](int frames) {
        wait(play, frames);
        play.draw(picture);
    };
    picture_after(2);
    play.help = true;
    picture_after(600);
    play.help = false;
    picture_after(2);
    play.toggle_recording();
    EXPECT_LT(std::filesystem::file_size(folder / "a.webp"), 60'000U) << "a few pictures, not three hundred";
}

TEST(Keys, SpacePausesAndGoesOn) {
    Play play(library, "ragdoll");
    play.handle(Key{"space"});
    EXPECT_TRUE(play.clock().paused());
    play.handle(KeyUp{"space"});
    play.handle(Moved{{300, 300}});
    const auto center = play.view().center();
    play.handle(Key{"space"});
    EXPECT_FALSE(play.clock().paused());
    play.handle(Pressed{});
    play.handle(Moved{{350, 300}});
    play.handle(Released{});
    EXPECT_EQ(play.view().center(), center) << "with a button it does nothing else";
}

TEST(Keys, SpaceJumpsWhereSomebodyCanAndPStillPauses) {
    Play play(library, "platformer");
    ASSERT_TRUE(play.ready()) << play.problem();
    play.handle(Key{"space"});
    EXPECT_FALSE(play.clock().paused());
    play.handle(Key{"p"});
    EXPECT_TRUE(play.clock().paused());
}

TEST(Tour, ALineStaysUntilThePlayerHasDoneWhatItSaysAndAllTakeAMinute) {
    EXPECT_EQ(double(Tour::count()) * Tour::each, 60);
    Play play(library, "ragdoll");
    play.tour.begin();
    const auto first = play.tour.text();
    EXPECT_NE(first.find("1/6"), std::string::npos) << first;
    play.handle(Moved{pixel_of(play, "bob/right_hand")});
    play.handle(Pressed{});
    EXPECT_EQ(play.tour.text(), first);
    play.handle(Released{});
    EXPECT_NE(play.tour.text(), first) << "a throw ends the first line";
    for (int i = 0; i < 9 * 60; ++i) play.advance(1.0 / 60);
    EXPECT_NE(play.tour.text().find("2/6"), std::string::npos);
    for (int i = 0; i < 45 * 60; ++i) play.advance(1.0 / 60);
    EXPECT_FALSE(play.tour.is_on());
    play.tour.begin();
    play.handle(Key{"escape"});
    EXPECT_FALSE(play.tour.is_on());
    EXPECT_FALSE(play.quit) << "Escape ends the tour first";
}

} // namespace
} // namespace sinew::play::SINEW_TEST_FILE
