#include "sinew/picture/draw.h"
#include "sinew/session/session.h"
#include "sinew/session/view.h"
#include "sinew/world/edit.h"

#include "tests/stepped.h"

#include <gtest/gtest.h>

/// Cuts in scenes: events and pointers.
namespace sinew::SINEW_TEST_FILE {
namespace {

Session cutting_session(const std::string& more, const std::string& figure) {
    auto document = load(R"({"sinew": 1, )" + more + R"("figures": [)" + figure + "]}", "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}

const std::string rope = R"({"prefab": "rope", "name": "rope", "segments": 10, "length": 1, "at": [0, 1]})";

std::vector<std::string> told(const Session& session) {
    std::vector<std::string> texts;
    for (const auto& happening : session.happenings()) texts.push_back(happening.what + " " + happening.where);
    return texts;
}

TEST(Cuts, AnEventCutsWhatItCrossesAndTellsWhose) {
    auto session =
        cutting_session(R"("world": {"gravity": [0, -9.81]}, "events": [{"at": 0.1, "cut": [[-1, 0.55], [1, 0.55]]},
                                            {"at": 0.2, "cut": [[5, 0], [6, 0]]}], )",
                        rope);
    const auto before = session.report().constraints;
    session.run_until(0.3);
    EXPECT_LT(session.report().constraints, before);
    EXPECT_EQ(told(session), (std::vector<std::string>{"cut rope", "parted rope", "cut "}));
    EXPECT_EQ(session.happenings()[1].islands, 2U);
    EXPECT_LT(
        position_of(std::get<1>(session.world()), *find_particle(std::get<1>(session.world()), "rope/end")).value()[1],
        -0.01);
}

// The camera looks along -x: what is seen to the right is further along -z.
TEST(Cuts, InSpaceTheyGoWhereTheyAreSeen) {
    const std::string side = R"("dimension": 3, "view": {"camera": {"eye": [5, 0.5, 0], "target": [0, 0.5, 0]}}, )";
    const std::string rope3 = R"({"prefab": "rope", "name": "rope", "segments": 10, "length": 1, "at": [0, 1, 0]})";
    auto session = cutting_session(side, rope3);
    const double near = 2.5; // half way to the eye: what is crossed lies twice as far from the middle
    EXPECT_EQ(session.cut({Point{{near, 0.5, -0.2}}, Point{{near, 0.5, -0.1}}}), 0U);
    EXPECT_EQ(session.cut({Point{{near, 0.62, -0.2}}, Point{{near, 0.64, 0.2}}}), 1U);
    const auto& world = std::get<World<3, double>>(session.world());
    EXPECT_FALSE(find_constraint(world, "rope/link_2"));
    EXPECT_TRUE(find_constraint(world, "rope/link_1"));
    EXPECT_EQ(session.cut({Point{{7, 0.5, -0.2}}, Point{{7, 0.5, 0.2}}}, 10), 0U); // behind the eye
    EXPECT_EQ(told(session), (std::vector<std::string>{"cut rope", "parted rope"}));
}

TEST(Cuts, ReachAsFarAsTheScenesPointerUnlessTheySay) {
    const std::string beside = R"("cut": [[0.05, 0.55], [1, 0.55]])";
    const auto cuts = [&](const std::string& pointer, const std::string& within) {
        auto session = cutting_session(pointer + R"("events": [{"at": 0, )" + beside + within + "}], ", rope);
        session.step();
        return told(session).size() > 1;
    };
    EXPECT_FALSE(cuts("", ""));
    EXPECT_TRUE(cuts("", R"(, "within": 0.06)"));
    EXPECT_TRUE(cuts(R"("pointer": {"cut_radius": 0.06}, )", ""));
    EXPECT_FALSE(cuts(R"("pointer": {"cut_radius": 0.06}, )", R"(, "within": 0.04)"));
}

TEST(Cuts, AFigureThatFallsApartKeepsItsNamesAndTellsOfItEachTime) {
    auto session = cutting_session(
        R"("events": [{"at": 0, "remove": ["rope/link_2"]}, {"at": 0.1, "remove": ["rope/link_7"]}],)", rope);
    session.run_until(0.2);
    std::vector<std::size_t> islands;
    for (const auto& happening : session.happenings())
        if (happening.what == "parted") islands.push_back(happening.islands);
    EXPECT_EQ(islands, (std::vector<std::size_t>{2, 3}));
    const auto& world = std::get<World<2, double>>(session.world());
    for (const auto name : {"rope/start", "rope/particle_5", "rope/end", "rope/link_0", "rope/link_5", "rope/link_9"})
        EXPECT_TRUE(find_particle(world, name) || find_constraint(world, name)) << name;
    session.restart();
    session.run_until(0.2);
    EXPECT_EQ(session.happening_count(), 4U);
}

TEST(Cuts, ATornLinkIsDrawnNoLonger) {
    auto session = cutting_session(R"("units": {"length": "px"}, "world": {"gravity": [0, -981]}, )",
                                   R"({"name": "x", "particles": {"top": {"at": [0, 100], "pinned": true},
        "low": {"at": [0, 0], "mass": 1}}, "constraints": [{"between": ["top", "low"], "compliance": 0.1,
        "breaking_strain": 0.2}]})");
    const auto lines = [&] {
        Picture picture;
        picture.width = picture.height = 400;
        draw(session, picture);
        return std::count_if(picture.items.begin(), picture.items.end(),
                             [](const auto& item) { return item.shape == Shape::polyline; });
    };
    const auto before = lines();
    EXPECT_GE(before, 1);
    session.run_until(2);
    EXPECT_EQ(told(session), (std::vector<std::string>{"torn x", "parted x"}));
    EXPECT_LT(lines(), before);
}

/// Nine particles and the links of four cells. Two links are drawn twice as far as they are long and tear at once: of
/// two cells that leaves the middle particle as all that joins them.
TEST(Cuts, TornClothHangsInFlaps) {
    auto session = cutting_session(R"("world": {"gravity": [0, 0]}, )", R"({"name": "x", "particles": {
        "nw": {"at": [0, 2], "mass": 1}, "n": {"at": [1, 2], "mass": 1}, "ne": {"at": [2, 2], "mass": 1},
        "w": {"at": [0, 1], "mass": 1}, "c": {"at": [1, 1], "mass": 1}, "e": {"at": [2, 1], "mass": 1},
        "sw": {"at": [0, 0], "mass": 1}, "s": {"at": [1, 0], "mass": 1}, "se": {"at": [2, 0], "mass": 1}},
        "constraints": [
        {"between": ["nw", "n"]}, {"between": ["w", "c"]}, {"between": ["c", "e"]}, {"between": ["s", "se"]},
        {"between": ["sw", "s"]}, {"between": ["nw", "w"]}, {"between": ["n", "c"]}, {"between": ["c", "s"]},
        {"between": ["ne", "e"]}, {"between": ["e", "se"]},
        {"between": ["n", "ne"], "rest": 0.5, "compliance": 1, "breaking_strain": 0.1},
        {"between": ["w", "sw"], "rest": 0.5, "compliance": 1, "breaking_strain": 0.1}]})");
    session.step();
    EXPECT_EQ(told(session), (std::vector<std::string>{"torn x", "torn x", "parted x"}));
    EXPECT_EQ(session.report().particles, 10U);
    EXPECT_EQ(session.happenings().back().islands, 2U);
    EXPECT_NEAR(session.report().max_speed, 0, 0.1);
}

/// How far polygons of that colour reach across a line of the picture, pixels.
float reach_across(const Session& session, Vec2<float> from, Vec2<float> to) {
    Picture picture;
    picture.width = 640;
    picture.height = 480;
    draw(session, picture);
    const auto along = direction(to - from);
    float worst = 0;
    for (const auto& item : picture.items) {
        const bool is_cloth = item.color.red > 1.5F * item.color.blue && item.color.red > 1.5F * item.color.green;
        if (item.shape != Shape::polygon || !is_cloth) continue;
        float left = 0, right = 0;
        for (const auto& point : picture.points_of(item)) {
            const auto way = point - from;
            if (dot(way, along) < 0 || dot(way, along) > distance(from, to)) continue;
            left = std::max(left, cross(along, way));
            right = std::max(right, -cross(along, way));
        }
        worst = std::max(worst, std::min(left, right));
    }
    return worst;
}

// Tiles are drawn half a pixel larger than they are, so that no seam shows between them.
TEST(Cuts, WhatIsDrawnOfClothFollowsTheBladeInThePlaneAndInSpace) {
    constexpr float seam = 0.5F, bulge = 0.5F;
    const std::string cloth =
        R"("prefab": "cloth", "columns": 9, "rows": 9, "spacing": 30, "pins": "top", "drawn": "fill",
                               "looks": {"all": {"color": "#c01010", "fill": "#c01010"}}})";
    auto flat = cutting_session(R"("units": {"length": "px", "up": "-y"}, "view": {"size": [640, 480]}, )",
                                R"({"at": [320, 100], )" + cloth);
    EXPECT_GT(reach_across(flat, {{150, 130}}, {{480, 290}}), 1);
    EXPECT_GT(flat.cut({Point{{150, 130}}, Point{{480, 290}}}), 5U);
    EXPECT_LT(reach_across(flat, {{150, 130}}, {{480, 290}}), 1.5F * seam);

    auto deep = cutting_session(
        R"("dimension": 3, "units": {"length": "px"}, "view": {"camera": {"eye": [200, 50, 500], "target": [0, 0, 0]}}, )",
        R"({"at": [0, 120, 0], "turn": 10, )" + cloth);
    const View view(deep.scene(), deep.focus(), 640, 480);
    const Point left{{-150, 40, 0}}, right{{150, -60, 0}};
    const auto from = view.see(left.as<3, double>())->pixel, to = view.see(right.as<3, double>())->pixel;
    EXPECT_GT(reach_across(deep, from, to), 1);
    EXPECT_GT(deep.cut({left, right}), 5U);
    EXPECT_LT(reach_across(deep, from, to), 1.5F * seam + bulge);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
