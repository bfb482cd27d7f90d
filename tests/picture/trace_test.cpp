#include "sinew/picture/draw.h"
#include "sinew/session/session.h"

#include "tests/stepped.h"

#include <algorithm>
#include <gtest/gtest.h>

/// Drawings of the past: paths and curves.
namespace sinew::SINEW_TEST_FILE {
namespace {

Document scene_with(const std::string& traces, const std::string& more = "") {
    return load(R"({"sinew": 1, "units": {"length": "px"}, "world": {"gravity": [0, -1000]}, )" + more +
                    R"("figures": [{"name": "x", "particles": {"ball": {"at": [0, 100], "velocity": [60, 0]}},
                        "looks": {"ball": {"color": "#123456"}}}], "seconds": 10, "traces": [)" +
                    traces + "]}",
                "test.json");
}

Session session_with(const std::string& traces, const std::string& more = "") {
    auto document = scene_with(traces, more);
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}

std::string errors_of(const std::string& traces, const std::string& more = "") {
    auto document = scene_with(traces, more);
    open_scene(document);
    return to_text(document.diagnostics);
}

Picture drawn(const Session& session) {
    Picture picture;
    picture.width = 640, picture.height = 480;
    draw(session, picture);
    return picture;
}

const Color own{0x12 / 255.0F, 0x34 / 255.0F, 0x56 / 255.0F, 1};

/// A path's colours are mixed with the background's, the last with nothing of it.
bool is_own(const Color& color) {
    return absolute(color.red - own.red) + absolute(color.green - own.green) + absolute(color.blue - own.blue) < 1e-5F;
}

/// Lines in the colour of the ball.
std::vector<std::vector<Vec2<float>>> lines_of(const Picture& picture) {
    std::vector<std::vector<Vec2<float>>> lines;
    for (const auto& item : picture.items)
        if (item.shape == Shape::polyline && is_own(item.color)) {
            const auto points = picture.points_of(item);
            lines.emplace_back(points.begin(), points.end());
        }
    return lines;
}

const std::string curve = R"({"of": "x/ball", "box": [[0, 0], [100, 50]], "shows": )";

// The centre of the picture is the middle of the frame: its corners are 50 px left and right of it, 25 above and below.
const std::string view = R"("view": {"center": [50, 25], "height": 480}, )";

TEST(Trace, APathGoesThroughThePlacesOfTheParticle) {
    auto session = session_with(R"({"of": "x/ball"})", view);
    const View seen(session.scene(), session.focus(), 640, 480);
    session.run_until(0.5);
    const auto lines = lines_of(drawn(session));
    ASSERT_EQ(lines.size(), 1U) << "only its newest part has the whole colour";
    const auto& world = std::get<World<2, double>>(session.world());
    const auto position = world.particles.position[0];
    const auto end = seen.see({{position[0], position[1], 0}})->pixel;
    EXPECT_LT(distance(lines[0].back(), end), 1e-3F);
}

// Falling freely, kinetic energy grows by the work of gravity: 1/2 m (g t)^2, and all of it stays what it was.
TEST(Trace, ACurveIsTheQuantityOverTime) {
    auto session = session_with(curve + R"("kinetic", "low": 1800, "high": 501800})", view);
    session.run_until(1);
    const auto lines = lines_of(drawn(session));
    ASSERT_EQ(lines.size(), 1U);
    const auto& line = lines[0];
    EXPECT_NEAR(line.front()[0], 270, 0.01);
    EXPECT_NEAR(line.front()[1], 265, 0.01) << "at rest but for 1/2 60^2 = 1800";
    EXPECT_NEAR(line.back()[0], 280, 0.02) << "one second of ten";
    EXPECT_NEAR(line.back()[1], 215, 0.5) << "1/2 1000^2 more at the top";
    EXPECT_NEAR(line[line.size() / 2][1], 265 - 50 / 4.0, 1) << "a quarter of it after half of the time";

    auto level = session_with(curve + R"("energy", "low": 0, "high": 200000})", view);
    level.run_until(1);
    const auto flat = lines_of(drawn(level)).at(0);
    for (const auto& point : flat) EXPECT_NEAR(point[1], flat[0][1], 0.3);
}

TEST(Trace, OnlySoManySecondsAreSeen) {
    auto session = session_with(curve + R"("speed", "seconds": 0.5})", view);
    session.run_until(2);
    const auto line = lines_of(drawn(session)).at(0);
    EXPECT_NEAR(line.front()[0], 270, 0.1);
    EXPECT_NEAR(line.back()[0], 370, 0.1) << "the present is at the right";
}

TEST(Trace, CurvesOfOneBoxShareItsFrame) {
    const auto polygons = [&](const std::string& traces) {
        const auto picture = drawn(session_with(traces, view));
        return std::ranges::count(picture.items, Shape::polygon, &Picture::Item::shape);
    };
    const auto one = curve + R"("energy", "label": "one"})";
    EXPECT_EQ(polygons(one + ", " + one), polygons(one));
    EXPECT_EQ(polygons(one + R"(, {"of": "x/ball", "shows": "speed", "box": [[0, 60], [100, 90]]})"),
              polygons(one) + 1);
    const auto picture = drawn(session_with(one, view));
    EXPECT_EQ(picture.texts, (std::vector<std::string>{"energy", "one"}));
}

TEST(Trace, HistoriesAreBounded) {
    auto session = session_with(curve + R"("speed"})", view);
    session.run_until(100);
    const auto line = lines_of(drawn(session)).at(0);
    EXPECT_LE(line.size(), History::max_samples);
    EXPECT_GT(line.size(), History::max_samples / 4);
    EXPECT_NEAR(line.front()[0], 270, 0.01) << "the first stays";
    EXPECT_NEAR(line.back()[0], 370, 0.1);
    for (std::size_t i = 1; i < line.size(); ++i) EXPECT_LT(line[i - 1][0], line[i][0]) << i;
}

TEST(Trace, GoingBackInTimeForgetsWhatHasNotHappened) {
    auto session = session_with(curve + R"("speed", "low": 0, "high": 1000})", view);
    session.run_until(0.5);
    auto earlier = session;
    const auto known = drawn(earlier);
    session.run_until(1.5);
    session = earlier;
    EXPECT_EQ(drawn(session).points, known.points);
    session.restart();
    session.run_until(0.5);
    EXPECT_EQ(drawn(session).points, known.points);
}

TEST(Trace, SaysWhatIsWrongWithIt) {
    const auto expect = [](const std::string& errors, const char* part) {
        EXPECT_NE(errors.find(part), std::string::npos) << errors;
    };
    expect(errors_of(R"({"of": "y"})"), "expected a particle as figure/name, found \"y\"");
    expect(errors_of(R"({"of": "x/bal"})"), "there is no particle in \"x\" called \"bal\"");
    expect(errors_of(R"({"of": "x", "shows": "energy"})"), "a curve of the energy needs a \"box\"");
    expect(errors_of(curve + R"("enrgy"})"), "did you mean \"energy\"?");
    expect(errors_of(curve + R"("energy", "low": 2, "high": 1})"), "low is not below high");
    std::string many = curve + R"("speed"})";
    for (std::size_t i = 0; i < max_traces; ++i) many += ", " + curve + R"("speed"})";
    expect(errors_of(many), "a scene can have 64 traces, found 65");
    EXPECT_EQ(errors_of(R"({"of": "x"})"), "");
}

TEST(Scene, AForceForAFigureThatIsNotThereIsAnError) {
    auto document =
        load(R"({"sinew": 1, "world": {"forces": [{"force": "attractor", "center": [0, 0], "figure": "sun"}]},
        "figures": [{"prefab": "rope", "name": "sum"}]})",
             "test.json");
    open_scene(document);
    const auto errors = to_text(document.diagnostics);
    EXPECT_NE(errors.find("there is no figure \"sun\" at /world/forces/0/figure"), std::string::npos) << errors;
    EXPECT_NE(errors.find("did you mean \"sum\"?"), std::string::npos) << errors;
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
