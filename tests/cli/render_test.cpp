#include "tests/canvas/scratch_folder.h"
#include "tests/cli/command.h"

#include <chrono>
#include <gtest/gtest.h>
#include <thread>

namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> nothing;

class Render : public testing::Test {
  protected:
    Outcome render(const Arguments& arguments) {
        Arguments all{"render"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return sinew(all, {.folder = folder.path});
    }

    std::string written(const Arguments& arguments) {
        const auto outcome = render(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return outcome.out;
    }

    void expect_refused(const Arguments& arguments, const char* message) {
        const auto outcome = render(arguments);
        EXPECT_EQ(outcome.code, 1) << outcome.out;
        EXPECT_TRUE(has(outcome.err, message));
        EXPECT_EQ(folder.names(), nothing);
    }

    void wait_for_files(std::size_t count) {
        for (int i = 0; i < 2000 && folder.names().size() < count; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        EXPECT_GE(folder.names().size(), count);
    }

    std::string content(const std::string& name) { return text_of(folder / name); }

    ScratchFolder folder;
};

/// Width and height, big-endian, begin at byte 16.
int png_number(const std::string& png, std::size_t at) {
    int number = 0;
    for (std::size_t i = at; i < at + 4; ++i) number = number * 256 + int(static_cast<unsigned char>(png[i]));
    return number;
}

TEST_F(Render, APictureGoesToOutUnlessToldElse) {
    EXPECT_TRUE(begins(written({"pendulum"}), "out/pendulum.png: 640x480 at 0.4 s"));
    const auto png = content("out/pendulum.png");
    EXPECT_TRUE(begins(png, "\x89PNG"));
    EXPECT_EQ(png_number(png, 16), 640);
    EXPECT_EQ(png_number(png, 20), 480);
}

TEST_F(Render, EveryKindOfFile) {
    EXPECT_TRUE(begins(written({"pendulum", "-o", "a.svg", "--at", "1"}), "a.svg: 640x480 at 1 s"));
    EXPECT_TRUE(has(content("a.svg"), "<svg"));
    EXPECT_TRUE(begins(written({"pendulum", "-o", "a.pdf"}), "a.pdf: "));
    EXPECT_TRUE(begins(content("a.pdf"), "%PDF"));
    const Arguments small{"--seconds", "0.5", "--size", "64x48"};
    const auto film = [&](const std::string& path) {
        return written({"pendulum", "-o", path, small[0], small[1], small[2], small[3]});
    };
    EXPECT_TRUE(begins(film("a.gif"), "a.gif: 13 frames of 64x48 from 0 to 0.52 s"));
    EXPECT_TRUE(begins(content("a.gif"), "GIF89a"));
    EXPECT_TRUE(begins(film("a.mp4"), "a.mp4: 30 frames of 64x48 from 0 to 0.5 s"));
    EXPECT_TRUE(begins(content("a.mp4").substr(4), "ftyp"));
    EXPECT_TRUE(begins(film("a.webm"), "a.webm: 30 frames of 64x48 from 0 to 0.5 s"));
    EXPECT_TRUE(begins(content("a.webm"), "\x1A\x45\xDF\xA3")) << "EBML";
    EXPECT_TRUE(begins(film("a.webp"), "a.webp: 15 frames of 64x48 from 0 to 0.5 s"));
    EXPECT_TRUE(begins(content("a.webp"), "RIFF"));
    EXPECT_EQ(folder.names().size(), 6u); // nothing else is left behind
}

TEST_F(Render, AContactSheet) {
    EXPECT_TRUE(begins(written({"pendulum", "-o", "a.png", "--sheet", "4x3", "--seconds", "1"}),
                       "a.png: 12 frames of 320x240 from 0 to 1 s"));
    EXPECT_GT(png_number(content("a.png"), 16), 4 * 320);
    EXPECT_GT(png_number(content("a.png"), 20), 3 * 240);
}

TEST_F(Render, APictureShowsTheMomentAsked) {
    written({"pendulum", "-o", "at.svg", "--at", "0.5"});
    written({"pendulum", "-o", "seconds.svg", "--seconds", "0.5"});
    written({"pendulum", "-o", "other.svg", "--at", "0.6"});
    EXPECT_EQ(content("at.svg"), content("seconds.svg"));
    EXPECT_NE(content("at.svg"), content("other.svg"));
}

/// A frame shows the last step that is not after it: at 60 Hz those of 0.5 s are the same up to 0.5 + 1/60 s.
TEST_F(Render, AFrameShowsTheLastStepBeforeIt) {
    written({"pendulum", "-o", "a.svg", "--at", "0.5"});
    written({"pendulum", "-o", "b.svg", "--at", "0.516"});
    written({"pendulum", "-o", "c.svg", "--at", "0.517"});
    EXPECT_EQ(content("a.svg"), content("b.svg"));
    EXPECT_NE(content("a.svg"), content("c.svg"));
}

TEST_F(Render, WhatCannotBeWrittenIsRefused) {
    expect_refused({"pendulum", "-o", "a.bmp"}, "unknown extension .bmp");
    expect_refused({"pendulum", "-o", "a"}, "no extension");
    expect_refused({"pendulum", "-o", "a.gif", "--fps", "60"}, "cannot keep 60 frames a second");
    expect_refused({"pendulum", "-o", "a.mp4", "--sheet", "2x2"}, "a contact sheet is a still image");
    expect_refused({"pendulum", "--size", "100000x10"}, "too large");
    expect_refused({"pendulum", "-o", "/proc/a.png"}, "cannot write /proc/a.png");
    expect_refused({"pendulum", "solver.mode=none", "-o", "a.png"}, "solver.mode=none");
}

TEST_F(Render, AMissingFfmpegIsTold) {
    const auto outcome = sinew({"render", "pendulum", "-o", "a.mp4"},
                               {.environment = {{"PATH", "/nonexistent"}}, .folder = folder.path});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.err, "ffmpeg"));
    EXPECT_EQ(folder.names(), nothing);
}

TEST_F(Render, CtrlCLeavesNothing) {
    for (const auto* file : {"long.mp4", "long.gif", "long.png"}) {
        Running render({"render", "pendulum", "-o", file, "--seconds", "1000000"}, {.folder = folder.path});
        wait_for_files(1);
        std::this_thread::sleep_for(std::chrono::milliseconds(50)); // in the midst of it
        render.interrupt();
        const auto outcome = render.wait();
        EXPECT_EQ(outcome.code, 130);
        EXPECT_EQ(outcome.err, "sinew: interrupted\n");
        EXPECT_EQ(folder.names(), nothing);
    }
}

TEST_F(Render, CtrlCSparesTheFileOfThatName) {
    written({"pendulum", "-o", "a.svg"});
    const auto before = content("a.svg");
    Running render({"render", "pendulum", "-o", "a.svg", "--at", "1000000"}, {.folder = folder.path});
    wait_for_files(2);
    render.interrupt();
    EXPECT_EQ(render.wait().code, 130);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.svg"});
    EXPECT_EQ(content("a.svg"), before);
}

TEST_F(Render, ShowsProgressOnATerminal) {
    const Setting on_terminal{.folder = folder.path, .terminal = true};
    EXPECT_TRUE(has(sinew({"render", "pendulum", "-o", "a.mp4"}, on_terminal).err, "a.mp4  ["));
}

TEST_F(Render, LaysOverWhatIsAskedFor) {
    const auto drawn = [&](Arguments more) {
        Arguments all = {"render", "pendulum", "-o", folder / "a.svg", "--at", "1"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_EQ(sinew(all).code, 0);
        return text_of(folder / "a.svg");
    };
    const auto plain = drawn({});
    EXPECT_NE(drawn({"--overlay", "pins"}), plain);
    EXPECT_NE(drawn({"--overlay", "strain,names"}), drawn({"--overlay", "names"}));
    const auto wrong = sinew({"render", "pendulum", "--overlay", "strian"});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_TRUE(has(wrong.err, "there is no overlay called \"strian\""));
    EXPECT_TRUE(has(wrong.err, "did you mean \"strain\"?"));
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
