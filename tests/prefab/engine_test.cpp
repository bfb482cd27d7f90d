#include "sinew/scene/reader.h"
#include "sinew/session/session.h"

#include "tests/prefab/make.h"
#include "tests/stepped.h"

#include <cmath>

namespace sinew::SINEW_TEST_FILE {
namespace {

/// Slider and crank: s = r cos(phi) + sqrt(l^2 - r^2 sin^2(phi)), in any direction, whichever way y points.
TEST(Crank, MovesItsPistonAsTheLawOfTheSliderCrankSays) {
    constexpr double r = 0.5, l = 1.4, rate = 3;
    for (const double angle : {0.0, 0.7, pi<double>}) {
        auto made = make(Crank{.radius = r, .rod = l, .angle = angle});
        const auto driven = pin(made.world, *find_particle(made.world, "it/pin")).value();
        for (int frame = 1; frame <= 150; ++frame) {
            const double turn = rate * frame / fps, phi = turn - angle;
            move_pin(made.world, driven, {{r * std::cos(turn), r * std::sin(turn)}});
            step(made.world, 1 / fps);
            const double s = r * std::cos(phi) + std::sqrt(l * l - square(r * std::sin(phi)));
            const Vec2<double> along{{std::cos(angle), std::sin(angle)}};
            EXPECT_NEAR(distance(made.position("end"), along * s), 0, 2e-3) << "angle " << angle << " frame " << frame;
        }
    }
}

TEST(Crank, RefusesARodThatCannotComeRound) {
    EXPECT_TRUE(problem_of(Crank{.radius = 1, .rod = 1}, 2));
    EXPECT_FALSE(problem_of(Crank{.radius = 1, .rod = 1, .cylinder = false}, 2));
}

/// A ship on its spring is an oscillator: T = 2 pi sqrt(m compliance).
TEST(Formation, ItsShipsSwingAboutTheirAnchors) {
    constexpr double each = 0.5, compliance = 0.05;
    auto made = make(Formation{.columns = 2, .rows = 1, .mass = 4 * each, .elasticity = {.compliance = compliance}});
    const double home = made.position("ship_1_0")[0];
    set_position(made.world, *find_particle(made.world, "it/ship_1_0"), {{home + 0.2, 0}});
    const double period = 2 * pi<double> * std::sqrt(each * compliance);
    double before = 0.2;
    std::vector<double> crossings;
    for (int frame = 1; frame <= 180; ++frame) {
        step(made.world, 1 / fps);
        const double now = made.position("ship_1_0")[0] - home;
        if ((now < 0) != (before < 0)) crossings.push_back((frame - now / (now - before)) / fps);
        before = now;
    }
    ASSERT_GE(crossings.size(), 4U);
    EXPECT_NEAR((crossings.back() - crossings.front()) / double(crossings.size() - 1), period / 2, 0.02 * period);
    EXPECT_EQ(made.position("ship_0_0"), make(Formation{.columns = 2, .rows = 1}).position("ship_0_0"));
}

// The table of the tearable cloth: masses by part, of 83 in all; links in heads, of which he is 7.5 tall.
TEST(Puppet, HasTheMassesAndTheLinksOfTheOriginalInBothModes) {
    for (const auto mode : {Mode::classic, Mode::physical}) {
        const auto made = make(Puppet{.height = 40, .mass = 83}, mode);
        const double head = 40 / 7.5;
        for (const auto& [part, mass] : {std::pair{"head", 4.0},
                                         {"shoulder", 26.0},
                                         {"left_elbow", 2.0},
                                         {"left_hand", 2.0},
                                         {"pelvis", 15.0},
                                         {"right_knee", 10.0},
                                         {"right_foot", 5.0}})
            EXPECT_NEAR(made.mass(part), mass, 1e-9) << part;
        for (const auto& [link, length] : {std::pair{"neck", 1.25},
                                           {"left_upper_arm", 1.5},
                                           {"right_forearm", 2.0},
                                           {"spine", 3.5},
                                           {"left_thigh", 2.0},
                                           {"right_shin", 2.0}})
            EXPECT_NEAR(made.constraint(link).measure, length * head, 1e-9) << link;
        EXPECT_EQ(find_constraint(made.world, "it/left_support").has_value(), mode == Mode::classic);
    }
}

TEST(Cloth, OfUnevenThreadsTearsSomeOfThemEarlierThanOthers) {
    const auto made = make(
        Cloth{.columns = 61, .rows = 41, .diagonals = "none", .strength = {.breaking_strain = 4}, .uneven = 5.0 / 6});
    const auto strains = std::get<0>(made.world.constraints).breaking_strain.rows();
    const auto [weakest, strongest] = std::minmax_element(strains.begin(), strains.end());
    EXPECT_GE(*weakest, 4); // 30 px of 6
    EXPECT_LT(*weakest, 4.01);
    EXPECT_LE(*strongest, 4 * 11.0 / 6); // 50 px
    EXPECT_GT(*strongest, 7.3);
    EXPECT_EQ(std::get<0>(make(Cloth{.strength = {.breaking_strain = 4}}).world.constraints).breaking_strain[7], 4);
}

std::optional<Opened> scene_of(const std::string& text, std::string* errors = nullptr) {
    auto document = load(text, "test.json");
    auto opened = open_scene(document);
    if (errors) *errors = to_text(document.diagnostics);
    return opened;
}

TEST(Star, StandsForEveryParticleThatBeginsSo) {
    auto opened =
        scene_of(R"({"sinew": 1, "figures": [{"prefab": "formation", "name": "fleet", "columns": 3, "rows": 2},
        {"name": "f", "particles": {"a": {"at": [0, 5]}, "b": {"at": [1, 5]}, "c": {"at": [2, 5]}},
                      "constraints": [{"between": ["a", "*"]}, {"name": "far", "between": ["fleet/ship_0_0", "b"]}]}],
        "constraints": [{"between": ["f/a", "fleet/ship_*"], "low": 1}],
        "pins": [{"particle": "fleet/anchor_*", "driver": "bob", "by": [1, 0], "period": [4, 4]}]})");
    ASSERT_TRUE(opened);
    const auto& world = std::get<World<2, double>>(opened->world);
    EXPECT_EQ(find_particles(world, "fleet/ship_*").size(), 6U);
    EXPECT_EQ(find_particles(world, "fleet/ship_1*").size(), 2U);
    EXPECT_EQ(find_particles(world, "fleet/*").size(), 12U);
    EXPECT_TRUE(find_particles(world, "fleet/captain_*").empty());
    EXPECT_EQ(std::get<0>(world.constraints).size(), 6U + 2 + 1 + 6) << "springs, a to b and c, far, a to the ships";
    EXPECT_TRUE(find_constraint(world, "f/far"));

    const auto start = *position_of(world, *find_particle(world, "fleet/anchor_2_1"));
    Session session(std::move(*opened));
    session.run_until(1);
    const auto& moved = std::get<World<2, double>>(session.world());
    for (const auto id : find_particles(moved, "fleet/anchor_*")) EXPECT_NEAR((*velocity_of(moved, id))[0], 0, 0.05);
    EXPECT_NEAR((*position_of(moved, *find_particle(moved, "fleet/anchor_2_1")))[0], start[0] + 1, 1e-9);
}

TEST(Star, IsCheckedAsOtherNamesAre) {
    std::string errors;
    const std::string begin =
        R"({"sinew": 1, "figures": [{"prefab": "rope", "name": "r"}], "constraints": [{"between": )";
    EXPECT_FALSE(scene_of(begin + R"(["r/start", "r/knot_*"]}]})", &errors));
    EXPECT_NE(errors.find("/constraints/0/between/1"), std::string::npos) << errors;
    EXPECT_FALSE(scene_of(begin + R"(["r/part*", "r/*"]}]})", &errors));
    EXPECT_NE(errors.find("one of the names can end in a star"), std::string::npos) << errors;
    EXPECT_FALSE(
        scene_of(R"({"sinew": 1, "figures": [{"prefab": "rope", "name": "r", "segments": 900000}], "constraints": [
        {"between": ["r/start", "r/*"]}, {"between": ["r/end", "r/*"]}, {"between": ["r/end", "r/*"]},
        {"between": ["r/end", "r/*"]}]})",
                 &errors));
    EXPECT_NE(errors.find("constraints"), std::string::npos) << errors;
    EXPECT_NE(errors.find("at most 4000000"), std::string::npos) << errors;
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
