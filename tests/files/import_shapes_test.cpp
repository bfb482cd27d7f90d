#include "sinew/collide/decompose.h"
#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include "files/in/contours.h"
#include "files/in/triangulate.h"
#include "tests/files/imported.h"

#include <cmath>
#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;
using files::Outline;

double area_of(const files::AreaMesh& mesh) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::array corners{mesh.points[a], mesh.points[b], mesh.points[c]};
        area += collide::twice_area(corners) / 2;
    }
    return area;
}

double mass_of(const files::Imported& imported, std::size_t figure) {
    const auto list = at(imported, "/figures/" + std::to_string(figure) + "/particles");
    double mass = 0;
    for (const auto& particle : *list.as<json::Object>())
        mass += json::find(*particle.value.as<json::Object>(), "mass")->value.as<json::Number>()->value;
    return mass;
}

constexpr double density = 1e-3; // kg a square pixel, as docs/how/files.md tells

TEST(Triangulated, TrianglesOfAnAreaWithAHoleHaveItsArea) {
    const Outline square{{{0, 0}}, {{10, 0}}, {{10, 10}}, {{0, 10}}}, hole{{{2, 2}}, {{2, 5}}, {{7, 5}}, {{7, 2}}};
    for (const double spacing : {0.0, 1.5}) {
        const auto mesh = files::triangulated({square, hole}, spacing, 1000);
        EXPECT_NEAR(area_of(mesh), 100 - 15, 1e-4) << spacing; // the points are shaken by 1e-7 of the size
        for (const auto& [a, b, c] : mesh.triangles)
            EXPECT_GT(collide::twice_area(std::array{mesh.points[a], mesh.points[b], mesh.points[c]}), 0);
    }
}

TEST(Triangulated, EveryEdgeOfADeepCombIsAnEdgeOfATriangle) {
    Outline comb;
    for (int i = 0; i < 8; ++i)
        comb.insert(comb.end(), {{{i * 2.0, 0}}, {{i * 2.0, 9}}, {{i * 2.0 + 0.3, 9}}, {{i * 2.0 + 0.3, 0}}});
    comb.insert(comb.end(), {{{15, -1}}, {{0, -1}}});
    const auto mesh = files::triangulated({comb}, 0, 1000);
    EXPECT_NEAR(area_of(mesh), std::abs(collide::twice_area(comb)) / 2, 1e-3);
}

TEST(Simplified, NoPointIsFurtherThanTheError) {
    Outline wave;
    for (int i = 0; i < 400; ++i) {
        const double angle = i * 2 * pi<double> / 400;
        wave.push_back({{std::cos(angle) * (10 + std::sin(5 * angle)), std::sin(angle) * (10 + std::sin(5 * angle))}});
    }
    const auto simple = files::simplified_loop(wave, 0.3);
    EXPECT_LT(simple.size(), 50U);
    for (const auto& p : wave) {
        double least = 1e9;
        for (std::size_t i = 0; i < simple.size(); ++i) {
            const auto &a = simple[i], ab = simple[(i + 1) % simple.size()] - a;
            least = std::min(least, norm(p - a - ab * std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0)));
        }
        EXPECT_LE(least, 0.3 + 1e-12);
    }
}

TEST(Contours, ASmoothDiscHasItsAreaAndAHoleTheOppositeSense) {
    const auto ring = [](double x, double y) {
        const double r = std::hypot(x + 0.5 - 20, y + 0.5 - 20);
        return std::clamp(std::min(15 - r, r - 6) + 0.5, 0.0, 1.0); // smooth over a pixel
    };
    const auto outlines = files::contours({40, 40, [&](int x, int y) { return ring(x, y); }}, 0.5);
    ASSERT_EQ(outlines.size(), 2U);
    double area = 0;
    for (const auto& outline : outlines) area += collide::twice_area(outline) / 2;
    // Linear interpolation cuts curves by their sagitta over a pixel, 1/8r: less than 0.1 px of each circumference.
    EXPECT_NEAR(std::abs(area), pi<double> * (15 * 15 - 6 * 6), 0.1 * 2 * pi<double> * 21);
    EXPECT_LT(collide::twice_area(outlines[0]) * collide::twice_area(outlines[1]), 0);
}

TEST(ImportSvg, MassIsThatOfTheAreaUnderAnyTransform) {
    const auto triangle = [](const std::string& transform) {
        return "<svg width='200' height='200'><polygon points='0,0 30,0 0,40' transform='" + transform + "'/></svg>";
    };
    EXPECT_NEAR(mass_of(test::import_text("a.svg", triangle("")), 0), 600 * density, 1e-5);
    EXPECT_NEAR(mass_of(test::import_text("a.svg", triangle("translate(90 90) rotate(33) scale(2,.5)")), 0),
                600 * density, 1e-5);
    EXPECT_NEAR(mass_of(test::import_text("a.svg", triangle("matrix(0 3 -1 0 60 9) skewX(20)")), 0), 1800 * density,
                3e-5);
}

TEST(ImportSvg, MillimetresAreThoseOfCss) {
    // 25.4 mm are 96 px, and the view box has 10 units for it.
    const auto imported = test::import_text(
        "a.svg",
        "<svg width='25.4mm' height='25.4mm' viewBox='0 0 10 10'><circle class='ground' cx='5' cy='5' r='1'/></svg>");
    EXPECT_NEAR(number_at(imported, "/colliders/0/radius"), 9.6, 1e-9);
    EXPECT_NEAR(number_at(imported, "/colliders/0/at/0"), 48, 1e-9);
}

TEST(ImportSvg, RoleIsTheNearestName) {
    const auto imported = test::import_text(
        "a.svg", "<svg width='99' height='99'><g id='Grounds'><rect width='9' height='9'/><rect id='myJelly' y='20' "
                 "width='9' height='9'/></g>"
                 "<path d='M50 50L90 50' stroke='red'/><rect x='30' width='9' height='9' style='fill:none'/></svg>");
    EXPECT_EQ(count_at(imported, "/colliders"), 1U);
    EXPECT_EQ(count_at(imported, "/figures"), 2U);
    EXPECT_EQ(*at(imported, "/figures/0/name").as<std::string>(), "myJelly");
    EXPECT_TRUE(has_note(imported, "1:", "neither filled nor stroked"));
}

TEST(ImportSvg, ObstaclesKeepTheirColours) {
    const auto imported = import_text("a.svg", R"(<svg width="90" height="90"><g id="walls" stroke="#102030">
        <rect id="r" width="90" height="9" fill="#ff8000"/><path id="p" d="M0 50L40 60" fill="none"/></g></svg>)");
    EXPECT_EQ(json::to_text(at(imported, "/looks/r/fill")), "\"#ff8000\"");
    EXPECT_EQ(json::to_text(at(imported, "/looks/r/color")), "\"#102030\"");
    EXPECT_EQ(json::to_text(at(imported, "/looks/p/color")), "\"#102030\"");
    EXPECT_TRUE(open_imported(imported));
}

TEST(ImportSvg, StiffShapesKeepTheirShape) {
    auto opened = open_imported(import_sample("svg/logo.svg"));
    ASSERT_TRUE(opened);
    Session session(std::move(*opened));
    for (int i = 0; i < 60; ++i) session.step(); // the ground is met after 40
    EXPECT_LT(session.report().stretch_max, 0.01);
}

TEST(ImportPng, PiecesOfAPictureAreWrittenBesideIt) {
    const auto imported = import_sample("png/donut.png");
    EXPECT_EQ(imported.beside.size(), count_at(imported, "/figures/0/pieces") - 1); // one is the fill beneath
    // The outline has half the opacity: 48^2 - 16^2 times pi and 0.8^2 pixels are opaque, less the error of a pixel.
    const double area = pi<double> * (54 * 54 - 18 * 18) * 0.64;
    EXPECT_NEAR(mass_of(imported, 0), area * density, 0.05 * area * density);
}

TEST(ImportTiled, TilesInARowAreOneBoxAndFlagsTurnThem) {
    const auto imported = import_sample("tiled/level.tmj");
    // Floor, two terraces, a platform, two slopes, the peg and the sensor.
    EXPECT_EQ(count_at(imported, "/colliders"), 8U);
    std::vector<double> slopes; // x of the right angle's corner
    for (std::size_t i = 0; i < 8; ++i)
        if (const auto* path = at(imported, "/colliders/" + std::to_string(i) + "/path").as<std::string>()) {
            const bool falls =
                path->find("M112 160") != std::string::npos || path->find("L112 160") != std::string::npos;
            slopes.push_back(falls ? 1 : -1);
            if (!falls) {
                EXPECT_NE(path->find("208 160"), std::string::npos) << *path;
            }
        }
    EXPECT_EQ(slopes.size(), 2U);
    EXPECT_EQ(slopes[0] + slopes[1], 0);
}

TEST(ImportTiled, CompressedLayersAndTilesetsBesideAreRead) {
    EXPECT_EQ(count_at(import_sample("tiled/cave.tmj"), "/colliders"), 3U);
    EXPECT_EQ(count_at(import_sample("tiled/room.tmj"), "/colliders"), 4U); // two sides, the floor between, a shelf
}

TEST(ImportGltf, RagdollHasTheMassOfItsHeightAndTheLengthsOfItsBones) {
    const auto imported = import_sample("gltf/human.glb");
    // The head's end is at 1 + 0.1 + 0.15 + 0.15 + 0.14 + 0.1 + 0.05, toes at 1 - 0.05 - 0.43 - 0.43 - 0.07.
    const double height = 1.69 - 0.02;
    EXPECT_NEAR(mass_of(imported, 0), 70 * std::pow(height / 1.7, 3), 0.1);
    auto opened = open_imported(imported);
    ASSERT_TRUE(opened);
    Session session(std::move(*opened));
    for (int i = 0; i < 45; ++i) session.step();
    EXPECT_LT(session.report().stretch_max, 1e-3);
    const auto thigh = std::visit(
        [](const auto& world) {
            const auto knee = position_of(world, *find_particle(world, "it/mixamorig_LeftLeg"));
            return double(norm(*knee - *position_of(world, *find_particle(world, "it/mixamorig_LeftUpLeg"))));
        },
        session.world());
    EXPECT_NEAR(thigh, std::hypot(0.43, 0.01), 1e-3);
}

TEST(ImportShapes, AFileThatGivesNothingTellsWhy) {
    try {
        import_text("a.svg", "<svg width='9' height='9'>\n<text>a</text></svg>");
        FAIL() << "accepted";
    } catch (const files::ImportError& error) {
        EXPECT_EQ(error.place, "2:2: <text>");
        EXPECT_EQ(error.help, "<text> is not taken");
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
