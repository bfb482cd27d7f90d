#include "canvas/image_painter.h"
#include "canvas/png.h"
#include "canvas/raster.h"
#include "tests/canvas/pixels.h"
#include "tests/canvas/scratch_folder.h"

#include <fstream>
#include <gtest/gtest.h>

/// Images from files, and onto pictures.
namespace sinew::SINEW_TEST_FILE {
namespace {

using canvas::read_png;

/// Red, green / blue, half transparent white.
const std::vector<std::uint32_t> four = {0xffff0000, 0xff00ff00, 0xff0000ff, 0x80808080};

void write_png(const std::filesystem::path& path, int width, int height, std::vector<std::uint32_t> pixels) {
    const canvas::CairoSurface surface(cairo_image_surface_create_for_data(
        reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_ARGB32, width, height, 4 * width));
    ASSERT_EQ(cairo_surface_write_to_png(surface.get(), path.c_str()), CAIRO_STATUS_SUCCESS);
}

struct PngFileRead : testing::Test {
    ScratchFolder folder;
    Limits limits;

    ReadImage read(const std::string& name) { return read_png(folder / name, name, limits); }
    void put(const std::string& name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
    }
    std::string get(const std::string& name) {
        std::ifstream in(folder / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

TEST_F(PngFileRead, GivesItsPixels) {
    write_png(folder / "a.png", 2, 2, four);
    const auto [image, problem, help] = read("a.png");
    ASSERT_TRUE(image) << problem;
    EXPECT_EQ(image->width, 2);
    EXPECT_EQ(image->height, 2);
    EXPECT_EQ(image->pixels, four);
}

TEST_F(PngFileRead, MissingIsSaid) {
    EXPECT_EQ(read("a.png").problem, "cannot read the image \"a.png\": No such file or directory");
    EXPECT_EQ(read_png(folder / "", "x", limits).problem, "cannot read the image \"x\": it is not a file");
}

TEST_F(PngFileRead, OtherFilesAreSaidToBeNone) {
    for (const std::string bytes : {"", "GIF89a", "\x89PNG\r\n\x1a\n", "{\"sinew\": 1, \"about\": \"a scene\"}"}) {
        put("a.png", bytes);
        EXPECT_EQ(read("a.png").problem, "\"a.png\" is not a PNG file");
    }
}

// Wherever it is cut off or damaged: never an image of something else, never a crash.
TEST_F(PngFileRead, DamageIsSaid) {
    std::vector<std::uint32_t> pixels(32 * 32);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = 0xff000000 | std::uint32_t(i * 2654435761U >> 8U);
    write_png(folder / "good.png", 32, 32, pixels);
    const auto good = get("good.png");
    for (std::size_t length = 30; length + 12 < good.size(); length += 97) { // the last chunk says only that it ends
        put("cut.png", good.substr(0, length));
        EXPECT_EQ(read("cut.png").problem, "the image \"cut.png\" is broken") << length;
    }
    for (std::size_t position = good.find("IDAT") + 8; position + 20 < good.size(); position += 131) {
        auto bad = good;
        bad[position] = char(bad[position] ^ 0x55);
        put("bad.png", bad);
        EXPECT_EQ(read("bad.png").problem, "the image \"bad.png\" is broken") << position;
    }
}

// A chunk that claims two gigabytes gets no room; bytes after the last chunk are nobody's.
TEST_F(PngFileRead, ChunksEndWithinTheFile) {
    write_png(folder / "a.png", 2, 2, four);
    const auto good = get("a.png");
    put("more.png", good + "and more");
    EXPECT_EQ(read("more.png").problem, "");
    auto bad = good;
    bad.insert(good.find("IDAT") - 4, std::string("\x73\x6c\x29\x21tEXt", 8));
    put("bad.png", bad);
    EXPECT_EQ(read("bad.png").problem, "the image \"bad.png\" is broken");
}

TEST_F(PngFileRead, TooLargeIsRefusedBeforeItIsUnpacked) {
    write_png(folder / "a.png", 20, 10, std::vector<std::uint32_t>(200));
    limits.pixels = 199;
    EXPECT_EQ(read("a.png").problem, "the image \"a.png\" is 20x10, 200 pixels, of which only 199 are left");
    limits.pixels = 200;
    EXPECT_TRUE(read("a.png").image);
    limits.bytes = 50;
    EXPECT_NE(read("a.png").problem.find("at most 50 are allowed"), std::string::npos);

    auto huge = get("a.png");
    huge.replace(16, 8, std::string("\xff\xff\xff\xff\xff\xff\xff\xff", 8));
    put("huge.png", huge);
    limits = {};
    EXPECT_NE(read("huge.png").problem.find("4294967295x4294967295"), std::string::npos);
}

TEST_F(PngFileRead, ComesInEverySizeItIsSeenIn) {
    write_png(folder / "a.png", 20, 10, std::vector<std::uint32_t>(200, 0xff204060));
    const auto whole = read("a.png").image;
    ASSERT_TRUE(whole && whole->half);
    EXPECT_EQ(whole->half->width, 10);
    EXPECT_EQ(whole->half->height, 5);
    for (const auto pixel : whole->half->pixels) EXPECT_EQ(pixel, 0xff204060);
    write_png(folder / "b.png", 6, 6, [] {
        std::vector<std::uint32_t> checks(36);
        for (std::size_t i = 0; i < 36; ++i) checks[i] = (i + i / 6) % 2 == 0 ? 0xffffffff : 0xff000000;
        return checks;
    }());
    const auto grey = read("b.png").image->half;
    for (const auto pixel : grey->pixels) EXPECT_EQ(pixel, 0xff808080);
}

// --- onto a picture ----------------------------------------------------------------------------------------------

struct PaintedImage : testing::Test {
    Picture picture;
    canvas::Raster raster{100, 100};

    PaintedImage() {
        picture.width = picture.height = 100;
        std::vector<std::uint32_t> pixels(40 * 40);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const bool right = i % 40 >= 20, low = i / 40 >= 20;
            pixels[i] = four[(low ? 2U : 0U) + (right ? 1U : 0U)] | 0xff000000;
        }
        picture.images = {std::make_shared<const Image>(Image{40, 40, std::move(pixels)})};
    }

    void add(std::vector<Vec2<float>> grid, std::uint32_t across, Color over = {0, 0, 0, 0}) {
        picture.add_image(0, grid, across, over);
    }

    void paint() { EXPECT_EQ(raster.paint(picture), canvas::Failure()); }

    Pixel at(int x, int y) const {
        auto pixel = pixel_from(raster.bytes().data() + 4 * (y * 100 + x));
        pixel.alpha = 255;
        return pixel;
    }
};

namespace opaque {
const Pixel red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, grey{128, 128, 128}, white{255, 255, 255};
}

TEST_F(PaintedImage, LiesWhereItsCornersAre) {
    add({{{20, 20}}, {{80, 20}}, {{20, 80}}, {{80, 80}}}, 2);
    paint();
    EXPECT_EQ(at(30, 30), opaque::red);
    EXPECT_EQ(at(70, 30), opaque::green);
    EXPECT_EQ(at(30, 70), opaque::blue);
    EXPECT_EQ(at(70, 70), opaque::grey);
    for (const int outside : {18, 81}) {
        EXPECT_EQ(at(outside, 50), opaque::white);
        EXPECT_EQ(at(50, outside), opaque::white);
    }
}

TEST_F(PaintedImage, TurnsAndMirrorsWithThem) {
    add({{{80, 20}}, {{80, 80}}, {{20, 20}}, {{20, 80}}}, 2); // a quarter turn clockwise
    paint();
    EXPECT_EQ(at(70, 30), opaque::red);
    EXPECT_EQ(at(70, 70), opaque::green);
    EXPECT_EQ(at(30, 30), opaque::blue);
}

TEST_F(PaintedImage, ABentOneHasNoSeams) {
    std::vector<Vec2<float>> grid;
    for (const float y : {30.0F, 70.0F})
        for (int i = 0; i <= 20; ++i) grid.push_back({{10 + float(i) * 4, y + 6 * std::sin(float(i) * 0.4F)}});
    picture.images = {std::make_shared<const Image>(Image{4, 4, std::vector<std::uint32_t>(16, 0xffff0000)})};
    add(grid, 21);
    paint();
    for (int x = 12; x < 88; ++x)
        for (int y = 38; y < 62; ++y) EXPECT_EQ(at(x, y), opaque::red) << x << ' ' << y;
}

TEST_F(PaintedImage, WhatIsHalfTransparentStaysSoWhereItBends) {
    picture.images = {std::make_shared<const Image>(Image{4, 4, std::vector<std::uint32_t>(16, 0x80800000)})};
    std::vector<Vec2<float>> grid;
    for (const float y : {30.0F, 70.0F})
        for (int i = 0; i <= 20; ++i) grid.push_back({{10 + float(i) * 4, y + 6 * std::sin(float(i) * 0.4F)}});
    add(grid, 21);
    paint();
    for (int x = 12; x < 88; x += 3)
        for (int y = 38; y < 62; y += 3) expect_near(at(x, y), {1, 0.498F, 0.498F, 1}, 2);
}

TEST_F(PaintedImage, AColourLiesOverItAsStrongAsItIs) {
    add({{{20, 20}}, {{80, 20}}, {{20, 80}}, {{80, 80}}}, 2, {0, 0, 1, 0.5F});
    paint();
    expect_near(at(30, 30), {0.5F, 0, 0.5F, 1}, 2);
    picture.items.clear();
    add({{{20, 20}}, {{80, 20}}, {{20, 80}}, {{80, 80}}}, 2, {0, 0, 1, 1});
    paint();
    EXPECT_EQ(at(30, 30), opaque::blue);
    EXPECT_EQ(at(10, 30), opaque::white);
}

TEST_F(PaintedImage, WithoutAreaOrOutOfTheWorldIsNotSeen) {
    add({{{20, 20}}, {{80, 20}}, {{20, 20}}, {{80, 20}}}, 2);
    add({{{20, 20}}, {{1e30F, 20}}, {{20, 80}}, {{1e30F, 80}}}, 2);
    add({{{20, 20}}, {{80, 20}}}, 2);
    picture.items.push_back({.shape = Shape::image, .first = 0, .count = 4, .color = {}, .number = 7, .across = 2});
    paint();
    EXPECT_EQ(at(50, 50), opaque::white);
    EXPECT_EQ(at(50, 20), opaque::white);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
