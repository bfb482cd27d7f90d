#include "sinew/world/measure.h"

#include "player/files.h"
#include "player/folder.h"
#include "player/script.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/play/game.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

/// Files of the game: what is asked before something is lost, what is kept, and running states.
namespace sinew::play::SINEW_TEST_FILE {
namespace {

namespace fs = std::filesystem;
using games::library;
using games::Listening;
using games::run;

class Documents : public testing::Test {
  protected:
    std::string in(const char* name) const { return (folder / name).string(); }
    ScratchFolder folder;
};

void advance(Play& play, int frames) {
    for (int i = 0; i < frames; ++i) play.advance(1.0 / 60);
}

TEST_F(Documents, EscapeAsksWhereAnEditWouldBeLost) {
    Play play(library, "ragdoll");
    play.handle(Key{"g"});
    ASSERT_TRUE(play.would_lose());
    play.handle(Key{"escape"});
    ASSERT_TRUE(play.question);
    EXPECT_FALSE(play.quit);
    play.handle(Key{"escape"});
    EXPECT_FALSE(play.question) << "Escape takes the last answer, which changes nothing";
    EXPECT_FALSE(play.quit);
    play.handle(Key{"escape"});
    ASSERT_TRUE(play.answer("discard"));
    EXPECT_TRUE(play.quit);
}

TEST_F(Documents, EnterTakesTheFirstAnswer) {
    Play play(library, "ragdoll");
    play.handle(Key{"g"});
    play.handle(Key{"escape"});
    ASSERT_TRUE(play.question);
    play.handle(Key{"p"});
    EXPECT_FALSE(play.clock().paused()) << "keys act on the question alone";
    play.handle(Key{"return"});
    EXPECT_FALSE(play.question);
    ASSERT_TRUE(play.path_request) << "Save was first, and asks where";
    play.choose(in("mine.json"));
    EXPECT_TRUE(play.quit);
}

// Another program writes the file while there are changes that are not in it.
TEST_F(Documents, AFileThatWasChangedElsewhereReplacesAnEditOnlyOnRequest) {
    const auto path = in("live.json");
    const auto write = [&](const char* length, int later) {
        std::ofstream(path) << R"({"sinew": 1, "figures": [{"prefab": "rope", "length": )" << length << "}]}";
        fs::last_write_time(path, fs::file_time_type::clock::now() + std::chrono::seconds(later));
    };
    write("2", 0);
    Play play(library, path);
    Listening listening(play);
    play.handle(Key{"g"});
    for (const char* answer : {"keep", "read"}) {
        ASSERT_TRUE(play.would_lose());
        write("3", *answer == 'k' ? 10 : 20);
        advance(play, 60);
        ASSERT_TRUE(play.question);
        EXPECT_EQ(listening.count("reloaded"), 0U);
        ASSERT_TRUE(play.answer(answer));
    }
    EXPECT_EQ(listening.count("reloaded"), 1U);
    EXPECT_FALSE(play.would_lose());
}

TEST_F(Documents, EscapeQuitsAtOnceWhereNothingWouldBeLost) {
    Play play(library, "ragdoll");
    play.handle(Key{"g"});
    play.handle(Key{"g"}); // the scene is as it was
    EXPECT_TRUE(play.is_edited());
    EXPECT_FALSE(play.would_lose());
    play.handle(Key{"escape"});
    EXPECT_TRUE(play.quit);
}

TEST_F(Documents, AnotherSceneIsOpenedOnlyOnceTheEditIsSavedOrDropped) {
    Play play(library, "ragdoll");
    play.handle(Key{"g"});
    play.open("rope");
    EXPECT_EQ(play.scene_name(), "ragdoll");
    ASSERT_TRUE(play.answer("save"));
    ASSERT_TRUE(play.path_request) << "a scene of the catalogue has no file of the player's";
    play.choose(in("mine.json"));
    EXPECT_EQ(play.scene_name(), "rope") << "what was meant to be done follows";
    EXPECT_TRUE(games::fetch(in("mine.json"), {}).opened);
}

TEST_F(Documents, SavingAsksWhereTheFirstTimeAndSaysWhereItWent) {
    Play play(library, "ragdoll");
    Listening heard(play);
    play.handle(Key{"ctrl+s"});
    EXPECT_EQ(heard.count("saved"), 0U);
    ASSERT_TRUE(play.path_request);
    EXPECT_EQ(play.path_request->suggested.filename(), "ragdoll.json");
    play.choose(in("mine.json"));
    EXPECT_EQ(play.message, "saved " + in("mine.json"));
    ASSERT_FALSE(play.recent.empty());
    EXPECT_EQ(play.recent.front(), in("mine.json"));
    play.handle(Key{"g"});
    play.handle(Key{"ctrl+s"});
    EXPECT_FALSE(play.path_request) << "now it has a file of its own";
    EXPECT_EQ(heard.count("saved"), 2U);
    EXPECT_FALSE(play.would_lose());
}

TEST_F(Documents, WhatWasNotSavedIsOfferedAtTheNextStart) {
    const auto draft = folder / "autosave.json";
    {
        Play play(library, "ragdoll");
        play.keep_draft_in(draft);
        play.set("figures.bob.height", "150");
        advance(play, 60 * 6);
        EXPECT_TRUE(std::filesystem::exists(draft));
    } // a crash
    Play play(library, "rope");
    play.keep_draft_in(draft);
    play.offer_draft();
    ASSERT_TRUE(play.question);
    ASSERT_TRUE(play.answer("open"));
    EXPECT_EQ(play.problem(), "");
    EXPECT_EQ(play.session().scene().figures.at(0).name, "bob");
    EXPECT_TRUE(play.would_lose()) << "it is not saved yet";
    play.save(in("mine.json"));
    EXPECT_FALSE(std::filesystem::exists(draft));
    Play later(library, "rope");
    later.keep_draft_in(draft);
    later.offer_draft();
    EXPECT_FALSE(later.question);
}

TEST_F(Documents, ASceneRunsFromTheClipboard) {
    Play play(library, "ragdoll");
    play.clipboard = [] { return std::string(R"({"sinew": 1, "figures": [{"prefab": "rope", "name": "line"}]})"); };
    play.handle(Key{"ctrl+v"});
    EXPECT_EQ(play.session().scene().figures.at(0).name, "line");
    play.clipboard = [] { return std::string("hello"); };
    play.handle(Key{"ctrl+v"});
    EXPECT_NE(play.problem(), "");
    EXPECT_EQ(play.session().scene().figures.at(0).name, "line") << "what runs goes on";
    std::string copied;
    play.set_clipboard = [&](const std::string& text) { copied = text; };
    play.handle(Key{"ctrl+c"});
    play.open_text(copied, "copy");
    EXPECT_EQ(play.session().scene().figures.at(0).name, "line");
    play.copy_hash();
    EXPECT_EQ(copied, play.hash());
}

// Frames of one size make a film; and one that runs when the game ends is kept.
TEST_F(Documents, AFilmEndsWhereThePictureTakesAnotherSizeAndWithTheGame) {
    if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
    Picture picture;
    {
        Play play(library, "ragdoll");
        Listening listening(play);
        const auto film = [&](const char* name, int width) {
            play.resize(width, 80);
            play.toggle_recording(in(name));
            for (int i = 0; i < 6; ++i) play.advance(1.0 / 60), play.draw(picture);
        };
        film("first.mp4", 120);
        ASSERT_TRUE(play.recording()) << play.problem();
        play.toggle_split();
        play.draw(picture);
        EXPECT_FALSE(play.recording());
        EXPECT_EQ(listening.count("recorded"), 1U);
        film("second.mp4", 200);
        EXPECT_TRUE(play.recording()) << play.problem();
    }
    for (const char* name : {"first.mp4", "second.mp4"}) EXPECT_TRUE(fs::exists(in(name))) << name;
}

TEST_F(Documents, ANewSceneIsAFloorToPutThingsOn) {
    Play play(library, "ragdoll");
    play.handle(Key{"ctrl+n"});
    EXPECT_EQ(play.problem(), "");
    EXPECT_TRUE(play.session().scene().figures.empty());
    play.resize(800, 600);
    play.tool = "spawn";
    play.handle(Moved{{400, 300}});
    play.handle(Pressed{});
    play.handle(Released{});
    EXPECT_EQ(play.session().scene().figures.size(), 1U) << play.problem();
}

TEST_F(Documents, AFolderIsOfferedWithItsFoldersFirst) {
    for (const char* name : {"b.json", "a.json", "c.txt", ".hidden.json"}) std::ofstream(in(name)) << "{}";
    std::filesystem::create_directory(folder / "z");
    std::vector<std::string> names;
    for (const auto& entry : entries_of(folder.path, ".json")) names.push_back(entry.name);
    EXPECT_EQ(names, (std::vector<std::string>{"..", "z", "a.json", "b.json"}));
    EXPECT_TRUE(entries_of(folder / "nowhere", ".json").empty());
}

// --- running states --------------------------------------------------------------------------------------------------

/// Actions of a player in three seconds: grabs, cuts, edits, undoes, restarts.
constexpr const char* busy = "size 800x600\n"
                             "0 move bob/right_hand over 0\n0.1 press\n0.2 move 600 100 over 0.4\n0.8 release\n"
                             "0.9 key g\n1.0 key g\n1.2 set figures.bob.mass=20\n"
                             "1.4 key r\n"
                             "1.6 move 100 300 over 0\n1.7 press right\n1.8 move 700 320 over 0.2\n2.1 release right\n"
                             "2.2 key ctrl+z\n2.3 key ctrl+y\n2.4 go 130\n2.4 key p\n"
                             "2.5 move bob/head over 0\n2.6 press\n2.6 move 300 200 over 0.3\n3 release\n3.2 end";

TEST_F(Documents, ARestoredStateContinuesWithTheSameBits) {
    for (const char* scene : {"ragdoll", "cloth3d"}) {
        Play play(library, scene);
        const bool is_cloth = scene != std::string("ragdoll");
        run(is_cloth ? "size 800x600\n0.1 move 300 100 over 0\n0.2 press right\n0.2 move 500 500 over 0.2\n"
                       "0.5 release right\n0.6 key w\n0.8 end"
                     : busy,
            play);
        ASSERT_EQ(play.problem(), "");
        const auto saved = play.hash();
        ASSERT_TRUE(play.save_state(in("run.state.json"))) << play.problem();
        Play again(library, in("run.state.json"));
        ASSERT_TRUE(again.ready()) << again.problem();
        EXPECT_EQ(again.hash(), saved) << scene;
        for (auto* one : {&play, &again}) one->pause(false), one->step();
        for (int i = 0; i < (is_cloth ? 10 : 100); ++i) play.step(), again.step();
        EXPECT_EQ(again.hash(), play.hash()) << scene;
        EXPECT_TRUE(again.save_state(in("twice.state.json")));
        again.open(in("twice.state.json"));
        again.advance(0);
        EXPECT_EQ(again.problem(), "");
        EXPECT_EQ(again.hash(), play.hash()) << "a state of a state";
    }
}

TEST_F(Documents, ABadStateIsRefusedWithItsPlaceAndWhatRunsGoesOn) {
    Play play(library, "ragdoll");
    run("0.5 end", play);
    ASSERT_TRUE(play.save_state(in("good.json")));
    const auto good = *read_file(in("good.json"), 1 << 20);
    const auto refused = [&](const std::string& from, const std::string& to) {
        auto text = good;
        const auto at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        std::ofstream(in("bad.json")) << text;
        play.open(in("bad.json"));
        play.advance(0);
        return play.problem();
    };
    EXPECT_NE(refused("\"sinew_state\": 1", "\"sinew_state\": 9").find("sinew_state"), std::string::npos);
    EXPECT_NE(refused("\"hash\": \"", "\"hash\": \"0").find("that was saved"), std::string::npos);
    EXPECT_NE(refused("\"steps\": ", "\"steps\": -").find("steps"), std::string::npos);
    EXPECT_NE(refused("\"steps\": ", "\"stebs\": ").find("did you mean"), std::string::npos);
    EXPECT_NE(refused("\"ragdoll\"", "\"ragdolll\"").find("did you mean"), std::string::npos);
    for (std::size_t length = 30; length < good.size(); length += good.size() / 9) {
        std::ofstream(in("bad.json")) << good.substr(0, length);
        play.open(in("bad.json"));
        play.advance(0);
        EXPECT_NE(play.problem(), "") << "cut off at byte " << length;
    }
    EXPECT_EQ(play.scene_name(), "ragdoll");
}

// Rows of particles that never were, a grab of nothing, actions out of order: told, or without effect; never a crash.
TEST_F(Documents, StrangeActionsDoNoHarm) {
    const auto play_with = [&](const std::string& actions) {
        std::ofstream(in("odd.json")) << R"({"sinew_state": 1, "steps": 5, "hash": "x", "actions": [)" << actions
                                      << R"(], "scene": {"sinew": 1, "figures": [{"prefab": "rope"}]}})";
        return Play(library, in("odd.json")).problem();
    };
    for (const char* action :
         {R"({"step": 1, "grab": [], "position": [0, 0]})", R"({"step": 1, "grab": [77], "position": [0, 0]})",
          R"({"step": 1, "grab": [1, 1], "position": [1e29, 0]})", R"({"step": 2, "drag": [1e29, -1e29]})",
          R"({"step": 1, "tweak": 4294967295, "mass": 0})", R"({"step": 1, "let_go": true})",
          R"({"step": 1, "cut": [[0, 0], [0, 0]], "picture": [1, 1]})"})
        EXPECT_NE(play_with(action).find("that was saved"), std::string::npos) << action << play_with(action);
    EXPECT_NE(play_with(R"({"step": 9, "let_go": true})").find("after the last"), std::string::npos);
    EXPECT_NE(play_with(R"({"step": 3, "let_go": true}, {"step": 2, "let_go": true})").find("before"),
              std::string::npos);
    EXPECT_NE(play_with(R"({"step": 3, "dance": true})").find("dance"), std::string::npos);
    EXPECT_NE(play_with(R"({"step": 3, "become": {"sinew": 1, "figures": 3}})").find("figures"), std::string::npos);
}

// --- keys ------------------------------------------------------------------------------------------------------------

TEST(PlayKeys, CanBeChosenAndNoneStandsForTwoThings) {
    Play play(library, "ragdoll");
    EXPECT_EQ(play.keys.choose("pause", "o"), "step") << "taken";
    EXPECT_EQ(play.keys.choose("pause", "f5"), "");
    play.handle(Key{"space"});
    EXPECT_FALSE(play.clock().paused());
    play.handle(Key{"f5"});
    EXPECT_TRUE(play.clock().paused());
    EXPECT_EQ(play.keys.choose("grab", "space"), "") << "free now";
    play.tool = "cut";
    play.handle(Key{"space"});
    EXPECT_EQ(play.tool, "grab");
    play.keys.reset();
    EXPECT_EQ(play.keys.of("pause"), "space");
}

TEST(PlayKeys, NoTwoActionsBeginWithOneKey) {
    const Keys keys;
    for (const auto& action : key_actions()) EXPECT_EQ(keys.action_of(action.key), action.name);
}

} // namespace
} // namespace sinew::play::SINEW_TEST_FILE
