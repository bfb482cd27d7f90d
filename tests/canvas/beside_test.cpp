#include "canvas/beside.h"
#include "canvas/raster.h"
#include "tests/canvas/pixels.h"

#include <array>
#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

Picture page(const Color& background) {
    Picture picture;
    picture.width = 200, picture.height = 480;
    picture.background = background;
    return picture;
}

/// Two pictures of 200 x 480 beside each other.
struct Beside : testing::Test {
    Picture left = page(white), right = page(black), whole;

    Pixel at(int x, int y) {
        const std::array parts = {canvas::Labelled{&left, "one"}, canvas::Labelled{&right, "two"}};
        canvas::put_beside(parts, whole);
        canvas::Raster raster(whole.width, whole.height);
        EXPECT_EQ(raster.paint(whole), canvas::Failure());
        Pixel pixel = pixel_from(raster.bytes().data() + 4 * (y * raster.width() + x));
        pixel.alpha = 255;
        return pixel;
    }
    int above() const { return canvas::size_beside(2, 200, 480).height - 480; }
    int second() const { return canvas::size_beside(2, 200, 480).width - 200; }
};

TEST_F(Beside, EachHasItsPlaceAndItsPaper) {
    EXPECT_EQ(at(1, above() + 1), pixel_of(white));
    EXPECT_EQ(at(199, above() + 479), pixel_of(white));
    EXPECT_EQ(at(second(), above()), pixel_of(black));
    EXPECT_EQ(at(whole.width - 1, whole.height - 1), pixel_of(black));
    EXPECT_NE(at(201, above() + 5), pixel_of(white)) << "a gap";
    EXPECT_EQ(whole.texts, (std::vector<std::string>{"one", "two"}));
}

TEST_F(Beside, WhatSticksOutIsNotSeenInTheNeighbour) {
    const std::array across = {Vec2<float>{-500, 100}, Vec2<float>{500, 100}};
    left.add(Shape::polyline, across, 20, red);
    EXPECT_EQ(at(100, above() + 100), pixel_of(red));
    EXPECT_EQ(at(second() + 100, above() + 100), pixel_of(black));
    const std::array down = {Vec2<float>{100, -500}, Vec2<float>{100, 500}};
    right.add(Shape::polyline, down, 20, red);
    EXPECT_EQ(at(second() + 100, above() + 100), pixel_of(red));
    EXPECT_NE(at(second() + 100, 2), pixel_of(red)) << "nor in its label";
}

TEST_F(Beside, TextsAndImagesKeepTheirNumbers) {
    left.add_text("left", {{100, 100}}, 10, black);
    right.add_text("right", {{100, 100}}, 10, white);
    const auto image = std::make_shared<Image>();
    right.images = {image};
    const std::array<Vec2<float>, 4> grid = {{{{0, 0}}, {{9, 0}}, {{0, 9}}, {{9, 9}}}};
    left.images = {nullptr, nullptr};
    right.add_image(0, grid, 2, {});
    at(0, 0);
    EXPECT_EQ(whole.texts, (std::vector<std::string>{"one", "left", "two", "right"}));
    for (const auto& item : whole.items) {
        EXPECT_TRUE(item.shape != Shape::image || whole.images.at(item.number) == image);
        EXPECT_TRUE(item.shape != Shape::text || item.number < whole.texts.size());
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
