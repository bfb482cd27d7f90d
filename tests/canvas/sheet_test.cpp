#include "canvas/sheet.h"
#include "tests/canvas/pixels.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/canvas/tumbling_figure.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

using canvas::Failure;
using canvas::SheetFormat;

Failure write(const std::filesystem::path& path, const SheetFormat& format, int frames) {
    auto [writer, failure] = canvas::open_sheet(path, format);
    TumblingFigure figure;
    for (int i = 0; i < frames && !failure; ++i) failure = writer->frame(figure.at(float(i)));
    return failure ? failure : writer->finish();
}

const SheetFormat three_by_two{
    .columns = 3, .rows = 2, .frame_width = 160, .frame_height = 120, .seconds_between = 0.5};

TEST(Component, LaysFramesOutInReadingOrderOnAMount) {
    ScratchFolder folder;
    ASSERT_EQ(write(folder / "sheet.png", three_by_two, 6), Failure());
    const PngFile sheet(folder / "sheet.png");
    EXPECT_EQ(sheet.width, 3 * 160 + 4 * 14);
    EXPECT_EQ(sheet.height, 2 * (120 + 22) + 14 + 7);
    const Pixel mount = sheet.at(0, 0);
    EXPECT_GT(difference(mount, pixel_of(TumblingFigure::paper)), 10);
    for (int column : {0, 1, 2})
        for (int row : {0, 1}) {
            const int left = 14 + column * 174, top = 14 + row * 142;
            expect_near(sheet.at(left + 3, top + 10), TumblingFigure::paper);
            EXPECT_EQ(sheet.at(left - 2, top + 60), mount) << column << ' ' << row;
            EXPECT_EQ(sheet.at(left, top), mount) << "corners are round";
        }
}

TEST(Component, HasATimeUnderEachFrame) {
    ScratchFolder folder;
    ASSERT_EQ(write(folder / "sheet.png", three_by_two, 5), Failure());
    const PngFile sheet(folder / "sheet.png");
    const auto lettered = [&](int column, int row) {
        int marks = 0;
        for (int x = 0; x < 160; ++x)
            for (int y = 0; y < 22; ++y)
                marks += sheet.at(14 + column * 174 + x, 14 + row * 142 + 120 + y) != sheet.at(0, 0);
        return marks > 20;
    };
    for (int frame = 0; frame < 6; ++frame) EXPECT_EQ(lettered(frame % 3, frame / 3), frame < 5) << frame;
}

TEST(Component, CanBeVectors) {
    ScratchFolder folder;
    ASSERT_EQ(write(folder / "sheet.svg", three_by_two, 6), Failure());
    const std::string svg = text_of(folder / "sheet.svg");
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    EXPECT_TRUE(svg.find("<image") == std::string::npos);
}

TEST(Component, HasRoomForItsFramesAndNoMore) {
    ScratchFolder folder;
    EXPECT_EQ(write(folder / "sheet.png", three_by_two, 7),
              "cannot write " + (folder / "sheet.png").string() + ": it has room for 6 pictures");
    EXPECT_EQ(folder.names(), std::vector<std::string>());
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
