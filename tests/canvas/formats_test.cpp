#include "canvas/formats.h"
#include "canvas/sheet.h"

#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace sinew::SINEW_TEST_FILE {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

using canvas::check;
using canvas::Failure;

TEST(Formats, EachTakesItsUsualFrames) {
    for (const canvas::Format& format : canvas::formats())
        EXPECT_EQ(check(std::string("x").append(format.extension), {640, 480, format.usual_fps}), Failure());
}

TEST(Formats, UnknownExtensionNamesTheValidOnesAndTheNearest) {
    EXPECT_EQ(check("out/a.mp5", {}), "out/a.mp5: unknown extension .mp5; did you mean .mp4? (possible are .png, .svg, "
                                      ".pdf, .gif, .mp4, .webp, .webm)");
    EXPECT_EQ(check("out/a.wepb", {}), "out/a.wepb: unknown extension .wepb; did you mean .webp? (possible are .png, "
                                       ".svg, .pdf, .gif, .mp4, .webp, .webm)");
    EXPECT_EQ(check("a.avi", {}),
              "a.avi: unknown extension .avi (possible are .png, .svg, .pdf, .gif, .mp4, .webp, .webm)");
    EXPECT_EQ(check("a", {}), "a: no extension (possible are .png, .svg, .pdf, .gif, .mp4, .webp, .webm)");
    EXPECT_EQ(check("out/", {}), "out/: no extension (possible are .png, .svg, .pdf, .gif, .mp4, .webp, .webm)");
}

TEST(Formats, SizeWithoutPixelsIsRefused) {
    EXPECT_EQ(check("a.png", {0, 480}), "a size of 0x480 has no pixels");
    EXPECT_EQ(check("a.mp4", {640, -1}), "a size of 640x-1 has no pixels");
}

TEST(Formats, SizeOverTheLimitIsRefusedWithTheLimit) {
    EXPECT_EQ(check("a.png", {16384, 1}), Failure());
    EXPECT_EQ(check("a.png", {16385, 1}), "16385x1 is too large: a .png has at most 16384 pixels a side");
    EXPECT_EQ(check("a.mp4", {1, 8193}), "1x8193 is too large: a .mp4 has at most 8192 pixels a side");
    EXPECT_EQ(check("a.png", {16384, 16384}), "16384x16384 is too large: a picture has at most 67108864 pixels in all");
    EXPECT_TRUE(check("a.png", {2147483647, 2147483647}));
}

TEST(Formats, GifKeepsOnlyWholeHundredthsOfASecond) {
    for (double fps : {50., 25., 20., 10., 1.}) EXPECT_EQ(check("a.gif", {640, 480, fps}), Failure()) << fps;
    EXPECT_EQ(check("a.gif", {640, 480, 60}),
              "a .gif counts time in hundredths of a second and cannot keep 60 frames a second; use 50, 25, 20 or 10");
    for (double fps : {100., 30., 0., -5., not_a_number}) EXPECT_TRUE(check("a.gif", {640, 480, fps})) << fps;
}

TEST(Formats, FilmsKeepOneTo240FramesASecond) {
    for (double fps : {1., 23.976, 60., 240.}) EXPECT_EQ(check("a.mp4", {640, 480, fps}), Failure()) << fps;
    EXPECT_EQ(check("a.webp", {640, 480, 1000}), "1000 frames a second cannot be; use 1 to 240");
    for (double fps : {0., -1., not_a_number}) EXPECT_TRUE(check("a.mp4", {640, 480, fps})) << fps;
}

TEST(Formats, SheetIsAStillImageOfAtLeastOneFrame) {
    EXPECT_EQ(canvas::check_sheet("a.png", {}), Failure());
    EXPECT_EQ(canvas::check_sheet("a.mp4", {}), "a.mp4: a contact sheet is a still image; use .png, .svg or .pdf");
    EXPECT_EQ(canvas::check_sheet("a.png", {.columns = 0}), "a sheet of 0x3 frames has no frames");
    EXPECT_EQ(canvas::check_sheet("a.png", {.frame_width = 0}), "a size of 0x240 has no pixels");
    EXPECT_EQ(canvas::check_sheet("a.png", {.columns = 100, .rows = 1, .frame_width = 640}),
              "65414x283 is too large: a sheet of 100x1 such frames has at most 16384 pixels a side");
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
