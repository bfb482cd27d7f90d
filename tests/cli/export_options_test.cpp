#include "canvas/png.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/cli/command.h"
#include "tests/text_of.h"

#include <fstream>

/// Options of `sinew export` for pictures, films and moments.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

/// A falling ball, and a rope that is cut after 0.2 s.
constexpr const char* falling = R"({"sinew": 1, "view": {"size": [80, 60], "center": [0, 0], "height": 6},
"figures": [{"name": "ball", "particles": {"p": {"at": [0, 2], "mass": 1, "radius": 0.5}}},
            {"prefab": "rope", "name": "line", "at": [-2, 2]}],
"events": [{"at": 0.2, "cut": [[-3, 1], [-1, 1]]}]})";

class ExportOptions : public testing::Test {
  protected:
    ScratchFolder folder;

    void SetUp() override { std::ofstream(folder / "fall.json") << falling; }

    /// Exports into a file of the folder; fails the test unless the command succeeds.
    void export_to(const std::string& file, std::vector<std::string> options) {
        std::vector<std::string> words{"export", "fall.json", "-o", file};
        words.insert(words.end(), options.begin(), options.end());
        const auto outcome = sinew(words, {.environment = {}, .folder = folder.path});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
    Image picture(const std::string& file) const {
        const auto read = canvas::read_png(folder / file, file, Limits{});
        EXPECT_TRUE(read.image) << read.problem;
        return read.image ? *read.image : Image{1, 1, {0}};
    }
    static std::uint32_t pixel(const Image& image, int x, int y) {
        return image.pixels[std::size_t(y * image.width + x)];
    }
};

TEST_F(ExportOptions, ASequenceIsTransparentAndAsLargeAsTold) {
    export_to("a-%04d.png", {"--seconds", "0.1", "--fps", "30", "--background", "none", "--scale", "0.5"});
    EXPECT_EQ(folder.names().size(), 4U); // three frames, and the scene
    const auto image = picture("a-0003.png");
    EXPECT_EQ(image.width, 40);
    EXPECT_EQ(image.height, 30);
    EXPECT_EQ(pixel(image, 39, 29), 0U);
    export_to("red.png", {"--at", "0", "--background", "#ff0000"});
    EXPECT_EQ(pixel(picture("red.png"), 79, 59), 0xffff0000U);
}

TEST_F(ExportOptions, FilmsHaveTransparency) {
    const std::vector<std::string> options{"--seconds", "0.2", "--fps", "10", "--background", "none"};
    for (const char* file : {"a.apng", "a.webm", "a.mov"}) export_to(file, options);
    const auto apng = text_of(folder / "a.apng");
    EXPECT_TRUE(has(apng, "acTL"));
    EXPECT_EQ(apng[25], 6);                                           // colour with opacity
    EXPECT_TRUE(has(text_of(folder / "a.webm"), "\x53\xc0\x81\x01")); // Matroska's AlphaMode
    EXPECT_TRUE(has(text_of(folder / "a.mov"), "ap4h"));              // ProRes 4444
    export_to("a.jpg", {"--at", "0.1"});
    EXPECT_TRUE(begins(text_of(folder / "a.jpg"), "\xff\xd8\xff"));
}

TEST_F(ExportOptions, UntilAnEventIsTheLastFrame) {
    export_to("t.csv", {"--seconds", "1", "--fps", "20", "--until", "cut", "--of", "ball"});
    const auto trace = text_of(folder / "t.csv");
    EXPECT_EQ(std::count(trace.begin(), trace.end(), '\n'), 1 + 6) << trace; // a head, and 0 to 0.25 s
}

TEST_F(ExportOptions, UntilAnEventIsTheMomentOfAPicture) {
    export_to("cut.png", {"--until", "cut"});
    export_to("then.png", {"--at", "0.2167"}); // the step after 0.2 s, in which it is cut
    EXPECT_EQ(text_of(folder / "cut.png"), text_of(folder / "then.png"));
    const auto none = sinew({"export", "fall.json", "-o", "no.jpg", "--seconds", "1", "--until", "torn"},
                            {.environment = {}, .folder = folder.path});
    EXPECT_EQ(none.code, 1);
    EXPECT_TRUE(has(none.err, "no event \"torn\" happens until 1 s")) << none.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "no.jpg"));
}

TEST_F(ExportOptions, AnEventThatCannotComeIsRefusedBeforeAStep) {
    const auto refused = [&](const std::string& kind) {
        const auto run = sinew({"export", "fall.json", "-o", "no.png", "--seconds", "1e9", "--until", kind},
                               {.environment = {}, .folder = folder.path});
        EXPECT_EQ(run.code, kind == "hit" ? 1 : 2) << run.err;
        return run.err;
    };
    EXPECT_TRUE(has(refused("tron"), "there is no event called \"tron\""));
    EXPECT_TRUE(has(refused("tron"), "did you mean \"torn\"?"));
    EXPECT_TRUE(has(refused("hit"), "waits for no contact of the kind \"hit\""));
}

TEST_F(ExportOptions, AFormatTellsOptionsThatItHasNoUseFor) {
    const auto run = sinew({"export", "fall.json", "-o", "a.obj", "--at", "0", "--background", "red", "--caption", "hi",
                            "--follow", "ball", "--scale", "2", "--joints", "4", "--error", "1"},
                           {.environment = {}, .folder = folder.path});
    EXPECT_EQ(run.code, 0) << run.err;
    for (const char* option : {"--background", "--caption", "--follow", "--size or --scale", "--joints", "--error"})
        EXPECT_TRUE(has(run.out, std::string("note: ") + option + " is for ")) << option << run.out;
    const auto used = sinew({"export", "fall.json", "-o", "a.svg", "--seconds", "0.1", "--background", "red",
                             "--caption", "hi", "--follow", "ball", "--scale", "2", "--error", "1"},
                            {.environment = {}, .folder = folder.path});
    EXPECT_FALSE(has(used.out, " is for ")) << used.out;
}

TEST_F(ExportOptions, AFigureIsDrawnAlone) {
    const std::vector<std::string> bare{"--at", "0", "--background", "none", "view.plain=true"};
    export_to("all.png", bare);
    auto alone = bare;
    alone.insert(alone.end(), {"--of", "ball"});
    export_to("ball.png", alone);
    const auto all = picture("all.png"), ball = picture("ball.png");
    EXPECT_NE(pixel(ball, 40, 10), 0U);
    EXPECT_EQ(pixel(all, 40, 10), pixel(ball, 40, 10));
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 25; ++x) EXPECT_EQ(pixel(ball, x, y), 0U) << x << ", " << y; // the rope is at 20
    EXPECT_NE(all.pixels, ball.pixels);
}

TEST_F(ExportOptions, AFollowedFigureStaysInTheMiddle) {
    export_to("f-%d.png",
              {"--seconds", "0.75", "--fps", "4", "--follow", "ball", "--background", "none", "view.plain=true"});
    for (const char* file : {"f-1.png", "f-3.png"}) {
        const auto image = picture(file);
        EXPECT_NE(pixel(image, 40, 30) >> 24U, 0U) << file;
        EXPECT_EQ(pixel(image, 40, 45), 0U) << file;
    }
    export_to("still-%d.png", {"--seconds", "0.75", "--fps", "4", "--background", "none", "view.plain=true"});
    EXPECT_EQ(pixel(picture("still-1.png"), 40, 30), 0U); // the ball is above the middle
}

TEST_F(ExportOptions, ACaptionIsAtTheBottom) {
    export_to("c.svg", {"--seconds", "0.2", "--fps", "10", "--caption", "Hello & you"});
    EXPECT_TRUE(has(text_of(folder / "c.svg"), ">Hello &amp; you</text>"));
    export_to("with.png", {"--at", "0", "--caption", "HHHHHHHH"});
    export_to("without.png", {"--at", "0"});
    const auto with = picture("with.png"), without = picture("without.png");
    const auto half = std::ptrdiff_t(80 * 40);
    EXPECT_TRUE(std::equal(with.pixels.begin(), with.pixels.begin() + half, without.pixels.begin()));
    EXPECT_NE(with.pixels, without.pixels);
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
