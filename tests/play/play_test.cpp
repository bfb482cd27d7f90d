#include "sinew/world/measure.h"

#include "player/clock.h"
#include "player/scene_edit.h"
#include "player/script.h"
#include "player/touch.h"
#include "tests/play/game.h"
#include "tests/sanitized.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>

/// The game without its window: what a player does, said as a script or done by hand.
namespace sinew::play::SINEW_TEST_FILE {
namespace {

using games::fetch;
using games::library;
using games::Listening;
using games::pixel_of;
using games::run;

Session session_of(const std::string& name) {
    return Session(std::move(*fetch(name, {}).opened));
}

std::uint64_t hash_of(const Session& session) {
    return std::visit([](const auto& world) { return state_hash(world); }, session.world());
}

// --- the clock -------------------------------------------------------------------------------------------------------

TEST(PlayClock, TakesTheSameStepsAtAnyRateOfTheDisplay) {
    for (const double display : {30.0, 60.0, 75.0, 144.0, 200.0}) {
        Clock clock(60);
        int steps = 0;
        for (int frame = 0; frame < int(display) * 10; ++frame) {
            steps += clock.advance(1 / display);
            EXPECT_GE(clock.share(), 0);
            EXPECT_LE(clock.share(), 1);
        }
        EXPECT_NEAR(steps, 600, 1) << display;
    }
}

TEST(PlayClock, ForgetsAStallInsteadOfCatchingUp) {
    Clock clock(60);
    EXPECT_EQ(clock.advance(30), int(Clock::longest_stall * 60));
    EXPECT_EQ(clock.advance(-1), 0);
    EXPECT_EQ(clock.advance(std::nan("")), 0);
}

TEST(PlayClock, SlowMotionAndPause) {
    Clock clock(60);
    clock.set_scale(0.25);
    int steps = 0;
    for (int frame = 0; frame < 240; ++frame) steps += clock.advance(1.0 / 60);
    EXPECT_NEAR(steps, 60, 1);
    clock.pause(true);
    EXPECT_EQ(clock.advance(1), 0);
    clock.set_scale(1e9);
    EXPECT_EQ(clock.scale(), Clock::fastest);
}

// --- the timeline
// --------------------------------------------------------------------------------------------------------

/// Any step of the past, gone to in any order, is the one that was.
TEST(PlayTape, GoesBackToTheSameBits) {
    Timeline timeline(session_of("ragdoll"));
    std::vector<std::uint64_t> hashes = {hash_of(timeline.session())};
    const auto hand = std::visit([](const auto& world) { return *find_particle(world, "bob/right_hand"); },
                                 timeline.session().world());
    for (int i = 1; i <= 200; ++i) {
        timeline.step();
        if (i == 50) timeline.act(Grab{rows_of(timeline.session().world(), {&hand, 1}), {{240, 100, 0}}});
        if (i > 50 && i < 90) timeline.act(Drag{{{240.0 + i, 100, 0}}});
        if (i == 90) timeline.act(LetGo{});
        hashes.push_back(hash_of(timeline.session()));
    }
    for (const std::uint64_t step : {199, 50, 51, 0, 90, 89, 200, 137, 15, 14}) {
        timeline.go_to(step);
        EXPECT_EQ(timeline.now(), step);
        EXPECT_EQ(hash_of(timeline.session()), hashes[step]) << step;
    }
    timeline.go_to(60);
    for (int i = 0; i < 140; ++i) timeline.step();
    EXPECT_EQ(hash_of(timeline.session()), hashes[200]);
}

TEST(PlayWheel, ChangesHowFastTimePassesWhereTheSceneSaysSo) {
    Play play(library, "bezier_humanoid", {Override{"mode=classic"}});
    ASSERT_TRUE(play.ready()) << play.problem();
    const auto scale = [&] {
        return std::visit([](const auto& world) { return double(world.settings.classic.time_scale); },
                          play.session().world());
    };
    const auto height = play.view().see({{0, 0, 0}})->scale;
    play.handle(Scrolled{-3});
    EXPECT_NEAR(scale(), 0.7, 1e-12);
    EXPECT_EQ(play.view().see({{0, 0, 0}})->scale, height) << "it does not zoom as well";
    for (int i = 0; i < 20; ++i) play.handle(Scrolled{-1});
    EXPECT_EQ(scale(), 0);
    for (int i = 0; i < 30; ++i) play.timeline().step();
    for (int i = 0; i < 100; ++i) play.handle(Scrolled{1}), play.timeline().step();
    EXPECT_EQ(scale(), 5);
    std::visit(
        [](const auto& world) {
            for (const auto& position : world.particles.position) EXPECT_TRUE(is_finite(position));
        },
        play.session().world());
}

TEST(PlayTape, WhatIsDoneInThePastChangesTheFuture) {
    Timeline timeline(session_of("ragdoll"));
    for (int i = 0; i < 60; ++i) timeline.step();
    timeline.go_to(30);
    EXPECT_EQ(timeline.end(), 60u);
    timeline.act(Restart{});
    EXPECT_EQ(timeline.end(), 30u);
    EXPECT_EQ(timeline.session().seconds(), 0);
}

TEST(PlayTape, RemembersAMinuteAndNoMore) {
    Timeline timeline(session_of("stick"));
    for (int i = 0; i < 90 * 60; ++i) timeline.step();
    EXPECT_LE(timeline.first(), timeline.end() - 60 * 60);
    EXPECT_GT(timeline.first(), timeline.end() - 62 * 60);
    timeline.go_to(0);
    EXPECT_EQ(timeline.now(), timeline.first());
}

// --- the game --------------------------------------------------------------------------------------------------------

TEST(Play, AHandThatIsDraggedFollowsAndIsThrown) {
    Play play(library, "ragdoll");
    run("size 960x720\n0 key p\n0 move bob/right_hand over 0\n0.1 press\n0.1 key p\n0.2 move 700 200 over 0.5\n"
        "1.2 end",
        play);
    EXPECT_LT(distance(pixel_of(play, "bob/right_hand"), Vec2<double>{{700, 200}}), 1);
    play.handle(Moved{{500, 200}});
    play.advance(1.0 / 60);
    play.handle(Released{});
    EXPECT_EQ(play.session().hand(), nullptr);
    const auto let_go = pixel_of(play, "bob/right_hand");
    play.advance(1.0 / 60);
    EXPECT_LT(pixel_of(play, "bob/right_hand")[0], let_go[0] - 5) << "it keeps the speed that it was carried with";
}

TEST(Play, NothingIsDraggedThroughAWall) {
    Play play(library, "ragdoll");
    run("size 960x720\n0 key p\n0 move bob/right_hand over 0\n0.1 press\n0.1 key p\n0.2 move 480 5000 over 0.1\n"
        "1 end",
        play);
    const double floor = play.session().scene().world.bounds->box->at(1)[1];
    std::visit(
        [&](const auto& world) {
            for (const auto& position : world.particles.position) EXPECT_LE(double(position[1]), floor + 1e-6);
        },
        play.session().world());
}

TEST(Play, PauseStepAndStepBackReturnTheSameHash) {
    Play play(library, "ragdoll");
    Listening listening(play);
    run("1 key p\n1.1 key o\n1.2 key b\n1.3 key o\n1.4 key b\n1.5 end", play);
    const auto paused = listening.value("pause", "hash");
    EXPECT_EQ(paused.size(), 16u);
    EXPECT_EQ(listening.value("back", "hash", 0), paused);
    EXPECT_EQ(listening.value("back", "hash", 1), paused);
    EXPECT_NE(listening.value("step", "hash", 0), paused);
    EXPECT_EQ(listening.value("step", "hash", 0), listening.value("step", "hash", 1));
}

TEST(Play, ACutRopeFallsAndIsWholeAgainOnceUndone) {
    Play play(library, "ragdoll");
    Listening listening(play);
    {
        std::ofstream file(::testing::TempDir() + "/hanging.json");
        file << R"({"sinew": 1, "world": {"gravity": [0, -9.8]},
                    "figures": [{"prefab": "rope", "name": "rope", "length": 2}]})";
    }
    play.open(::testing::TempDir() + "/hanging.json");
    const auto constraints = play.session().report().constraints;
    run("size 800x600\n0.1 move rope/particle_10 over 0\n0.2 end", play);
    const auto middle = play.pointer();
    const auto end = pixel_of(play, "rope/particle_20");
    play.handle(Moved{middle + Vec2<double>{{-60, 4}}});
    play.handle(Pressed{Button::right});
    play.handle(Moved{middle + Vec2<double>{{60, 4}}});
    play.handle(Released{Button::right});
    EXPECT_EQ(listening.count("cut"), 1u);
    EXPECT_LT(play.session().report().constraints, constraints);
    for (int i = 0; i < 30; ++i) play.advance(1.0 / 60);
    EXPECT_GT(pixel_of(play, "rope/particle_20")[1], end[1] + 50) << "it fell";
    const auto fallen = play.hash();
    play.handle(Key{"ctrl+z"});
    EXPECT_EQ(play.session().report().constraints, constraints);
    EXPECT_NEAR(pixel_of(play, "rope/particle_20")[1], end[1], 1);
    play.handle(Key{"ctrl+y"});
    EXPECT_LT(play.session().report().constraints, constraints);
    for (int i = 0; i < 30; ++i) play.advance(1.0 / 60);
    EXPECT_EQ(play.hash(), fallen) << "what comes after it is as it was";
}

/// An edit of one figure leaves the others as they move.
TEST(Play, AnEditGoesOnWhereTheWorldIs) {
    Play play(library, "ragdoll");
    for (int i = 0; i < 60; ++i) play.advance(1.0 / 60);
    const auto hand = pixel_of(play, "bob/right_hand");
    play.tool = "spawn";
    play.prefab = "box";
    play.handle(Moved{{400, 300}});
    play.handle(Pressed{});
    play.handle(Released{});
    EXPECT_EQ(play.session().scene().figures.size(), 2u);
    EXPECT_EQ(pixel_of(play, "bob/right_hand"), hand);
    EXPECT_NEAR(play.session().seconds(), 1, 1e-9);
    EXPECT_TRUE(play.set("figures.box.width", "80")) << play.problem();
    EXPECT_EQ(pixel_of(play, "bob/right_hand"), hand);
    EXPECT_FALSE(play.set("figures.box.width", "-1"));
    EXPECT_NE(play.problem().find("width"), std::string::npos);
    EXPECT_TRUE(play.is_edited());
    play.undo(), play.undo();
    EXPECT_FALSE(play.is_edited());
    EXPECT_EQ(play.session().scene().figures.size(), 1u);
    EXPECT_EQ(pixel_of(play, "bob/right_hand"), hand);
}

// An edit of friction, colour or place leaves a description that begins in a similar form.
TEST(Play, AnEditedFigureGoesOnAsItMovesAndOneThatIsMovedMovesSo) {
    Play play(library, "ragdoll");
    for (int i = 0; i < 60; ++i) play.advance(1.0 / 60);
    const auto hand = pixel_of(play, "bob/right_hand"), head = pixel_of(play, "bob/head");
    EXPECT_TRUE(play.set("figures.bob.contact.friction", "0.1")) << play.problem();
    EXPECT_TRUE(play.set("figures.bob.looks.all.color", "\"#00ff00\"")) << play.problem();
    EXPECT_EQ(pixel_of(play, "bob/right_hand"), hand);
    EXPECT_TRUE(play.set("figures.bob.at", "[170, 180]")) << play.problem(); // from 150, 190
    const auto scale = play.view().scale();
    const auto by = Vec2<double>{{20 * scale, -10 * scale}};
    EXPECT_LT(distance(pixel_of(play, "bob/right_hand"), hand + by), 0.01);
    EXPECT_LT(distance(pixel_of(play, "bob/head"), head + by), 0.01);
}

/// A rope that was cut begins anew in another form, and whole: that is told, and what goes on is not.
TEST(Play, WhatAnEditCannotKeepIsTold) {
    Play play(library, "rope");
    play.resize(1280, 720);
    for (int i = 0; i < 30; ++i) play.advance(1.0 / 60);
    const auto constraints = play.session().report().constraints;
    const auto middle = pixel_of(play, "rope/particle_10");
    play.tool = "cut";
    play.handle(Moved{middle + Vec2<double>{{-120, 3}}});
    play.handle(Pressed{});
    play.handle(Moved{middle + Vec2<double>{{120, 4}}});
    play.handle(Released{});
    ASSERT_LT(play.session().report().constraints, constraints);
    EXPECT_TRUE(play.set("world.damping", "0.01")) << play.problem();
    EXPECT_EQ(play.message.find("not kept"), std::string::npos) << play.message;
    EXPECT_TRUE(play.set("figures.rope.segments", "18")) << play.problem();
    EXPECT_EQ(play.message, "not kept: the figure \"rope\" has been cut or joined, and would begin anew");
    play.undo();
    EXPECT_EQ(play.message.find("undone"), 0u) << play.message;
}

TEST(Play, EveryToolLeavesASceneThatCanBeSavedAndOpened) {
    const auto path = ::testing::TempDir() + "/saved.json";
    for (const auto* tool : {"rope", "polygon", "cloth", "spawn", "pin", "remove", "measure"}) {
        Play play(library, "ragdoll");
        play.resize(1280, 720);
        play.tool = tool;
        play.handle(Moved{pixel_of(play, "bob/right_hand")});
        play.handle(Pressed{});
        for (const Vec2<double> to : {Vec2<double>{{700, 200}}, Vec2<double>{{800, 300}}, Vec2<double>{{900, 600}}})
            play.handle(Moved{to});
        play.handle(Released{});
        EXPECT_EQ(play.problem(), "") << tool;
        EXPECT_EQ(play.is_edited(), std::string_view(tool) != "measure") << tool;
        for (int i = 0; i < 30; ++i) play.advance(1.0 / 60);
        ASSERT_TRUE(play.save(path)) << play.problem();
        auto again = fetch(path, {});
        ASSERT_TRUE(again.opened) << tool << "\n" << again.problem;
        EXPECT_EQ(to_json(again.opened->scene), to_json(play.session().scene())) << tool;
    }
}

TEST(Play, ABrokenFileLeavesTheSceneThatRuns) {
    Play play(library, "ragdoll");
    const auto path = ::testing::TempDir() + "/broken.json";
    std::ofstream(path) << R"({"sinew": 1, "figures": [{"prefab": "roope"}]})";
    for (int i = 0; i < 10; ++i) play.advance(1.0 / 60);
    play.open(path);
    EXPECT_NE(play.problem().find("did you mean \"rope\""), std::string::npos);
    EXPECT_EQ(play.scene_name(), "ragdoll");
    EXPECT_GT(play.session().seconds(), 0.1);
}

TEST(Play, AFileThatIsWrittenAgainIsReadAgain) {
    const auto path = ::testing::TempDir() + "/live.json";
    const auto write = [&](const char* length, int later) {
        std::ofstream(path) << R"({"sinew": 1, "figures": [{"prefab": "rope", "length": )" << length << "}]}";
        std::filesystem::last_write_time(path,
                                         std::filesystem::file_time_type::clock::now() + std::chrono::seconds(later));
    };
    write("2", 0);
    Play play(library, path);
    Listening listening(play);
    write("3", 10);
    for (int i = 0; i < 60; ++i) play.advance(1.0 / 60);
    EXPECT_EQ(listening.count("reloaded"), 1u);
    write("\"long\"", 20);
    for (int i = 0; i < 60; ++i) play.advance(1.0 / 60);
    EXPECT_EQ(listening.count("problem"), 1u);
    EXPECT_TRUE(play.ready());
}

TEST(Play, ZoomKeepsWhatIsUnderThePointer) {
    Play play(library, "ragdoll");
    play.resize(1000, 700);
    const Vec2<double> pointer{{300, 200}};
    play.handle(Moved{pointer});
    const auto before = play.view().position_of(pointer);
    play.handle(Scrolled{4});
    EXPECT_LT(distance(play.view().position_of(pointer), before), 1e-9);
    play.handle(Pressed{Button::middle});
    play.handle(Moved{pointer + Vec2<double>{{50, 30}}});
    play.handle(Released{Button::middle});
    EXPECT_LT(distance(play.view().position_of(pointer + Vec2<double>{{50, 30}}), before), 1e-9);
    play.handle(Key{"home"});
    EXPECT_EQ(play.view().scale(), View(play.session().scene(), play.session().focus(), 1000, 700).scale());
}

TEST(Play, SmallestAndStrangestPicturesDoNoHarm) {
    Play play(library, "ragdoll");
    Picture picture;
    for (const auto& [width, height] : {std::pair{0, 0}, {1, 1}, {3, 2000}, {-5, 7}}) {
        play.resize(width, height, 0);
        play.handle(Moved{{1e30, std::nan("")}});
        play.handle(Scrolled{1e9});
        play.handle(Pressed{});
        play.handle(Released{});
        play.draw(picture);
        play.advance(1.0 / 60);
    }
}

/// Slower machines, faster displays: what is drawn lies between two steps, and the world is the same.
TEST(Play, TheDisplaysRateChangesNothingButThePictures) {
    std::vector<std::string> hashes;
    for (const char* fps : {"30", "60", "200"}) {
        Play play(library, "ragdoll");
        run(std::string("fps ") + fps + "\n2 end", play);
        play.go_to(110);
        hashes.push_back(play.hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[1], hashes[2]);
}

TEST(Play, ASceneInSpaceIsTurnedAndItsClothIsTaken) {
    Play play(library, "cloth3d");
    play.resize(1000, 700);
    for (int i = 0; i < (test::sanitized ? 5 : 30); ++i) play.advance(1.0 / 60);
    const auto eye = play.view().towards_eye();
    play.handle(Moved{{5, 5}});
    play.handle(Pressed{});
    play.handle(Moved{{105, 25}});
    play.handle(Released{});
    EXPECT_GT(distance(play.view().towards_eye(), eye), 0.1);
    const auto id =
        std::visit([](const auto& world) { return world.particles.handles.id_of(Row(world.particles.size() - 1)); },
                   play.session().world());
    const auto pixel = [&] {
        return cast<double>(play.view().see(position_of(play.session().world(), {&id, 1})->as<3, double>())->pixel);
    };
    play.handle(Moved{pixel()});
    play.handle(Pressed{});
    ASSERT_NE(play.session().hand(), nullptr);
    play.handle(Moved{pixel() + Vec2<double>{{30, -20}}});
    const auto goal = play.pointer();
    for (int i = 0; i < 60; ++i) play.advance(1.0 / 60);
    EXPECT_LT(distance(pixel(), goal), 3);
}

TEST(PlayScript, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(read_script("0 dance").problem.substr(0, 8), "line 1: ");
    EXPECT_NE(read_script("0 mov 1 2").problem.find("did you mean \"move\""), std::string::npos);
    EXPECT_NE(read_script("1 press\n0.5 release").problem.find("earlier"), std::string::npos);
    EXPECT_NE(read_script("size 0x4").problem, "");
    EXPECT_NE(read_script("size").problem, "");
    Play play(library, "ragdoll");
    EXPECT_NE(run_script(read_script("0 move bob/nose").script, play).find("bob/nose"), std::string::npos);
}

TEST(PlayScript, TakesNumbersThatALargeIntegerHolds) {
    const std::string far = "1" + std::string(90, '4');
    Play play(library, "ragdoll");
    for (const auto& line : {"touch 1 " + far + " 3", "lift " + far, "go " + far, "move " + far + " 1"})
        EXPECT_NE(run_script(read_script("0 " + line + "\n").script, play), "") << line;
    for (const std::string line : {"touch 1 1e15 -1e15 over 1e15", "lift 1e15", "go 1e15", "move -1e15 1e15"})
        EXPECT_EQ(run_script(read_script("0 " + line + "\n0.1 end").script, play), "") << line;
}

// The hand of a ragdoll led a long way off, over a frame, and back again.
TEST(Play, APointerOutOfReachIsAsFarAsReachGoes) {
    Play play(library, "ragdoll");
    for (const double far : {1e90, -1e300, std::numeric_limits<double>::quiet_NaN()}) {
        Touch touch(play);
        touch.down(1, {{400, 300}});
        touch.move(1, {{far, far}});
        touch.down(2, {{-far, far}});
        touch.move(2, {{far, 10}});
        for (int i = 0; i < 2; ++i) EXPECT_LE(std::fabs(play.pointer()[i]), max_pixel);
        touch.up(1), touch.up(2);
        play.handle(Pinched{{{far, far}}, 1.1});
        std::vector<Picture> pictures;
        play.draw_panes(pictures);
        play.advance(1.0 / 60);
    }
    play.handle(Key{"home"});
    const auto center = play.view().center();
    for (int i = 0; i < 2; ++i) EXPECT_LT(std::fabs(double(center[i])), 1e3);
}

// Two fingers 200 pixels apart, one of which goes 200 further: twice as large, about the middle, which moves by 100.
TEST(Touch, OneFingerIsThePointerAndTwoMoveAndScale) {
    Play play(library, "ragdoll");
    Listening heard(play);
    const auto pixel = [&](std::size_t number) {
        const auto& told = heard.told;
        std::size_t seen = 0;
        for (const auto& one : told)
            if (one.what == "where" && seen++ == number)
                return (*json::find(one.more, "pixel")->value.as<json::Array>())[0].as<json::Number>()->value;
        return -1.0;
    };
    EXPECT_EQ(run_script(read_script("0 key p\n"
                                     "0.1 where bob/head\n"
                                     "0.1 touch 1 400 300\n0.2 touch 2 600 300\n"
                                     "0.3 touch 2 800 300 over 0.2\n"
                                     "0.6 where bob/head\n"
                                     "0.7 lift 1\n0.7 touch 2 100 100\n"
                                     "0.8 where bob/head\n0.8 lift 2\n")
                             .script,
                         play),
              "");
    EXPECT_NEAR(pixel(1), (pixel(0) - 500) * 2 + 600, 1e-3);
    EXPECT_EQ(pixel(2), pixel(1)) << "what is left of two fingers does nothing";
    EXPECT_EQ(heard.count("grab"), 0U);
    EXPECT_EQ(run_script(read_script("0 key home\n0 move bob/head over 0\n").script, play), "");
    Touch touch(play);
    touch.down(7, play.pointer());
    touch.move(7, play.pointer() + Vec2<double>{{50, 0}});
    EXPECT_EQ(heard.count("grab"), 1U);
    touch.down(8, {{10, 10}});
    EXPECT_EQ(heard.count("place"), 1U) << "the second finger ends the first one's drag";
}

} // namespace
} // namespace sinew::play::SINEW_TEST_FILE
