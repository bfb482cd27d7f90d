#include "sinew/picture/style_resolver.h"

#include "player/names.h"
#include "player/scene_edit.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/play/game.h"

#include <fstream>

/// Figures and obstacles that are chosen, carried, turned, scaled, copied and deleted.
namespace sinew::play::SINEW_TEST_FILE {
namespace {

using games::Listening;
using games::pixel_of;

constexpr const char* three = R"({"sinew": 1, "view": {"center": [0, 1], "height": 4},
    "world": {"gravity": [0, -9.81], "bounds": {"planes": [{"normal": [0, 1]}]}},
    "colliders": [{"name": "step", "shape": "box", "size": [0.4, 0.2], "at": [-1.5, 0.1]}],
    "figures": [{"prefab": "box", "name": "left", "at": [-1, 1], "width": 0.4, "height": 0.4},
                {"prefab": "box", "name": "middle", "at": [0, 1], "width": 0.4, "height": 0.4},
                {"prefab": "rope", "name": "right", "at": [1, 1.5], "length": 0.5}],
    "pins": [{"particle": "left/top_left", "to": [-1.2, 0.8]}]})";

struct Selecting : testing::Test {
    Selecting() {
        std::ofstream(folder / "three.json") << three;
        play.open(folder / "three.json");
        play.resize(800, 600);
        EXPECT_EQ(play.problem(), "");
    }
    Point middle(const std::string& name, bool is_obstacle = false) {
        return middle_of(play.session().scene(), play.session().world(), {name, is_obstacle}).value_or(Point{});
    }
    Vec2<double> pixel(const Point& at) { return cast<double>(play.view().see(at.as<3, double>())->pixel); }
    void drag(Vec2<double> from, Vec2<double> to) {
        play.handle(Moved{from});
        play.handle(Pressed{});
        play.handle(Moved{(from + to) * 0.5});
        play.handle(Moved{to});
        play.handle(Released{});
    }
    void expect_opens_again() {
        const auto text = text_of(play.session());
        const auto again = games::read(text, "again");
        EXPECT_TRUE(again.opened) << again.problem << text;
    }

    ScratchFolder folder;
    Play play{games::library, "ragdoll"};
};

// A place on a figure that the hand takes while time stands.
TEST_F(Selecting, WhileTimeStandsADragCarriesTheWholeFigure) {
    for (int i = 0; i < 20; ++i) play.advance(1.0 / 60);
    play.pause(true);
    const auto before = middle("middle"), other = middle("right");
    const auto from = pixel_of(play, "middle/top_left");
    drag(from, from + Vec2<double>{{150, -75}});
    EXPECT_NEAR(middle("middle")[0], before[0] + 1, 0.01);
    EXPECT_NEAR(middle("middle")[1], before[1] + 0.5, 0.01);
    EXPECT_EQ(middle("right"), other) << "others stay where they are";
    EXPECT_EQ(play.session().hand(), nullptr);
    play.undo();
    EXPECT_NEAR(middle("middle")[0], before[0], 1e-9) << "a drag is one edit";
    play.redo();
    EXPECT_NEAR(middle("middle")[0], before[0] + 1, 0.01);
    expect_opens_again();
    play.restart();
    EXPECT_NEAR(middle("middle")[0], 1, 0.01) << "it begins there, too";
}

TEST_F(Selecting, ChoosesWithShiftAndByAFrameAndCarriesAllThatIsChosen) {
    play.handle(Key{"space"});
    play.handle(Key{"q"});
    drag(pixel(middle("left")), pixel(middle("left")));
    EXPECT_EQ(play.chosen.size(), 1u);
    play.handle(Key{"left shift"});
    drag(pixel(middle("middle")), pixel(middle("middle")));
    play.handle(KeyUp{"left shift"});
    EXPECT_EQ(play.chosen.size(), 2u);
    const auto left = middle("left"), both = middle("middle");
    drag(pixel(both), pixel(both) + Vec2<double>{{0, -150}});
    EXPECT_NEAR(middle("left")[1], left[1] + 1, 0.01);
    EXPECT_NEAR(middle("middle")[1], both[1] + 1, 0.01);
    EXPECT_NEAR((*play.session().scene().pins[0].to)[1], 1.8, 0.01) << "what is pinned is pinned there";
    drag({{5, 5}}, {{6, 6}});
    EXPECT_TRUE(play.chosen.empty()) << "a press on nothing";
    drag({{5, 5}}, {{795, 595}});
    EXPECT_EQ(play.chosen.size(), 4u) << "three figures and an obstacle";
    expect_opens_again();
}

TEST_F(Selecting, TheRingTurnsAndTheSquareScales) {
    play.handle(Key{"space"});
    play.handle(Key{"q"});
    drag(pixel(middle("middle")), pixel(middle("middle")));
    const auto center = pixel(middle("middle"));
    const double half = 30, margin = 10, stalk = 26; // 0.2 m of 150 pixels
    drag(center + Vec2<double>{{0, -half - margin - stalk}}, center + Vec2<double>{{half + margin + stalk, 0}});
    const auto& turned = play.session().scene().figures[1];
    EXPECT_NEAR(turned.turn, -pi<double> / 2, 0.02) << "a quarter clockwise";
    EXPECT_NEAR(middle("middle")[0], 0, 1e-6);
    EXPECT_NEAR(middle("middle")[1], 1, 1e-6);
    play.undo();
    EXPECT_EQ(play.session().scene().figures[1].turn, 0);
    const Vec2<double> corner{{half + margin, half + margin}};
    drag(center + corner, center + corner * 2.0);
    const auto& box = std::get<Box>(play.session().scene().figures[1].made);
    EXPECT_NEAR(box.width, 0.8, 0.01);
    EXPECT_NEAR(distance(pixel_of(play, "middle/top_left"), center), 60 * std::sqrt(2), 1.5);
    expect_opens_again();
}

TEST_F(Selecting, LimitsGrowByThePowerOfTheirKind) {
    std::ofstream(folder / "slider.json") << R"({"sinew": 1, "figures": [{"name": "slider",
        "particles": {"a": {"at": [0, 0]}, "b": {"at": [1, 0]}, "c": {"at": [0.5, 0.1]}},
        "constraints": [{"kind": "rail", "between": ["a", "b", "c"], "low": -0.1, "high": 0.2},
                        {"kind": "area", "between": ["a", "b", "c"], "low": 0.01, "high": 0.05},
                        {"kind": "angle", "between": ["a", "b", "c"], "low": 10, "high": 60}]}]})";
    play.open(folder / "slider.json");
    const Part slider{"slider", false};
    ASSERT_TRUE(play.reshape({slider}, {.scale = 2}, "scale", false)) << play.problem();
    const auto& constraints = std::get<ByHand>(play.session().scene().figures[0].made).constraints;
    const double expected[3][2] = {{-0.2, 0.4}, {0.04, 0.2}, {10, 60}};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(*constraints[i].low, expected[i][0], 1e-9) << i;
        EXPECT_NEAR(*constraints[i].high, expected[i][1], 1e-9) << i;
    }
}

TEST_F(Selecting, CopiesLieBesideTheirOriginalsWithTheirPins) {
    play.handle(Key{"ctrl+d"});
    EXPECT_EQ(play.session().scene().figures.size(), 3u) << "nothing is chosen";
    play.choose_all();
    play.handle(Key{"ctrl+d"});
    const auto& scene = play.session().scene();
    ASSERT_EQ(scene.figures.size(), 6u) << play.problem();
    EXPECT_EQ(scene.colliders.size(), 2u);
    ASSERT_EQ(scene.pins.size(), 2u);
    EXPECT_EQ(scene.pins[1].particle, "left_2/top_left");
    EXPECT_GT(middle("middle_2")[0], middle("middle")[0] + 0.1);
    EXPECT_EQ(play.chosen.size(), 4u);
    EXPECT_EQ(play.chosen[0].name, "left_2");
    play.handle(Key{"delete"});
    EXPECT_EQ(play.session().scene().figures.size(), 3u) << "the copies are what is chosen";
    EXPECT_EQ(play.session().scene().pins.size(), 1u);
    play.undo();
    EXPECT_EQ(play.session().scene().figures.size(), 6u);
    expect_opens_again();
}

TEST_F(Selecting, DeletingAFigureLeavesTheColoursOfOthers) {
    const auto color_of = [&](const std::string& name) {
        const auto& scene = play.session().scene();
        for (std::size_t i = 0; i < scene.figures.size(); ++i)
            if (scene.figures[i].name == name)
                return StyleResolver(scene, theme_called("light"), i, name).of("edge").color;
        return Color{};
    };
    const auto before = color_of("middle");
    play.remove({{"left", false}});
    EXPECT_EQ(play.session().scene().figures.size(), 2u);
    const auto after = color_of("middle");
    EXPECT_NEAR(after.red, before.red, 0.003);
    EXPECT_NEAR(after.green, before.green, 0.003);
    EXPECT_NEAR(after.blue, before.blue, 0.003);
    EXPECT_TRUE(play.session().scene().pins.empty());
    expect_opens_again();
}

// References of every section, which the figure takes with itself.
TEST_F(Selecting, ADeletedFigureTakesWhateverRefersToIt) {
    std::ofstream(folder / "all.json") << R"({"sinew": 1,
        "figures": [{"prefab": "box", "name": "a"}, {"prefab": "box", "name": "b", "at": [2, 0]},
                    {"name": "rod", "constraints": [{"between": ["a/top_left", "b/top_left"]}]}],
        "constraints": [{"between": ["a/top_right", "b/top_right"]}],
        "pins": [{"particle": "a/top_left"}], "pairs": [{"between": ["a", "b"], "friction": 0}],
        "looks": {"a": {"color": "red"}, "b": {"color": "blue"}},
        "traces": [{"of": "a/top_left"}],
        "events": [{"at": 1, "kick": "a/top_left", "by": [1, 1]}, {"at": 1, "remove": ["a", "b"]},
                   {"at": 2, "join": ["a/top_left", "b/top_left"]}]})";
    play.open(folder / "all.json");
    ASSERT_EQ(play.problem(), "");
    play.remove({{"a", false}});
    const auto& scene = play.session().scene();
    EXPECT_EQ(play.problem(), "");
    ASSERT_EQ(scene.figures.size(), 1u) << "the rod had one end left";
    EXPECT_TRUE(scene.constraints.empty() && scene.pins.empty() && scene.pairs.empty() && scene.traces.empty());
    EXPECT_EQ(scene.events.size(), 1u);
    expect_opens_again();
}

TEST_F(Selecting, ObstaclesAreDeletedAndCarriedToo) {
    play.pause(true);
    play.tool = "select";
    const auto from = pixel(middle("step", true));
    drag(from, from + Vec2<double>{{150, -150}});
    EXPECT_NEAR(middle("step", true)[0], -0.5, 0.01);
    play.tool = "remove";
    play.handle(Moved{pixel(middle("step", true))});
    play.handle(Pressed{});
    play.handle(Released{});
    EXPECT_TRUE(play.session().scene().colliders.empty());
}

TEST_F(Selecting, TheCameraFollowsWhatIsChosen) {
    play.choose(Part{"middle", false}, false);
    play.handle(Key{"h"});
    ASSERT_TRUE(play.followed);
    for (int i = 0; i < 240; ++i) play.advance(1.0 / 60);
    EXPECT_LT(distance(pixel(middle("middle")), Vec2<double>{{400, 300}}), 5);
    play.remove({{"middle", false}});
    play.advance(1.0 / 60);
    EXPECT_FALSE(play.followed);
}

// Hostile orders: whatever is under way is ended, and nothing is left over.
TEST_F(Selecting, EditsInTheMidstOfADragDoNoHarm) {
    for (const auto* key : {"ctrl+d", "delete", "ctrl+z", "ctrl+y", "r", "e", "g", "c", "escape", "ctrl+n", "]"}) {
        play.question.reset();
        play.open(folder / "three.json");
        if (play.question) play.answer("discard");
        play.pause(true);
        play.tool = "select";
        const auto from = pixel(middle("middle"));
        play.handle(Moved{from});
        play.handle(Pressed{});
        play.handle(Moved{from + Vec2<double>{{40, 0}}});
        play.handle(Key{key});
        play.handle(Moved{from + Vec2<double>{{90, 9}}});
        play.advance(1.0 / 60);
        play.handle(Released{});
        for (int i = 0; i < 5; ++i) play.undo();
        std::vector<Picture> pictures;
        play.draw_panes(pictures);
        play.dismiss_problem();
    }
}

TEST_F(Selecting, AChangeOfFrictionOrColourLeavesAFigureAsItMoves) {
    for (int i = 0; i < 20; ++i) play.advance(1.0 / 60);
    const auto now = pixel_of(play, "middle/top_left");
    EXPECT_TRUE(play.set("figures.middle.contact.friction", "0.1")) << play.problem();
    EXPECT_TRUE(play.set("figures.middle.looks.all.color", "\"#00ff00\"")) << play.problem();
    EXPECT_EQ(pixel_of(play, "middle/top_left"), now);
    EXPECT_EQ(play.session().scene().figures[1].contact.friction, 0.1);
}

} // namespace
} // namespace sinew::play::SINEW_TEST_FILE
