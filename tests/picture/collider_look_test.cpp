#include "sinew/picture/draw.h"
#include "sinew/session/session.h"

#include <algorithm>
#include <gtest/gtest.h>

/// Looks of colliders.
namespace sinew::SINEW_TEST_FILE {
namespace {

std::string scene(const std::string& dimension, const std::string& look) {
    return R"({"sinew": 1, "dimension": )" + dimension + R"(, "looks": {)" + look + R"(},
        "colliders": [{"name": "ball", "shape": "sphere", "radius": 1}, {"name": "box", "shape": "box"}]})";
}

Picture drawn(const std::string& text) {
    auto document = load(text, "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    Picture picture;
    picture.width = 64, picture.height = 48;
    if (opened) draw(Session(std::move(*opened)), picture);
    return picture;
}

std::ptrdiff_t count(const Picture& picture, Shape shape, const Color& color) {
    return std::ranges::count_if(picture.items,
                                 [&](const auto& item) { return item.shape == shape && item.color == color; });
}

TEST(ColliderLook, ColoursTheAreaAndTheLineOfItsCollider) {
    const auto picture = drawn(scene("2", R"("ball": {"fill": "#ff0000", "color": "#00ff00"})"));
    EXPECT_EQ(count(picture, Shape::polygon, {1, 0, 0, 1}), 1);
    EXPECT_EQ(count(picture, Shape::loop, {0, 1, 0, 1}), 1);
    const auto plain = drawn(scene("2", ""));
    EXPECT_EQ(picture.items.size(), plain.items.size());
    EXPECT_EQ(picture.items.back().color, plain.items.back().color); // the box
    EXPECT_EQ(drawn(scene("2", R"("ball": {"hidden": true})")).items.size(), plain.items.size() - 2);
}

TEST(ColliderLook, ShadesASolid) {
    const auto red = drawn(scene("3", R"("ball": {"fill": "#ff0000"}, "box": {"hidden": true})"));
    EXPECT_TRUE(std::ranges::any_of(red.items, [](const auto& item) {
        return item.shape == Shape::polygon && item.color.red > 2 * item.color.green;
    }));
}

TEST(ColliderLook, MustNameOne) {
    auto document = load(scene("2", R"("bal": {"fill": "#ff0000"})"), "test.json");
    EXPECT_FALSE(open_scene(document));
    const auto errors = to_text(document.diagnostics);
    EXPECT_NE(errors.find("did you mean \"ball\""), errors.npos) << errors;
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
