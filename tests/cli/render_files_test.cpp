#include "tests/canvas/pixels.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/cli/command.h"

#include <chrono>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <thread>

/// Outputs of sinew render: variants beside each other, pipes, files that are watched, disks that are full.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

namespace fs = std::filesystem;

struct RenderFiles : testing::Test {
    ScratchFolder folder;

    Outcome render(Arguments arguments, Setting setting = {}) {
        arguments.insert(arguments.begin(), "render");
        setting.folder = folder.path;
        return sinew(arguments, setting);
    }

    std::string written(const Arguments& arguments) {
        const auto outcome = render(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.out;
    }

    void expect_wrong(const Arguments& arguments, int code, const char* message, const char* help = "") {
        const auto outcome = render(arguments);
        EXPECT_EQ(outcome.code, code) << outcome.out;
        EXPECT_TRUE(has(outcome.err, message));
        EXPECT_TRUE(has(outcome.err, help));
        EXPECT_EQ(folder.names(), std::vector<std::string>());
    }

    void expect_beside_as_alone(const std::string& scene);

    static void wait_for(const std::function<bool()>& reached) {
        for (int i = 0; i < 6000; ++i) {
            if (reached()) return; // once is enough: the next moment files may be gone again
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        FAIL() << "half a minute has passed";
    }
};

/// Classic mode beside few substeps shows what either shows alone.
void RenderFiles::expect_beside_as_alone(const std::string& scene) {
    const auto draw = [&](const std::string& file, Arguments more) {
        more.insert(more.begin(), {scene, "-o", file, "--size", "200x150", "--at", "1"});
        return written(more);
    };
    draw("classic.png", {"mode=classic"});
    draw("coarse.png", {"mode=physical", "solver.substeps=1"});
    EXPECT_TRUE(begins(draw("both.png", {"--beside", "classic,solver.substeps=1", "mode=physical"}), "both.png: "));
    const PngFile both(folder / "both.png"), classic(folder / "classic.png"), coarse(folder / "coarse.png");
    EXPECT_GT(both.width, 400);
    EXPECT_LT(both.width, 410);
    EXPECT_GT(both.height, 150);
    for (int y = 0; y < 150; ++y)
        for (int x = 0; x < 200; ++x) {
            ASSERT_EQ(both.at(x, both.height - 150 + y), classic.at(x, y)) << x << ' ' << y;
            ASSERT_EQ(both.at(both.width - 200 + x, both.height - 150 + y), coarse.at(x, y)) << x << ' ' << y;
        }
}

TEST_F(RenderFiles, BesideShowsEachVariantAsItIsAlone) {
    expect_beside_as_alone("pendulum");
}

TEST_F(RenderFiles, BesideLeavesAModeItsOwnView) {
    std::ofstream(folder / "own.json") << R"({"sinew": 1, "view": {"height": 4}, "figures": [{"prefab": "rope"}],
        "modes": {"classic": {"view": {"height": 9}}}})";
    expect_beside_as_alone("own.json");
}

TEST_F(RenderFiles, BesideGoesIntoEveryKindOfFile) {
    for (const auto* file : {"a.png", "a.svg", "a.pdf", "a.gif", "a.mp4", "a.webm", "a.webp"}) {
        const auto said = written({"pendulum", "-o", file, "--beside", "classic,physical,world.gravity=[0,-1]",
                                   "--size", "64x48", "--seconds", "0.2"});
        EXPECT_TRUE(has(said, said.find("frames") == std::string::npos ? ": 194x51 at" : "of 194x5")) << said;
    }
    EXPECT_TRUE(begins(written({"pendulum", "-o", "b.png", "--beside", "classic,physical", "--sheet", "2x1"}),
                       "b.png: 2 frames of 642x253 from 0 to 2 s"));
    EXPECT_EQ(folder.names().size(), 8U);
}

TEST_F(RenderFiles, BesideSaysWhatItCannotUse) {
    expect_wrong({"pendulum", "--beside", "classic"}, 2, "--beside takes 2 to 4 variants, found 1");
    expect_wrong({"pendulum", "--beside", "classic,classic,classic,classic,physical"}, 2, "found 5");
    expect_wrong({"pendulum", "--beside", "clasic,physical"}, 2, "\"clasic\" is neither a mode nor key=value",
                 "did you mean \"classic\"?");
    expect_wrong({"pendulum", "--beside", "classic,"}, 2, "\"\" is neither a mode nor key=value");
    expect_wrong({"pendulum", "--beside", "classic,solver.substpes=4"}, 1, "unknown property \"substpes\"");
    expect_wrong({"pendulum", "--beside", "classic,physical", "--size", "9000x10", "-o", "a.png"}, 1, "too large");
}

TEST_F(RenderFiles, BesideReadsStandardInputOnce) {
    const auto scene = text_of(catalogue() / "pendulum.json");
    const auto outcome = render({"-", "-o", "a.svg", "--beside", "classic,physical"}, {.input = scene});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(RenderFiles, TellsTheSizeThatIsWritten) {
    const Arguments odd{"pendulum", "-o", "a.mp4", "--size", "321x241", "--seconds", "0.1"};
    EXPECT_TRUE(begins(written(odd), "a.mp4: 6 frames of 322x242 (321x241 padded, as its kind needs) from 0"));
    EXPECT_TRUE(begins(written({"pendulum", "-o", "a.gif", "--size", "321x241", "--seconds", "0.1"}),
                       "a.gif: 3 frames of 321x241 from 0"));
}

TEST_F(RenderFiles, APipeTakesEveryKind) {
    const auto piped = [&](Arguments more) {
        more.insert(more.begin(), {"pendulum", "-o", "-", "--size", "64x48", "--seconds", "0.2"});
        const auto outcome = render(more, {.environment = {{"TMPDIR", folder.path}}});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_TRUE(begins(outcome.err, "standard output: "));
        EXPECT_EQ(folder.names(), std::vector<std::string>()) << "nothing is left behind";
        return outcome.out;
    };
    EXPECT_TRUE(begins(piped({}), "\x89PNG"));
    EXPECT_TRUE(ends(piped({}), "IEND\xae\x42\x60\x82"));
    EXPECT_TRUE(has(piped({"--format", "svg"}), "</svg>"));
    EXPECT_TRUE(begins(piped({"--format", ".gif"}), "GIF89a"));
    EXPECT_TRUE(begins(piped({"--format", "mp4"}).substr(4), "ftyp"));
}

TEST_F(RenderFiles, APipeSaysWhatItCannotDo) {
    expect_wrong({"pendulum", "-o", "-", "--format", "bmp"}, 1, "unknown extension .bmp");
    expect_wrong({"pendulum", "-o", "a.png", "--format", "gif"}, 2, "--format is for standard output");
    expect_wrong({"pendulum", "-o", "-", "--watch"}, 2, "--watch needs files");
    const auto full = render({"pendulum", "-o", "-"}, {.output = "/dev/full"});
    EXPECT_EQ(full.code, 1);
    EXPECT_TRUE(has(full.err, "cannot write to standard output: No space left on device"));
    EXPECT_EQ(render({"pendulum", "-o", "-"}, {.reader_leaves = true}).code, 0);
}

TEST_F(RenderFiles, WhatAKilledRunLeftIsSweptUpByTheNext) {
    for (const auto* file : {"long.mp4", "long.gif"}) {
        Running killed({"render", "pendulum", "-o", file, "--seconds", "1000000"}, {.folder = folder.path});
        wait_for([&] { return !folder.names().empty(); });
        std::this_thread::sleep_for(std::chrono::milliseconds(50)); // in the midst of it
        killed.kill();
        EXPECT_EQ(killed.wait().code, -9);
        EXPECT_FALSE(folder.names().empty());
        wait_for([&] { // ffmpeg, an orphan now, may have been about to begin its file
            written({"pendulum", "-o", "a.svg"});
            return folder.names() == std::vector<std::string>{"a.svg"};
        });
        fs::remove(folder / "a.svg");
    }
}

TEST_F(RenderFiles, SweepingSparesWhatOthersWriteAndWhatIsNoPartialFile) {
    const std::vector<std::string> spared = {"." + std::string("b.partial-") + std::to_string(getpid()) + ".png",
                                             ".b.partial-.png", ".b.partial-12x.png", "b.partial-4194300.png"};
    for (const auto& name : spared) std::ofstream(folder / name) << "mine";
    written({"pendulum", "-o", "a.svg"});
    for (const auto& name : spared) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST_F(RenderFiles, AFullDiskIsToldByTheNameOfTheOutput) {
    for (const auto* file : {"a.png", "a.gif", "a.mp4", "a.webm", "a.webp"}) {
        const auto outcome = render({"pendulum", "-o", file, "--seconds", "1"}, {.largest_file = 500});
        EXPECT_EQ(outcome.code, 1);
        EXPECT_TRUE(has(outcome.err, std::string("cannot write ") + file + ": "));
        EXPECT_FALSE(has(outcome.err, ".partial-"));
    }
    const auto gallery = sinew({"gallery", "pendulum", "-o", "g.html"}, {.folder = folder.path, .largest_file = 500});
    EXPECT_EQ(gallery.code, 1);
    EXPECT_TRUE(has(gallery.err, "cannot write g.html: "));
    EXPECT_FALSE(has(gallery.err, ".partial-"));
    EXPECT_EQ(folder.names(), std::vector<std::string>());
}

/// A scene that is drawn again whenever it is written.
struct RenderWatch : RenderFiles {
    ScratchFolder outside;
    std::string picture = "a.png";

    void write_scene(const std::string& more) const {
        std::ofstream(folder / "mine.json")
            << R"({"sinew": 1, "figures": [{"prefab": "rope", "name": "rope", )" << more << "}]}";
    }
    std::string said() const { return text_of(outside / "log"); }
    std::size_t attempts() const {
        std::size_t count = 0;
        const auto text = said();
        for (auto at = text.find("watching"); at != std::string::npos; at = text.find("watching", at + 1)) ++count;
        return count;
    }
    void wait_for_attempt(std::size_t number) const {
        wait_for([&] { return attempts() >= number; });
    }
    std::unique_ptr<Running> begin() {
        std::ofstream(outside / "log").flush();
        return std::make_unique<Running>(Arguments{"render", "mine.json", "-o", picture, "--watch"},
                                         Setting{.folder = folder.path, .output = outside / "log"});
    }
};

TEST_F(RenderWatch, DrawsAgainWhatChangedAndSurvivesMistakes) {
    write_scene(R"("length": 1)");
    const auto watch = begin();
    wait_for_attempt(1);
    const auto first = text_of(folder / picture);
    EXPECT_TRUE(has(first, "PNG"));
    write_scene(R"("length": 2)");
    wait_for_attempt(2);
    const auto second = text_of(folder / picture);
    EXPECT_NE(first, second);
    write_scene(R"("lenght": 3)");
    wait_for_attempt(3);
    EXPECT_EQ(text_of(folder / picture), second) << "the last good one stays";
    fs::remove(folder / "mine.json");
    wait_for_attempt(4);
    write_scene(R"("length": 1)");
    wait_for_attempt(5);
    EXPECT_EQ(text_of(folder / picture), first);
    watch->interrupt();
    const auto outcome = watch->wait();
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(has(outcome.err, "unknown property \"lenght\""));
    EXPECT_TRUE(has(outcome.err, "No such file or directory"));
    EXPECT_FALSE(has(outcome.err, "interrupted"));
    EXPECT_EQ(attempts(), 5U) << said();
}

TEST_F(RenderWatch, SeesTheImagesOfTheScene) {
    written({"pendulum", "-o", "ball.png", "--size", "32x32"});
    write_scene(R"("looks": {"all": {"image": {"file": "ball.png", "size": [1, 1]}}})");
    const auto watch = begin();
    wait_for_attempt(1);
    const auto first = text_of(folder / picture);
    written({"pendulum", "-o", "ball.png", "--size", "32x32", "view.theme=dark"});
    wait_for_attempt(2);
    EXPECT_NE(text_of(folder / picture), first);
    watch->interrupt();
    EXPECT_EQ(watch->wait().code, 0);
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
