#include "sinew/picture/contact_points.h"
#include "sinew/picture/draw.h"
#include "sinew/session/session.h"

#include <algorithm>
#include <gtest/gtest.h>

/// What overlays add to a picture.
namespace sinew::SINEW_TEST_FILE {
namespace {

struct Seen {
    Picture plain, laid_over;
    std::span<const Picture::Item> added() const { return std::span(laid_over.items).subspan(plain.items.size()); }
    std::vector<std::string> texts() const { return laid_over.texts; }
};

Seen seen(const std::string& name, const std::string& figures, const std::string& more = "", double seconds = 0,
          const std::string& walls = "") {
    auto document = load(R"({"sinew": 1, "units": {"length": "px"}, "world": {"gravity": [0, -1000], "damping": 5)" +
                             walls + "}, " + more + R"("figures": [)" + figures + "]}",
                         "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    Seen result;
    if (!opened) return result;
    Session session(std::move(*opened));
    session.run_until(seconds);
    OverlaySet set;
    for (std::size_t i = 0; i < overlays.size(); ++i) set[i] = overlays[i].name == name;
    for (auto* picture : {&result.plain, &result.laid_over}) picture->width = 640, picture->height = 480;
    draw(session, result.plain);
    draw(session, result.laid_over, set);
    return result;
}

const std::string weight = R"({"name": "x", "particles": {"top": {"at": [0, 100], "pinned": true},
    "low": {"at": [0, 0], "mass": 2}}, "constraints": [{"name": "spring", "between": ["top", "low"], "compliance": )";

std::size_t count(const Seen& picture, Shape shape) {
    const auto added = picture.added();
    return std::size_t(
        std::count_if(added.begin(), added.end(), [&](const auto& item) { return item.shape == shape; }));
}

bool has_text(const Seen& picture, const std::string& text) {
    const auto texts = picture.texts();
    return std::find(texts.begin(), texts.end(), text) != texts.end();
}

bool has_text_from(const Seen& picture, const std::string& start) {
    const auto texts = picture.texts();
    return std::any_of(texts.begin(), texts.end(), [&](const auto& text) { return text.starts_with(start); });
}

TEST(Overlay, NoneAddsNothing) {
    const auto picture = seen("", weight + "0}]}");
    EXPECT_EQ(picture.plain.items.size(), picture.laid_over.items.size());
    EXPECT_TRUE(picture.texts().empty());
}

// 2 kg at 10 m/s^2 pull with 20 N; a line in the deepest red would be 20, the scale goes to the next round number.
TEST(Overlay, TensionIsInNewtonsWhateverTheUnits) {
    const auto picture = seen("tension", weight + R"(0}]})", R"("solver": {"substeps": 8}, )", 1);
    EXPECT_EQ(count(picture, Shape::polyline), 2U); // a line and its casing
    EXPECT_TRUE(has_text(picture, "20 N") || has_text(picture, "50 N"));
    const auto& item = *std::find_if(picture.added().begin() + 1, picture.added().end(),
                                     [](const auto& i) { return i.shape == Shape::polyline; });
    EXPECT_GT(item.color.red, item.color.blue);
}

TEST(Overlay, ClassicModeKnowsNoForces) {
    EXPECT_TRUE(has_text(seen("tension", weight + "0}]}", R"("solver": {"mode": "classic"}, )"),
                         "tension: classic mode knows no forces"));
}

// Under 2 kg at 1000 px/s^2 a spring of 0.002 gives 4 px of 100: on a scale to 5 %, four fifths of the way to red.
TEST(Overlay, StrainOfASpringIsForceTimesComplianceOverItsLength) {
    const auto at_first = seen("strain", weight + "0.002}]}"), at_rest = seen("strain", weight + "0.002}]}", "", 5);
    EXPECT_TRUE(has_text(at_first, "0.1 %"));
    EXPECT_TRUE(has_text(at_rest, "5 %"));
    const auto pale = at_first.added()[1].color, red = at_rest.added()[1].color;
    const Color deepest{0.85F, 0.15F, 0.12F, 1};
    EXPECT_NEAR(red.blue, mix(pale, deepest, 0.8F).blue, 0.01);
}

TEST(Overlay, PinsAreMarkedWhereTheyHold) {
    const auto picture = seen("pins", weight + "0}]}");
    EXPECT_EQ(count(picture, Shape::disc), 3U);
    const auto first = picture.added().front();
    EXPECT_EQ(first.shape, Shape::disc);
}

TEST(Overlay, NamesAreThoseOfFiguresAndTheirParticlesAndDoNotLieOnEachOther) {
    const auto apart = seen("names", weight + "0}]}");
    for (const std::string name : {"x", "top", "low"}) EXPECT_TRUE(has_text(apart, name)) << name;
    const auto together =
        seen("names", R"({"name": "x", "particles": {"one": {"at": [0, 0]}, "two": {"at": [0, 0.1]}}})");
    EXPECT_EQ(has_text(together, "one") + has_text(together, "two"), 1);
}

TEST(Overlay, WhatOnlyKeepsApartIsALineWhileItDoes) {
    const auto lines = [](const std::string& at) {
        return count(seen("strain", R"({"name": "x", "particles": {"a": {"at": [0, 0], "pinned": true}, "b": {"at": )" +
                                        at + R"(, "mass": 1}}, "constraints": [{"between": ["a", "b"], "low": 50}]})"),
                     Shape::polyline);
    };
    EXPECT_EQ(lines("[80, 0]"), 0U);
    EXPECT_EQ(lines("[20, 0]"), 2U);
}

const std::string floor_at_zero = R"(, "bounds": {"planes": [{"normal": [0, 1]}]})";

/// The length of the longest arrow's shaft and tip, pixels.
double longest_arrow(const Seen& picture) {
    double longest = 0;
    const auto added = picture.added();
    for (std::size_t i = 0; i + 1 < added.size(); ++i) {
        if (added[i].shape != Shape::polyline || added[i + 1].shape != Shape::polygon) continue;
        const auto shaft = picture.laid_over.points_of(added[i]), tip = picture.laid_over.points_of(added[i + 1]);
        if (absolute(shaft[0][0] - 14) > 1)
            longest = std::max(longest, double(distance(shaft[0], tip[0]))); // no legend
    }
    return longest;
}

// 1.8 kg at 10 m/s^2 weigh 18 N, and the pin bears them: both arrows are nine tenths of the legend's 70 pixels.
TEST(Overlay, APinPullsWithTheWeightThatHangsOnIt) {
    const auto picture = seen("forces", R"({"name": "x", "particles": {"top": {"at": [0, 100], "mass": 1e-6},
        "low": {"at": [0, 0], "mass": 1.8}}, "constraints": [{"between": ["top", "low"]}]})",
                              R"("pins": [{"particle": "x/top"}], )", 1);
    EXPECT_TRUE(has_text(picture, "forces: 20 N"));
    EXPECT_EQ(count(picture, Shape::polygon), 3U) << "weight, pin, legend";
    EXPECT_NEAR(longest_arrow(picture), 63, 0.5);
}

// A square of 3.6 kg that rests on the floor is carried with 36 N by its two lower corners: 18 N each.
TEST(Overlay, AFloorCarriesTheWeightOfWhatRestsOnIt) {
    const auto picture = seen("contacts", R"({"prefab": "box", "name": "box", "at": [0, 20], "width": 40, "height": 40,
        "mass": 3.6})",
                              "", 3, floor_at_zero);
    EXPECT_EQ(count(picture, Shape::polygon), 3U) << "two corners, legend";
    EXPECT_EQ(count(picture, Shape::disc), 4U);
    EXPECT_TRUE(has_text(picture, "contacts: 20 N"));
    EXPECT_TRUE(has_text(picture, "2 touch, with up to 18 N"));
    EXPECT_NEAR(longest_arrow(picture), 63, 0.5);
}

// A rule lets the world list its planes beside its colliders: the floor carries what it carried without.
TEST(Overlay, AFloorThatARuleNamesIsTouchedOnce) {
    const auto picture =
        seen("contacts", R"({"prefab": "box", "name": "box", "at": [0, 20], "width": 40, "height": 40,
        "mass": 3.6})",
             R"("events": [{"on": {"of": "box", "with": "bounds"}, "note": "down"}], )", 3, floor_at_zero);
    EXPECT_TRUE(has_text(picture, "2 touch, with up to 18 N"));
}

std::string box(const std::string& name, double width, double height, double middle, double mass,
                const std::string& more) {
    return R"({"prefab": "box", "name": ")" + name + R"(", "dot": 2, "at": [0, )" + std::to_string(middle) +
           R"(], "width": )" + std::to_string(width) + R"(, "height": )" + std::to_string(height) + R"(, "mass": )" +
           std::to_string(mass) + more + "}";
}
const std::string touching = R"(, "contact": {"figures": true})";
const std::string table = R"("colliders": [{"name": "table", "shape": "half_space"}], )";

TEST(Overlay, AColliderCarriesWhatRestsOnItWhoeverHoldsIt) {
    for (const auto& more : {touching, std::string()}) {
        const auto picture = seen("contacts", box("box", 40, 40, 20, 3.6, more),
                                  table + (more.empty() ? R"("solver": {"direct": "off"}, )" : ""), 3);
        EXPECT_EQ(count(picture, Shape::polygon), 3U) << "two corners, legend";
        EXPECT_TRUE(has_text(picture, "2 touch, with up to 18 N"));
        EXPECT_NEAR(longest_arrow(picture), 63, 0.7);
    }
}

// The upper box of 2.4 kg stands with two corners on the lid of the lower one, which weighs 1.2 kg.
TEST(Overlay, AFigureCarriesAnotherOne) {
    const auto boxes = box("lower", 80, 20, 10, 1.2, touching) + ", " + box("upper", 20, 40, 40, 2.4, touching);
    for (const bool on_table : {false, true}) {
        const auto picture =
            seen("contacts", boxes, on_table ? table : "", 3, on_table ? std::string() : floor_at_zero);
        EXPECT_EQ(count(picture, Shape::polygon), 5U) << "four corners, legend";
        EXPECT_EQ(count(picture, Shape::disc), 8U);
        EXPECT_TRUE(has_text_from(picture, "4 touch, with up to 18"))
            << "18.1 N on one corner, as the boxes have slid apart by 0.1 px";
        EXPECT_NEAR(longest_arrow(picture), 63, 0.7);
    }
}

/// Sum of the forces of all contacts upwards, after some seconds, newtons.
double carried(const std::string& text, double seconds) {
    auto document = load(text, "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    Session session(std::move(*opened));
    session.run_until(seconds);
    double sum = 0;
    std::visit(
        [&](const auto& world) {
            for (const auto& [position, force] : ContactPoints(world, step_length(session.scene()), 1e-3).list())
                sum += force[1];
        },
        session.world());
    return sum;
}

// Cloth is swept: its contacts do not outlast a substep, and are shown all the same. The ball trembles on it, so the
// sum is not its weight at each instant: some of the looks find a force.
TEST(ContactPoints, OfClothCarryABall) {
    const std::string ball =
        R"({"sinew": 1, "dimension": 3, "world": {"gravity": [0, -10, 0], "damping": 3}, "figures": [
        {"prefab": "cloth", "name": "sheet", "columns": 13, "rows": 13, "spacing": 0.05, "plane": "horizontal",
         "pins": "all_corners", "mass": 1, "drawn": "fill", "contact": {"figures": true}},
        {"name": "ball", "contact": {"figures": true}, "particles": {"p": {"at": [0, 0.15, 0.3], "mass": 1.5, "radius": 0.1}}}]})";
    double strongest = 0;
    for (int i = 0; i < 20; ++i) strongest = std::max(strongest, carried(ball, 4 + i / 60.0));
    EXPECT_GT(strongest, 5);
}

TEST(ContactPoints, OfASensorAreNone) {
    EXPECT_EQ(carried(R"({"sinew": 1, "world": {"gravity": [0, -10]}, "colliders": [
        {"name": "gate", "shape": "sphere", "radius": 0.5, "sensor": true}],
        "figures": [{"name": "ball", "particles": {"p": {"at": [0, 0.1], "pinned": true, "radius": 0.1}}}]})",
                      0.5),
              0);
}

TEST(Overlay, ClassicWallsAreTouchedWithoutForce) {
    const auto picture = seen("contacts", R"({"name": "x", "particles": {"a": {"at": [0, 1]}}})",
                              R"("solver": {"mode": "classic"}, )", 2, floor_at_zero);
    EXPECT_EQ(count(picture, Shape::disc), 2U);
    EXPECT_EQ(count(picture, Shape::polygon), 0U);
    EXPECT_TRUE(has_text(picture, "contacts: classic mode knows no forces"));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
