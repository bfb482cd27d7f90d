#include "sinew/picture/draw.h"
#include "sinew/picture/outline.h"
#include "sinew/session/session.h"

#include <algorithm>
#include <gtest/gtest.h>

/// What a session looks like, as laws of its display list.
namespace sinew::SINEW_TEST_FILE {
namespace {

std::string scene(const std::string& figures, const std::string& more = "") {
    return R"({"sinew": 1, "units": {"length": "px", "time": "frame", "up": "-y"}, "view": {"size": [640, 480]})" +
           more + R"(, "figures": [)" + figures + "]}";
}

Picture drawn(const std::string& text, int width = 640, int height = 480) {
    auto document = load(text, "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    Picture picture;
    picture.width = width;
    picture.height = height;
    if (opened) draw(Session(std::move(*opened)), picture);
    return picture;
}

std::vector<Picture::Item> of_color(const Picture& picture, std::string_view color) {
    std::vector<Picture::Item> items;
    for (const auto& item : picture.items)
        if (item.color == *parse_color(color)) items.push_back(item);
    return items;
}

const std::string ball = R"({"name": "ball", "particles": {"a": {"at": [100, 120], "size": 30}},
                             "looks": {"all": {"color": "#ff0000"}}})";

TEST(Draw, ADotIsADiscWhereItsParticleIs) {
    const auto picture = drawn(scene(ball));
    const auto discs = of_color(picture, "#ff0000");
    ASSERT_EQ(discs.size(), 1U);
    EXPECT_EQ(discs[0].shape, Shape::disc);
    EXPECT_EQ(discs[0].width, 30);
    EXPECT_EQ(picture.points[discs[0].first], (Vec2<float>{{100, 120}}));
}

TEST(Draw, CopiesByAnEventLookLikeTheOriginal) {
    auto document = load(scene(ball, R"(, "events": [{"at": 1, "add": "ball", "to": [40, 0]},
        {"at": 2, "add": "ball", "to": [80, 0]}], "looks": {"ball/a": {"width": 12}})"),
                         "test.json");
    auto opened = open_scene(document);
    ASSERT_TRUE(opened) << to_text(document.diagnostics);
    Session session(std::move(*opened));
    session.run_until(session.seconds() + 0.2);
    Picture picture;
    picture.width = 640, picture.height = 480;
    draw(session, picture);
    const auto discs = of_color(picture, "#ff0000");
    ASSERT_EQ(discs.size(), 3U);
    for (const auto& disc : discs) EXPECT_EQ(disc.width, discs[0].width);
}

// The line is a piece of a figure that has neither end.
TEST(Draw, ATornLinkBetweenOtherFiguresIsGone) {
    const auto lines = [](const std::string& strength) {
        auto document = load(R"({"sinew": 1, "figures": [
            {"name": "a", "particles": {"p": {"at": [0, 0], "pinned": true}}},
            {"name": "b", "particles": {"p": {"at": [1, 0]}}},
            {"name": "t", "constraints": [{"name": "x", "between": ["a/p", "b/p"], "rest": 0.5, "compliance": 0.01,
             "break_force": )" + strength +
                                 R"(}], "looks": {"x": {"color": "#0000ff"}}}]})",
                             "test.json");
        auto opened = open_scene(document);
        EXPECT_TRUE(opened) << to_text(document.diagnostics);
        Session session(std::move(*opened));
        session.step(), session.step();
        Picture picture;
        picture.width = picture.height = 400;
        draw(session, picture);
        return of_color(picture, "#0000ff").size();
    };
    EXPECT_EQ(lines("1000"), 1U);
    EXPECT_EQ(lines("1"), 0U);
}

TEST(Draw, APictureTwiceAsLargeHasEverythingTwiceAsLarge) {
    const auto small = drawn(scene(ball)), large = drawn(scene(ball), 1280, 960);
    ASSERT_EQ(small.items.size(), large.items.size());
    for (std::size_t i = 0; i < small.items.size(); ++i)
        EXPECT_NEAR(large.items[i].width, 2 * small.items[i].width, 1e-4);
    for (std::size_t i = 0; i < small.points.size(); ++i)
        EXPECT_NEAR(distance(large.points[i], small.points[i] * 2.0F), 0, 1e-3);
}

TEST(Draw, ShadowsLieBehindAllFigures) {
    const std::string other = R"({"name": "other", "particles": {"a": {"at": [110, 130], "size": 30}},
                                  "looks": {"all": {"color": "#00ff00"}}})";
    const auto picture = drawn(scene(ball + "," + other));
    std::size_t first_body = picture.items.size(), discs_behind = 0;
    for (std::size_t i = 0; i < picture.items.size(); ++i)
        if (picture.items[i].color == *parse_color("#ff0000")) first_body = std::min(first_body, i);
    for (std::size_t i = 0; i < first_body; ++i) discs_behind += picture.items[i].shape == Shape::disc;
    EXPECT_EQ(discs_behind, 2 * 3 + 1U); // three layers a shadow, and the outline of the first ball
}

TEST(Draw, SticksThatHangTogetherHaveOneOutlineAndCrossingOnesTwo) {
    const auto sticks = [](const std::string& second_from) {
        return scene(R"({"name": "x", "looks": {"all": {"color": "#ff0000", "width": 10}, "a": {"hidden": true},
            "b": {"hidden": true}, "c": {"hidden": true}, "d": {"hidden": true}},
            "particles": {"a": {"at": [100, 100]}, "b": {"at": [200, 100]}, "c": {"at": [150, 50]}, "d": {"at": [150, 150]}},
            "constraints": [{"name": "stick", "between": ["a", "b"]}, {"name": "stick", "between": [")" +
                     second_from + R"(", "d"]}]})");
    };
    const auto order = [](const Picture& picture) { // o: outline, b: body
        std::string text;
        for (const auto& item : picture.items) {
            if (item.color == *parse_color("#ff0000")) text += 'b';
            if (item.width > 12 && item.width < 13) text += 'o';
        }
        return text;
    };
    EXPECT_EQ(order(drawn(sticks("b"))), "oobb");
    EXPECT_EQ(order(drawn(sticks("c"))), "obob");
}

TEST(Draw, APlainPictureIsWhatWasAskedForAndNothingElse) {
    const auto text = R"({"name": "stick", "particles": {"a": {"at": [100, 120], "size": 30}, "b": {"at": [300, 120]}},
        "pieces": [{"mark": "stroke", "through": ["a", "b"], "width": 12}]})";
    const auto items = [&](const std::string& plain) {
        auto document = load(scene(text), "test.json", std::vector<Override>{{"view.plain=" + plain}});
        auto opened = open_scene(document);
        EXPECT_TRUE(opened) << to_text(document.diagnostics);
        Picture picture;
        picture.width = 640, picture.height = 480;
        draw(Session(std::move(*opened)), picture);
        return picture.items.size();
    };
    EXPECT_EQ(items("true"), 3U) << "a stroke and two balls";
    EXPECT_EQ(items("false"), 3U + 3 * 3 + 3 + 1) << "three layers of shadow and an outline each, and a highlight";
}

TEST(Draw, WhatIsHiddenIsNotThere) {
    const auto hidden =
        R"({"name": "ball", "particles": {"a": {"at": [100, 120]}}, "looks": {"all": {"hidden": true}}})";
    EXPECT_TRUE(drawn(scene(hidden)).items.empty());
}

TEST(Draw, InkStandsOutFromThePaperInEveryTheme) {
    const std::string inked =
        R"({"name": "x", "particles": {"a": {"at": [9, 9]}}, "looks": {"all": {"color": "ink"}}})";
    for (const std::string theme : {"light", "dark"}) {
        auto document = load(scene(inked), "test.json", std::vector<Override>{{"view.theme=" + theme}});
        auto opened = open_scene(document);
        ASSERT_TRUE(opened) << to_text(document.diagnostics);
        Picture picture;
        picture.width = 640, picture.height = 480;
        draw(Session(std::move(*opened)), picture);
        EXPECT_GT(std::abs(picture.items.back().color.green - picture.background.green), 0.6F) << theme;
    }
}

TEST(Draw, BeyondTheWallsIsGround) {
    const auto picture = drawn(scene(ball, R"(, "world": {"bounds": {"box": [[20, 30], [600, 440]]}})"));
    std::size_t bars = 0;
    for (const auto& item : picture.items) bars += item.shape == Shape::polygon;
    EXPECT_EQ(bars, 4U);
}

/// Four particles and what is drawn on them.
std::string pieces(const std::string& list) {
    return scene(R"({"name": "x", "looks": {"all": {"color": "#ff0000"}}, "particles": {"a": {"at": [100, 100]},
        "b": {"at": [200, 100]}, "c": {"at": [200, 200]}, "d": {"at": [100, 200]}}, "pieces": [)" +
                 list + "]}");
}

TEST(Draw, ALimbRunsFromItsFirstParticleToItsLastPulledByTheMiddle) {
    const auto picture = drawn(pieces(R"({"mark": "limb", "through": ["a", "b", "c"], "width": 12})"));
    const auto limbs = of_color(picture, "#ff0000");
    ASSERT_FALSE(limbs.empty());
    const auto points = picture.points_of(limbs[0]);
    EXPECT_EQ(limbs[0].shape, Shape::polyline);
    EXPECT_EQ(limbs[0].width, 12);
    EXPECT_EQ(points.front(), (Vec2<float>{{100, 100}}));
    EXPECT_EQ(points.back(), (Vec2<float>{{200, 200}}));
    EXPECT_NEAR(distance(points[points.size() / 2], Vec2<float>{{175, 125}}), 0,
                2); // (a + 2 b + c) / 4, to half a part
}

TEST(Draw, ATipIsAtTheEndOfItsLimb) {
    const auto picture = drawn(pieces(R"({"mark": "tip", "through": ["a", "b", "c"], "width": 17})"));
    for (const auto& item : of_color(picture, "#ff0000"))
        if (item.width == 17) {
            EXPECT_EQ(item.shape, Shape::disc);
            EXPECT_EQ(picture.points[item.first], (Vec2<float>{{200, 200}}));
            return;
        }
    FAIL() << "no disc";
}

TEST(Draw, AMarkThroughTheWrongNumberOfParticlesIsAnError) {
    for (const std::string bad :
         {R"({"mark": "limb", "through": ["a"]})", R"({"mark": "ring", "through": ["a", "b", "c"]})",
          R"({"mark": "fill", "through": ["a", "b"]})", R"({"mark": "dot", "through": []})",
          R"({"mark": "limb", "through": ["a", "b", "x"]})",
          R"({"mark": "limb", "through": ["a", "b"], "end_width": 3})"}) {
        auto document = load(pieces(bad), "test.json");
        EXPECT_FALSE(open_scene(document)) << bad;
        EXPECT_NE(to_text(document.diagnostics).find("/figures/0/pieces/0/"), std::string::npos) << bad;
    }
}

double area(std::span<const Vec2<float>> outline) {
    double sum = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        sum += double(cross(outline[i], outline[(i + 1) % outline.size()])) / 2;
    return std::abs(sum);
}

// Two discs and the band that touches both: the discs' two sectors, and two trapezes between.
TEST(Outline, ATaperedLimbCoversItsDiscsAndTheBandBetween) {
    Pixels shape;
    taper({{10, 20}}, 40, {{110, 20}}, 20, shape);
    const double r0 = 20, r1 = 10, d = 100, side = std::acos((r0 - r1) / d);
    const double pi_ = pi<double>;
    const double exact = (pi_ - side) * r0 * r0 + side * r1 * r1 + (r0 + r1) * std::sqrt(d * d - (r0 - r1) * (r0 - r1));
    EXPECT_NEAR(area(shape), exact, 0.02 * exact); // arcs are of eight chords
}

TEST(Outline, ALimbShorterThanItsWidthIsItsLargerDisc) {
    Pixels shape;
    taper({{10, 20}}, 40, {{12, 20}}, 20, shape);
    EXPECT_NEAR(area(shape), pi<double> * 400, 0.12 * pi<double> * 400);
}

TEST(Outline, ASmoothCurveRunsThroughItsPoints) {
    const Pixels points = {{{0, 0}}, {{30, 10}}, {{60, -5}}, {{90, 20}}};
    Pixels curve;
    smooth(points, curve);
    EXPECT_GT(curve.size(), 3 * points.size());
    for (const auto& point : points)
        EXPECT_TRUE(std::any_of(curve.begin(), curve.end(), [&](const auto& p) { return distance(p, point) < 1e-4F; }));
}

TEST(Outline, ARingReachesBeyondItsEndsByHalfItsWire) {
    Pixels loop;
    ring({{0, 0}}, {{26, 0}}, 18, 6, loop);
    float low = 0, high = 0, across = 0;
    for (const auto& point : loop) {
        low = std::min(low, point[0]);
        high = std::max(high, point[0]);
        across = std::max(across, std::abs(point[1]));
    }
    EXPECT_NEAR(low, -3, 0.1);
    EXPECT_NEAR(high, 29, 0.1);
    EXPECT_NEAR(across, 6, 1e-3);
}

TEST(View, OrthographicShowsTheFarAsLargeAsTheNear) {
    Scene scene;
    scene.dimension = 3;
    auto& camera = scene.view.camera;
    camera.eye = {{0, 0, 4}};
    const Vec3<double> near{{1, 0.5, 2}}, far{{1, 0.5, -2}};
    const View usual(scene, {}, 640, 480);
    EXPECT_GT(usual.see(near)->pixel[0], usual.see(far)->pixel[0] + 10);
    camera.projection = "orthographic";
    const View flat(scene, {}, 640, 480);
    EXPECT_EQ(flat.see(near)->pixel, flat.see(far)->pixel);
    EXPECT_EQ(flat.see(near)->scale, flat.see(far)->scale);
    EXPECT_LT(distance(flat.see({{1, 0, 0}})->pixel, usual.see({{1, 0, 0}})->pixel), 1e-3F); // what it looks at
    const auto seen = *flat.see(far);
    const auto back = flat.position_of(cast<double>(seen.pixel), double(seen.depth)).as<3, double>();
    EXPECT_LT(distance(back, far), 1e-5);
}

// --- faces --------------------------------------------------------------------------------------------------------

const auto inked = [](const Picture& picture) { return of_color(picture, "#00ff01"); };

std::string head_of_two(const std::string& looks) {
    return scene(R"({"name": "it", "particles": {"neck": {"at": [100, 100]}, "head": {"at": [140, 100], "size": 60}},
        "pieces": [{"mark": "face", "through": ["neck", "head"], "width": 60}], "looks": {"face": {"color": "#00ff01")" +
                 looks + R"(}}})");
}

// To the right is up, for the way from the neck to the head is: the eyes are beyond its middle, one above the other.
TEST(Draw, AFaceTurnsWithItsHead) {
    const auto picture = drawn(head_of_two(""));
    const auto marks = inked(picture);
    ASSERT_EQ(marks.size(), 3U); // two eyes and a mouth
    const auto a = picture.points[marks[0].first], b = picture.points[marks[1].first];
    EXPECT_EQ(marks[0].shape, Shape::disc);
    EXPECT_FLOAT_EQ(a[0], b[0]);
    EXPECT_GT(a[0], 140);
    EXPECT_FLOAT_EQ(a[1] + b[1], 200);
    EXPECT_GT(std::abs(a[1] - b[1]), 15);
    for (const auto& point : picture.points_of(marks[2])) EXPECT_LT(point[0], 140);
}

TEST(Draw, ALookSaysWhatAFaceIsLikeAndGivesOneToDots) {
    EXPECT_EQ(inked(drawn(head_of_two(R"(, "face": "none")"))).size(), 0U);
    EXPECT_EQ(inked(drawn(head_of_two(R"(, "face": "asleep")"))).size(), 3U);
    EXPECT_EQ(inked(drawn(head_of_two(R"(, "face": "dizzy")"))).size(), 5U); // two crosses
    const auto plain = drawn(scene(ball)).items.size();
    auto faced = ball;
    faced.replace(faced.find("#ff0000\""), 8, R"(#ff0000", "face": "awake")");
    EXPECT_EQ(drawn(scene(faced)).items.size(), plain + 3);
}

// The front of the body faces z: from behind one sees the head and no face, from the side half of one.
TEST(Draw, InSpaceAFaceIsSeenFromItsFront) {
    const auto from = [](const std::string& eye) {
        return inked(drawn(R"({"sinew": 1, "dimension": 3, "view": {"size": [640, 480], "camera": {"eye": )" + eye +
                           R"(}}, "figures": [{"prefab": "ragdoll", "looks": {"face": {"color": "#00ff01"}}}]})"))
            .size();
    };
    EXPECT_EQ(from("[0, 0, 5]"), 3U);
    EXPECT_EQ(from("[0, 0, -5]"), 0U);
    EXPECT_EQ(from("[5, 0, 0]"), 1U);
}

// The lines of all parts lie below their fills: what is left of them is the outline.
TEST(Draw, AColliderOfAPathHasNoSeams) {
    const auto picture =
        drawn(scene("", R"(, "colliders": [{"shape": "polygon", "path": "M100 100h200v100h-50v-50h-100v50h-50z"}])"));
    const auto& theme = theme_called("light");
    std::string order; // w: a line, g: a fill
    for (const auto& item : picture.items) {
        if (item.color == theme.wall) order += 'w';
        if (item.color == theme.ground && item.shape == Shape::polygon) order += 'g';
    }
    EXPECT_EQ(order.find_last_of('w') + 1, order.find('g')) << order;
    EXPECT_GE(order.size(), 4U) << "several parts";
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
