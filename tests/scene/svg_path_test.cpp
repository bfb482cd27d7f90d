#include "sinew/collide/decompose.h"
#include "sinew/math/trig.h"
#include "sinew/scene/svg_path.h"
#include "sinew/session/session.h"

#include <gtest/gtest.h>

/// Paths of SVG as colliders.
namespace sinew::SINEW_TEST_FILE {
namespace {

double area(const SvgOutline& outline) {
    double sum = 0;
    const auto& points = outline.points;
    for (std::size_t i = 0; i < points.size(); ++i) sum += cross(points[i], points[(i + 1) % points.size()]) / 2;
    return sum;
}

std::vector<SvgOutline> outlines(std::string_view text) {
    auto path = read_svg_path(text);
    EXPECT_EQ(path.error, "") << text;
    return path.outlines;
}

SvgOutline outline(std::string_view text) {
    auto all = outlines(text);
    EXPECT_EQ(all.size(), 1U) << text;
    return all.empty() ? SvgOutline{} : all.front();
}

std::string numbers(const SvgOutline& outline) {
    std::string text;
    for (const auto& point : outline.points)
        text += std::to_string(int(point[0] * 10)) + "," + std::to_string(int(point[1] * 10)) + " ";
    return text;
}

TEST(SvgPath, AStarIsItsCorners) {
    const auto star = outline("M 0 -10 L 3 -3 L 10 0 L 3 3 L 0 10 L -3 3 L -10 0 L -3 -3 Z");
    EXPECT_EQ(star.points.size(), 8U);
    EXPECT_TRUE(star.closed);
    EXPECT_NEAR(absolute(area(star)), 8 * 0.5 * 30, 1e-9);
}

TEST(SvgPath, RelativeCommandsRepeatsAndShortNumbers) {
    const auto expected = numbers(outline("M 1 1 L 3 1 L 3 2 L 1.5 2 Z"));
    for (const auto* same : {"m1 1 2 0 0 1-1.5 0z", "M1,1h2v1H1.5Z", "M1 1H3V2h-1.5z", "M1 1L3,1,3,2,1.5,2z",
                             "M 10e-1+1l2 0\n\t0 1-1.5.0z", "m1 1 2 0 0 1-1.5 0 -.5-1"})
        EXPECT_EQ(numbers(outline(same)), expected) << same;
    EXPECT_EQ(numbers(outline("M1.5.5.5 1.5")), "15,5 5,15 ");
}

TEST(SvgPath, SubpathsAreOutlines) {
    const auto two = outlines("M0 0H1V1Zl-1 0 0-1zM5 5");
    ASSERT_EQ(two.size(), 2U) << "the second begins where the first did; a point is no outline";
    EXPECT_EQ(numbers(two[1]), "0,0 -10,0 -10,-10 ");
    EXPECT_FALSE(outline("M0 0 1 0").closed);
    EXPECT_TRUE(outlines("").empty());
}

/// Chords lie within the tolerance of the curve, so an area is off by less than the tolerance times the length.
void expect_area(const char* text, double exact, double size, double length) {
    EXPECT_NEAR(area(outline(text)), exact, svg_tolerance * size * length) << text;
}

TEST(SvgPath, CirclesOfArcsHaveTheirArea) {
    const double circle = pi<double>, size = 2.83, length = 2 * pi<double>;
    expect_area("M1 0A1 1 0 0 1-1 0A1 1 0 0 1 1 0Z", circle, size, length);
    expect_area("M1 0a1 1 0 1 0-2 0a1 1 0 1 0 2 0", -circle, size, length);
    expect_area("M1 0A1 1 0 110-1Z", 0.75 * circle + 0.5, size, length); // flags without spaces
    expect_area("M1 0A1 1 0 010 1Z", 0.25 * circle - 0.5, size, length);
    expect_area("M1 0A1 1 0 0 0 0 1Z", -(0.25 * circle - 0.5), size, length); // the same arc of the mirrored circle
    expect_area("M1 0A.1-.1 0 0 1-1 0Z", circle / 2, size, length);           // too small a radius grows
    expect_area("M2 0A2 1 0 0 1-2 0A2 1 0 0 1 2 0", 2 * circle, 4.5, 10);
    expect_area("M0 2A2 1 90 0 1 0-2A2 1 90 0 1 0 2", 2 * circle, 4.5, 10); // turned by a quarter
    EXPECT_EQ(numbers(outline("M0 0A0 1 0 0 1 1 1H0")), "0,0 10,10 0,10 ");
}

TEST(SvgPath, EveryPointOfAnArcIsOnItsEllipse) {
    const double turn = 30 * pi<double> / 180;
    const auto arc = outline("M 3 1 A 5 2 30 1 0 6 4");
    // the centre is where both ends have the same distance in the frame of the ellipse
    Vec2<double> sum{};
    const auto frame = [&](const Vec2<double>& p) {
        return Vec2<double>{
            {(p[0] * cosine(turn) + p[1] * sine(turn)) / 5, (p[1] * cosine(turn) - p[0] * sine(turn)) / 2}};
    };
    const auto a = frame(arc.points.front()), b = frame(arc.points.back()),
               m = frame(arc.points[arc.points.size() / 2]);
    // circle through three points
    const auto ab = b - a, am = m - a;
    const double twice = 2 * cross(ab, am);
    sum = a + Vec2<double>{{am[1] * dot(ab, ab) - ab[1] * dot(am, am), ab[0] * dot(am, am) - am[0] * dot(ab, ab)}} *
                  (1 / twice);
    for (const auto& point : arc.points) EXPECT_NEAR(distance(frame(point), sum), 1, 1e-9);
}

TEST(SvgPath, CurvesHaveTheirArea) {
    expect_area("M0 0Q1 2 2 0", -4.0 / 3, 2.3, 5);      // 2/3 of the triangle of its control points
    expect_area("M0 0C0 1 1 1 1 0", -0.6, 1.3, 3);      // 3/20 of 4
    expect_area("M0 0C0 1 1 1 1 0S2-1 2 0", 0, 2.5, 5); // a smooth curve mirrors the last control point
    expect_area("M0 0Q1 2 2 0T4 0", 0, 4.5, 10);
    expect_area("M0 0q1 2 2 0t2 0", 0, 4.5, 10);
    expect_area("M0 0c0 1 1 1 1 0s1-1 1 0", 0, 2.5, 5);
    EXPECT_EQ(numbers(outline("M0 0 1 0S2 1 2 2")), numbers(outline("M0 0 1 0C1 0 2 1 2 2"))) << "nothing to mirror";
    expect_area("M0 0 1 0T2 2", 1, 2.9, 6); // nothing to mirror: a line
}

TEST(SvgPath, IsAsFineWhateverItsSize) {
    const auto small = outline("M1e-4 0A1e-4 1e-4 0 0 1-1e-4 0Z"), large = outline("M1e4 0A1e4 1e4 0 0 1-1e4 0Z");
    EXPECT_EQ(small.points.size(), large.points.size());
    EXPECT_LT(small.points.size(), 50U);
}

TEST(SvgPath, MistakesHaveAPlace) {
    for (const auto& [text, error] :
         {std::pair("L 1 1", "character 1 of the path: expected M, which begins a path, found \"L\""),
          std::pair("M 0 0 X 1",
                    "character 7 of the path: expected a command (one of MLHVCSQTAZ, or small), found \"X\""),
          std::pair("M 0 0 L 1", "character 10 of the path: expected a number, found the end"),
          std::pair("M 0 0 L 1 1, Z", "character 14 of the path: expected a number, found \"Z\""),
          std::pair("M 0 0 5,,5", "character 9 of the path: expected a number, found \",\""),
          std::pair("M 0 0 Z 5",
                    "character 9 of the path: expected a command (one of MLHVCSQTAZ, or small), found \"5\""),
          std::pair("M 0 0 A 1 1 0 2 1 1 1", "character 15 of the path: expected a flag, 0 or 1, found \"2\""),
          std::pair("M 0 1e10", "character 5 of the path: expected a number between -1e9 and 1e9, found \"1\""),
          std::pair("M 0 -.e1", "character 5 of the path: expected a number, found \"-\""),
          std::pair("M 0 \xc3\xa9", "character 5 of the path: expected a number, found \"\xc3\xa9\"")})
        EXPECT_EQ(read_svg_path(text).error, error);
}

TEST(SvgPath, AnyTextEnds) {
    for (const auto* text :
         {"M0 0A1e-9 1e9 0 1 1 1e-300 0Z", "M1e9 0A1e-200 1 0 0 1 1e9 1e-20", "M0 0C1 1 1 1 0 0",
          "M0 0A1e9 1 0 0 1 0 1e-4Z", "M0 0 0 0 0 0Z", "M1e9 1e9A1e9 1e9 0 1 0 1e9 999999999.9999999z"})
        for (const auto& outline : outlines(text)) EXPECT_LT(outline.points.size(), 5000U) << text;
}

// --- in scenes -------------------------------------------------------------------------------------------------------

std::string with_collider(const std::string& collider, const std::string& more = "") {
    return R"({"sinew": 1, "world": {"gravity": [0, -10]}, "colliders": [{)" + collider +
           R"(, "friction": 0.5}], "figures": [
        {"name": "ball", "particles": {"p": {"at": [0, 3], "radius": 0.1}}}])" +
           more + "}";
}
std::string told(const std::string& scene) {
    auto document = load(scene, "test.json");
    open_scene(document);
    return to_text(document.diagnostics);
}
Session opened(const std::string& scene) {
    auto document = load(scene, "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}
Vec2<double> place_of_ball(Session& session, double seconds) {
    session.run_until(seconds);
    return std::visit(
        [](const auto& world) {
            const auto place = *position_of(world, *find_particle(world, "ball/p"));
            return Vec2<double>{{double(place[0]), double(place[1])}};
        },
        session.world());
}

TEST(SvgCollider, ABallRestsInABowlAndOnAHill) {
    // a bowl cut out of a block by a half circle of radius 1 about (0, 1.5), and a chain of the same form
    const std::string bowl = "M-2 0H2V1.5H1A1 1 0 0 0-1 1.5H-2Z", valley = "M-2 1.5H-1A1 1 0 0 1 1 1.5H2";
    for (const auto& [shape, path] : {std::pair("polygon", bowl), std::pair("chain", valley)}) {
        auto session = opened(with_collider(R"("shape": ")" + std::string(shape) + R"(", "path": ")" + path + "\"",
                                            R"(, "solver": {"substeps": 8})"));
        const auto place = place_of_ball(session, 4);
        EXPECT_NEAR(place[0], 0, 0.05) << shape;
        EXPECT_NEAR(place[1], 0.5 + 0.1, 0.005) << shape;
    }
    auto session = opened(with_collider(R"("shape": "polygon", "path": "M-1 0Q0 4 1 0Z")"));
    EXPECT_NEAR(place_of_ball(session, 1)[1], 2 + 0.1, 0.005) << "the vertex of a parabola";
}

TEST(SvgCollider, AScreenWithYDownHasTheNumbersOfADrawing) {
    auto session = opened(R"({"sinew": 1, "units": {"length": "px", "time": "s", "up": "-y"},
        "world": {"gravity": [0, 981]}, "colliders": [
        {"shape": "polygon", "path": "M-100 0Q0-40 100 0Z"}, {"shape": "chain", "path": "M-300 50 C -100 -50 100 -50 300 50"}],
        "figures": [{"name": "ball", "particles": {"p": {"at": [0, -90], "radius": 5}}}]})");
    EXPECT_NEAR(place_of_ball(session, 1)[1], -25 - 5, 0.5) << "the hill of the chain is higher than the parabola";
}

TEST(SvgCollider, MistakesAreTold) {
    const auto polygon = [](const std::string& path) {
        return told(with_collider(R"("shape": "polygon", "path": ")" + path + "\""));
    };
    EXPECT_NE(polygon("M0 0L1").find("test.json:1:"), std::string::npos);
    EXPECT_NE(polygon("M0 0L1").find("character 7 of the path: expected a number, found the end"), std::string::npos);
    EXPECT_NE(polygon("M0 0L2 2V0L0 2Z").find("their edges cross"), std::string::npos);
    EXPECT_NE(polygon("M0 0H1V1ZM5 5H9H7Z").find("enclose no area"), std::string::npos);
    EXPECT_NE(polygon("").find("needs at least 3 points, found 0"), std::string::npos);
    EXPECT_NE(told(with_collider(R"("shape": "polygon", "path": "M0 0H1V1Z", "points": [[0, 0]])")).find("not both"),
              std::string::npos);
    EXPECT_NE(told(with_collider(R"("shape": "polygon")")).find("needs at least 3 points"), std::string::npos);
    std::string saw = "M0 0H1000";
    for (int i = 0; i < 700; ++i) saw += "l-1 1v-1";
    EXPECT_NE(polygon(saw + "V-1z").find("at most 500 are allowed"), std::string::npos);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
