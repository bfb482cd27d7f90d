#include "sinew/picture/draw.h"
#include "sinew/session/session.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

/// Images in place of shapes, as laws of the display list.
namespace sinew::SINEW_TEST_FILE {
namespace {

/// Any name is an image of 20 x 10 pixels, but "missing.png".
ReadImage some_image(const std::string& name, const Limits& limits) {
    if (name == "missing.png") return {nullptr, "there is no such file", "look again"};
    if (limits.pixels < 200) return {nullptr, "too many pixels", {}};
    return {std::make_shared<const Image>(Image{20, 10, std::vector<std::uint32_t>(200, 0xffff0000)}), {}, {}};
}

/// Four particles: a at (100, 100), b 40 to its right, c and d below them.
std::string pictured(const std::string& constraints, const std::string& looks, const std::string& more = "") {
    return R"({"sinew": 1, "units": {"length": "px", "time": "frame", "up": "-y"}, "view": {"size": [640, 480]},)" +
           more + R"("looks": {"x": {"color": "#123456"}},
        "figures": [{"name": "x", "looks": {)" +
           looks + R"(}, "particles": {"a": {"at": [100, 100], "size": 20}, "b": {"at": [140, 100]},
            "c": {"at": [140, 160]}, "d": {"at": [100, 160]}}, "constraints": [)" +
           constraints + "]}]}";
}

Document read(const std::string& text, std::optional<Opened>& opened, std::vector<Override> overrides = {}) {
    auto document = load(text, "test.json", overrides);
    opened = open_scene(document, some_image);
    return document;
}

std::string complaints_of(const std::string& text, std::vector<Override> overrides = {}) {
    std::optional<Opened> opened;
    return to_text(read(text, opened, std::move(overrides)).diagnostics);
}

struct Drawn {
    Picture picture;
    std::vector<Picture::Item> images; ///< but shadows, which are covered by their colour
};

Drawn images_of(const std::string& text, std::optional<Point> pointer = {}) {
    std::optional<Opened> opened;
    const auto document = read(text, opened);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    Drawn result;
    result.picture.width = 640;
    result.picture.height = 480;
    if (!opened) return result;
    Session session(std::move(*opened));
    session.point_at(pointer);
    draw(session, result.picture);
    for (const auto& item : result.picture.items)
        if (item.shape == Shape::image && item.color.alpha < 1) result.images.push_back(item);
    return result;
}

void expect_points(const Drawn& seen, const Picture::Item& item, const std::vector<Vec2<float>>& expected) {
    const auto points = seen.picture.points_of(item);
    ASSERT_EQ(points.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_NEAR(distance(points[i], expected[i]), 0, 1e-3) << i << ": " << points[i][0] << ' ' << points[i][1];
}

TEST(ImageLook, AtAParticleIsAsWideAsItsDot) {
    const auto seen = images_of(pictured("", R"("a": {"image": {"file": "i.png"}})"));
    ASSERT_EQ(seen.images.size(), 1U);
    expect_points(seen, seen.images[0], {{{90, 95}}, {{110, 95}}, {{90, 105}}, {{110, 105}}});
}

TEST(ImageLook, BetweenTwoParticlesLiesAlongThem) {
    const std::string down = R"({"name": "stick", "between": ["b", "c"]})";
    const auto seen = images_of(pictured(down, R"("stick": {"image": {"file": "i.png"}})"));
    ASSERT_EQ(seen.images.size(), 1U); // 60 long, half as wide: its right is down, its top to the right
    expect_points(seen, seen.images[0], {{{155, 100}}, {{155, 160}}, {{125, 100}}, {{125, 160}}});
}

TEST(ImageLook, HasASizeATurnAndAShift) {
    const std::string image = R"("a": {"image": {"file": "i.png", "size": [8, -4], "turn": 90, "shift": [3, 1]}})";
    const auto seen = images_of(pictured("", image));
    ASSERT_EQ(seen.images.size(), 1U); // counter-clockwise: what was right is up; mirrored: what was up is right
    expect_points(seen, seen.images[0], {{{105, 105}}, {{105, 97}}, {{101, 105}}, {{101, 97}}});
}

TEST(ImageLook, OnFourCornersRunsFromCornerToCorner) {
    const std::string area = R"({"kind": "area", "name": "inside", "between": ["a", "b", "c", "d"]})";
    const auto seen = images_of(pictured(area, R"("inside": {"image": {"file": "i.png"}})"));
    ASSERT_EQ(seen.images.size(), 1U);
    expect_points(seen, seen.images[0], {{{100, 100}}, {{140, 100}}, {{100, 160}}, {{140, 160}}});
}

TEST(ImageLook, ARopeIsCoveredAWholeNumberOfTimesWithoutGaps) {
    const auto seen = images_of(R"({"sinew": 1, "units": {"length": "px"}, "figures": [{"prefab": "rope", "length": 100,
        "segments": 5, "looks": {"rope": {"image": {"file": "i.png", "size": [24, 12]}}}}]})");
    ASSERT_EQ(seen.images.size(), 4U); // 100 / 24
    for (std::size_t i = 0; i + 1 < 4; ++i) {
        const auto one = seen.picture.points_of(seen.images[i]), next = seen.picture.points_of(seen.images[i + 1]);
        EXPECT_EQ(one[seen.images[i].across - 1], next[0]);
        EXPECT_EQ(one.back(), next[seen.images[i + 1].across]);
    }
}

TEST(ImageLook, IsReadOnceHoweverOftenItIsNamed) {
    std::optional<Opened> opened;
    read(pictured("", R"("a": {"image": {"file": "i.png"}}, "b": {"image": {"file": "i.png"}},
                      "c": {"image": {"file": "other.png"}})"),
         opened);
    ASSERT_TRUE(opened);
    EXPECT_EQ(opened->images.size(), 2U);
}

TEST(ImageLook, CastsItsOwnShadow) {
    const auto seen = images_of(pictured("", R"("a": {"image": {"file": "i.png"}})"));
    const auto shadows = std::count_if(seen.picture.items.begin(), seen.picture.items.end(), [](const auto& item) {
        return item.shape == Shape::image && item.color.alpha == 1;
    });
    EXPECT_EQ(shadows, 3);
}

TEST(ImageLook, WithoutAReaderOfImagesShapesAreDrawn) {
    auto document = load(pictured("", R"("a": {"image": {"file": "missing.png"}})"), "test.json");
    auto opened = open_scene(document);
    ASSERT_TRUE(opened) << to_text(document.diagnostics);
    Picture picture;
    picture.width = 640, picture.height = 480;
    draw(Session(std::move(*opened)), picture);
    EXPECT_TRUE(std::none_of(picture.items.begin(), picture.items.end(),
                             [](const auto& item) { return item.shape == Shape::image; }));
    EXPECT_FALSE(picture.items.empty());
}

TEST(ImageLook, WhatIsWrongWithAFileIsSaidWhereItIsNamed) {
    EXPECT_EQ(complaints_of(R"({"sinew": 1, "figures": [{"prefab": "rope"}],
 "looks": {"rope": {"image": {"file": "missing.png"}}}})"),
              "test.json:2:39: error: there is no such file at /looks/rope/image/file\n"
              "    2 |  \"looks\": {\"rope\": {\"image\": {\"file\": \"missing.png\"}}}}\n"
              "      |                                       ^~~~~~~~~~~~~\n"
              "      = help: look again\n");
}

TEST(ImageLook, StaysInTheFolderOfItsScene) {
    for (const std::string file : {"", "/etc/passwd", "../secret.png", "a/../../b.png", "..", "c:x.png", "a\\\\b.png"})
        EXPECT_NE(complaints_of(pictured("", R"("a": {"image": {"file": ")" + file + "\"}}"))
                      .find("in the folder of the scene"),
                  std::string::npos)
            << file;
    EXPECT_EQ(complaints_of(pictured("", R"("a": {"image": {"file": "deep/er/..i.png"}})")), "");
}

TEST(ImageLook, AllTogetherStayWithinTheLimit) {
    const auto two = pictured("", R"("a": {"image": {"file": "1.png"}}, "b": {"image": {"file": "2.png"}})");
    EXPECT_EQ(complaints_of(two, {{"limits.pixels=400"}}), "");
    EXPECT_NE(complaints_of(two, {{"limits.pixels=399"}}).find("too many pixels at /figures/0/looks/b/image/file"),
              std::string::npos);
}

TEST(ImageLook, OnWhatTakesNoneIsAnError) {
    const std::string area = R"({"kind": "area", "name": "inside", "between": ["a", "b", "c"]})";
    EXPECT_NE(complaints_of(pictured(area, R"("inside": {"image": {"file": "i.png"}})"))
                  .find("nothing of \"inside\" takes an image"),
              std::string::npos);
}

TEST(Hover, IsLaidOverWhatThePointerIsAt) {
    const auto text = pictured("", R"("a": {"image": {"file": "i.png"}, "hover": "#0000ff80"},
                                   "d": {"color": "#ff0000", "hover": "#0000ff"})");
    EXPECT_EQ(images_of(text).images[0].color.alpha, 0);
    EXPECT_EQ(images_of(text, Point{{{300, 300, 0}}}).images[0].color.alpha, 0);
    EXPECT_EQ(images_of(text, Point{{{108, 100, 0}}}).images[0].color, *parse_color("#0000ff80"));
    const auto at_d = images_of(text, Point{{{101, 160, 0}}});
    const auto is_blue = [](const auto& item) { return item.color == *parse_color("#0000ff"); };
    EXPECT_EQ(std::count_if(at_d.picture.items.begin(), at_d.picture.items.end(), is_blue), 1);
    EXPECT_EQ(at_d.images[0].color.alpha, 0);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
