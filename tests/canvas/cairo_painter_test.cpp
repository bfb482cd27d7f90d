#include "canvas/cairo_painter.h"
#include "canvas/raster.h"
#include "tests/canvas/pixels.h"
#include "tests/canvas/tumbling_figure.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace sinew::SINEW_TEST_FILE {
namespace {

using canvas::Raster;

/// Paints pictures of 100 x 100 and reads pixels.
struct CairoPainter : testing::Test {
    Picture picture;
    Raster raster{100, 100};

    CairoPainter() {
        picture.width = picture.height = 100;
        picture.background = white;
    }

    void add(Shape shape, std::vector<Vec2<float>> outline, float width, Color color = black) {
        picture.add(shape, outline, width, color);
    }

    Pixel at(int x, int y) { return at(picture, x, y); }
    Pixel at(const Picture& seen, int x, int y) {
        EXPECT_EQ(raster.paint(seen), canvas::Failure());
        Pixel pixel = pixel_from(raster.bytes().data() + 4 * (y * raster.width() + x));
        pixel.alpha = 255;
        return pixel;
    }
};

TEST_F(CairoPainter, BackgroundReachesEveryCorner) {
    picture.background = red;
    for (int x : {0, 99})
        for (int y : {0, 99}) EXPECT_EQ(at(x, y), pixel_of(red));
}

TEST_F(CairoPainter, DiscEndsAtHalfItsWidthFromItsCentre) {
    add(Shape::disc, {{50, 50}}, 20);
    EXPECT_EQ(at(50, 50), pixel_of(black));
    for (int d : {-9, 8}) EXPECT_EQ(at(50 + d, 50), pixel_of(black)) << d;
    for (int d : {-11, 10}) EXPECT_EQ(at(50 + d, 50), pixel_of(white)) << d;
}

TEST_F(CairoPainter, StrokeHasRoundEndsOfHalfItsWidth) {
    add(Shape::polyline, {{30, 50}, {70, 50}}, 20);
    EXPECT_EQ(at(21, 50), pixel_of(black)) << "the cap reaches 10 pixels beyond the end";
    EXPECT_EQ(at(18, 50), pixel_of(white));
    EXPECT_EQ(at(21, 41), pixel_of(white)) << "a square cap would cover the corner";
    EXPECT_EQ(at(50, 40), pixel_of(black));
    EXPECT_EQ(at(50, 39), pixel_of(white));
}

TEST_F(CairoPainter, LoopIsClosedAndPolylineIsNot) {
    const std::vector<Vec2<float>> corner{{20, 20}, {80, 20}, {80, 80}};
    add(Shape::polyline, corner, 4);
    EXPECT_EQ(at(50, 50), pixel_of(white));
    add(Shape::loop, corner, 4);
    EXPECT_EQ(at(50, 50), pixel_of(black));
}

TEST_F(CairoPainter, PolygonIsFilledEvenOdd) {
    add(Shape::polygon,
        {{10, 10}, {90, 10}, {90, 90}, {10, 90}, {10, 10}, {40, 40}, {60, 40}, {60, 60}, {40, 60}, {40, 40}}, 0);
    EXPECT_EQ(at(20, 20), pixel_of(black));
    EXPECT_EQ(at(50, 50), pixel_of(white)) << "what is enclosed twice is a hole";
}

TEST_F(CairoPainter, LineOfNoWidthIsOnePixelWide) {
    for (float width : {0.f, 0.001f, -3.f, std::numeric_limits<float>::quiet_NaN()}) {
        picture.clear();
        add(Shape::polyline, {{10, 50.5f}, {90, 50.5f}}, width);
        EXPECT_EQ(at(50, 50), pixel_of(black)) << width;
        EXPECT_EQ(at(50, 49), pixel_of(white)) << width;
        EXPECT_EQ(at(50, 51), pixel_of(white)) << width;
    }
}

TEST_F(CairoPainter, EdgeBetweenPixelsIsHalfCovered) {
    add(Shape::polygon, {{0, 0}, {50.5f, 0}, {50.5f, 100}, {0, 100}}, 0);
    EXPECT_LE(difference(at(50, 50), {128, 128, 128}), 1);
}

TEST_F(CairoPainter, HalfTransparentInkIsHalfThePaper) {
    add(Shape::disc, {{50, 50}}, 20, {0, 0, 0, 0.5f});
    EXPECT_LE(difference(at(50, 50), {128, 128, 128}), 1);
}

TEST_F(CairoPainter, LaterItemsCoverEarlierOnes) {
    add(Shape::disc, {{50, 50}}, 40, black);
    add(Shape::disc, {{50, 50}}, 20, red);
    EXPECT_EQ(at(50, 50), pixel_of(red));
    EXPECT_EQ(at(50, 35), pixel_of(black));
}

TEST_F(CairoPainter, PolylineOfOnePointIsADisc) {
    for (Shape shape : {Shape::polyline, Shape::loop}) {
        picture.clear();
        add(shape, {{50, 50}}, 20);
        EXPECT_EQ(at(58, 50), pixel_of(black));
        EXPECT_EQ(at(61, 50), pixel_of(white));
    }
}

TEST_F(CairoPainter, ItemWithoutPointsPaintsNothing) {
    for (Shape shape : {Shape::polyline, Shape::loop, Shape::disc, Shape::polygon}) add(shape, {}, 10);
    EXPECT_EQ(at(0, 0), pixel_of(white));
}

TEST_F(CairoPainter, ItemThatIsNotFiniteIsLeftOutAndTheRestIsPainted) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (float bad : {nan, infinity, -infinity})
        for (Shape shape : {Shape::polyline, Shape::loop, Shape::disc, Shape::polygon})
            add(shape, {{bad, 50}, {20, bad}, {80, 50}}, 10);
    add(Shape::disc, {{50, 50}}, 20, red);
    EXPECT_EQ(at(50, 50), pixel_of(red));
    EXPECT_EQ(at(75, 50), pixel_of(white));
}

TEST_F(CairoPainter, LineToFarAwayStillCrossesThePicture) {
    const float far = std::numeric_limits<float>::max();
    add(Shape::polyline, {{-far, 50}, {far, 50}}, 10);
    add(Shape::polyline, {{50, 0}, {50, 1e9f}}, 10);
    EXPECT_EQ(at(20, 50), pixel_of(black));
    EXPECT_EQ(at(50, 80), pixel_of(black));
    EXPECT_EQ(at(20, 80), pixel_of(white));
}

TEST_F(CairoPainter, PictureOfAnotherShapeIsCentredOnItsBackground) {
    Picture wide;
    wide.width = 200, wide.height = 50;
    wide.background = red;
    wide.add(Shape::disc, std::array{Vec2<float>{100, 25}}, 40, black);
    EXPECT_EQ(at(wide, 50, 50), pixel_of(black));
    EXPECT_EQ(at(wide, 50, 58), pixel_of(black)) << "scaled by a half: the disc has a radius of 10";
    EXPECT_EQ(at(wide, 50, 62), pixel_of(red));
    EXPECT_EQ(at(wide, 50, 2), pixel_of(red)) << "the room above is background";
}

TEST_F(CairoPainter, TransparentBackgroundIsSeenOnWhitePaper) {
    add(Shape::disc, {{50, 50}}, 20, black);
    EXPECT_EQ(at(50, 50), pixel_of(black));
    picture.clear();
    picture.background = {0, 0, 0, 0};
    EXPECT_EQ(at(50, 50), pixel_of(white)) << "and nothing of the frame before";
}

TEST_F(CairoPainter, EveryFrameUsesTheSameMemory) {
    TumblingFigure figure;
    Raster frame(640, 480);
    ASSERT_EQ(frame.paint(figure.at(0)), canvas::Failure());
    const auto* const first = frame.bytes().data();
    for (float seconds : {0.5f, 1.f, 1.5f}) ASSERT_EQ(frame.paint(figure.at(seconds)), canvas::Failure());
    EXPECT_EQ(frame.bytes().data(), first);
    EXPECT_EQ(frame.bytes().size(), std::size_t(4 * 640 * 480));
}

TEST_F(CairoPainter, SamePictureGivesTheSamePixels) {
    TumblingFigure figure;
    Raster once(320, 240), again(320, 240);
    ASSERT_EQ(once.paint(figure.at(0.3f, 320, 240)), canvas::Failure());
    ASSERT_EQ(again.paint(figure.at(1.7f, 320, 240)), canvas::Failure());
    ASSERT_EQ(again.paint(figure.at(0.3f, 320, 240)), canvas::Failure());
    EXPECT_TRUE(std::ranges::equal(once.bytes(), again.bytes()));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
