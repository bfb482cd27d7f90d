#include "canvas/formats.h"
#include "tests/canvas/pixels.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/canvas/tumbling_figure.h"

#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace sinew::SINEW_TEST_FILE {
namespace {

using canvas::Failure;

Failure write(const std::filesystem::path& path, const Picture& picture) {
    auto [writer, failure] = canvas::open(path, {picture.width, picture.height});
    if (!failure) failure = writer->frame(picture);
    if (!failure) failure = writer->finish();
    return failure;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

/// Every tag that is opened is closed, in the right order.
bool is_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    for (auto begin = xml.find('<'); begin != std::string::npos; begin = xml.find('<', begin + 1)) {
        const auto end = xml.find('>', begin);
        if (end == std::string::npos) return false;
        if (xml[begin + 1] == '?') continue;
        const bool closes = xml[begin + 1] == '/';
        const auto name_begin = begin + (closes ? 2 : 1);
        const std::string name = xml.substr(name_begin, xml.find_first_of(" \n/>", name_begin) - name_begin);
        if (closes && (open.empty() || open.back() != name)) return false;
        if (closes)
            open.pop_back();
        else if (xml[end - 1] != '/')
            open.push_back(name);
    }
    return open.empty();
}

TEST(Png, HasThePixelsOfThePicture) {
    ScratchFolder folder;
    TumblingFigure figure;
    ASSERT_EQ(write(folder / "figure.png", figure.at(0)), Failure());
    const PngFile image(folder / "figure.png");
    EXPECT_EQ(image.width, 640);
    EXPECT_EQ(image.height, 480);
    expect_near(image.at(10, 10), TumblingFigure::paper);
    expect_near(image.at(320, 128), TumblingFigure::skin);  // the head
    expect_near(image.at(310, 230), TumblingFigure::cloth); // the trunk
    EXPECT_EQ(folder.names(), std::vector<std::string>{"figure.png"});
}

TEST(Png, KeepsTransparency) {
    ScratchFolder folder;
    Picture picture;
    picture.width = picture.height = 20;
    picture.background = {0, 0, 0, 0};
    picture.add(Shape::disc, std::array{Vec2<float>{10, 10}}, 10, {1, 0, 0, 1});
    ASSERT_EQ(write(folder / "disc.png", picture), Failure());
    const PngFile image(folder / "disc.png");
    EXPECT_EQ(image.at(0, 0), (Pixel{0, 0, 0, 0}));
    EXPECT_EQ(image.at(10, 10), (Pixel{255, 0, 0, 255}));
}

TEST(Svg, IsWellFormedAndEveryItemIsAFillOrAStroke) {
    ScratchFolder folder;
    TumblingFigure figure;
    const Picture& picture = figure.at(0);
    ASSERT_EQ(write(folder / "figure.svg", picture), Failure());
    const std::string svg = text_of(folder / "figure.svg");
    EXPECT_TRUE(is_well_formed(svg));
    EXPECT_TRUE(svg.find("width=\"640px\" height=\"480px\"") != std::string::npos) << svg.substr(0, 200);
    // The background is one more fill. (A polygon and the stroke about it may share a path.)
    EXPECT_EQ(count(svg, "fill:rgb") + count(svg, "stroke:rgb"), picture.items.size() + 1);
    EXPECT_EQ(count(svg, "<image"), 0u) << "no pixels in a vector image";
}

TEST(Pdf, IsOnePageOfVectors) {
    ScratchFolder folder;
    TumblingFigure figure;
    ASSERT_EQ(write(folder / "figure.pdf", figure.at(0)), Failure());
    const std::string pdf = text_of(folder / "figure.pdf");
    EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
    EXPECT_EQ(pdf.substr(pdf.size() - 6), "%%EOF\n");
    EXPECT_EQ(count(pdf, "/Type /Page "), 1u);
    EXPECT_TRUE(pdf.find("/MediaBox [ 0 0 640 480 ]") != std::string::npos);
    EXPECT_EQ(count(pdf, "/Subtype /Image"), 0u);
}

TEST(Image, ExtensionMayBeInCapitals) {
    ScratchFolder folder;
    TumblingFigure figure;
    ASSERT_EQ(write(folder / "FIGURE.SVG", figure.at(0)), Failure());
    EXPECT_TRUE(text_of(folder / "FIGURE.SVG").starts_with("<?xml"));
}

TEST(Image, HoldsOnePicture) {
    ScratchFolder folder;
    TumblingFigure figure;
    auto [writer, failure] = canvas::open(folder / "figure.png", {});
    ASSERT_EQ(failure, Failure());
    EXPECT_EQ(writer->frame(figure.at(0)), Failure());
    EXPECT_EQ(writer->frame(figure.at(0)),
              "cannot write " + (folder / "figure.png").string() + ": it holds one picture, not several");
    EXPECT_EQ(folder.names(), std::vector<std::string>());
}

TEST(Image, WithoutAPictureIsNotWritten) {
    ScratchFolder folder;
    auto [writer, failure] = canvas::open(folder / "figure.png", {});
    ASSERT_EQ(failure, Failure());
    EXPECT_EQ(writer->finish(), "cannot write " + (folder / "figure.png").string() + ": no picture was given");
    EXPECT_EQ(folder.names(), std::vector<std::string>());
}

TEST(Image, ReplacesAnOlderOneOnlyWhenItIsWhole) {
    ScratchFolder folder;
    TumblingFigure figure;
    const auto path = folder / "figure.svg";
    std::ofstream(path) << "older";
    {
        auto [writer, failure] = canvas::open(path, {});
        ASSERT_EQ(failure, Failure());
        ASSERT_EQ(writer->frame(figure.at(0)), Failure());
        EXPECT_EQ(text_of(path), "older");
    }
    EXPECT_EQ(text_of(path), "older") << "given up before finish()";
    EXPECT_EQ(folder.names(), std::vector<std::string>{"figure.svg"});
    ASSERT_EQ(write(path, figure.at(0)), Failure());
    EXPECT_TRUE(text_of(path).starts_with("<?xml"));
}

TEST(Image, BehindALinkIsReplacedAndTheLinkStays) {
    ScratchFolder folder;
    TumblingFigure figure;
    std::ofstream(folder / "real.svg") << "older";
    std::filesystem::create_symlink("real.svg", folder / "link.svg");
    ASSERT_EQ(write(folder / "link.svg", figure.at(0)), Failure());
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.svg"));
    EXPECT_TRUE(text_of(folder / "real.svg").starts_with("<?xml"));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
