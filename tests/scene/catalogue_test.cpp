#include "sinew/session/session.h"
#include "sinew/solver/edit.h"

#include "tests/sanitized.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

/// Every file under scenes/, in both modes and precisions.
namespace sinew {
namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(SINEW_SCENES_DIR))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// A session of a scene with a mode and a precision; what is wrong with it is a failure.
std::optional<Session> open(const std::string& name, const std::string& mode, const std::string& precision = "double") {
    const auto path = std::filesystem::path(SINEW_SCENES_DIR) / (name + ".json");
    const std::array<Override, 2> choice = {Override{"mode=" + mode}, Override{"precision=" + precision}};
    auto document = load(text_of(path), path.string(), choice);
    auto opened = open_scene(document);
    EXPECT_TRUE(opened.has_value()) << to_text(document.diagnostics);
    if (!opened) return std::nullopt;
    return Session(std::move(*opened));
}

/// How far the particles that move are beyond the bounds, at most, in their radii or in `size`, if that is larger.
double distance_outside(const AnyWorld& any, double size) {
    return std::visit(
        [&](const auto& world) {
            double farthest = 0;
            for (const auto& plane : world.bounds)
                for (Row row = 0; row < world.particles.size(); ++row) {
                    if (world.particles.mobility[row] == 0) continue;
                    const double depth =
                        double(plane.offset) - double(dot(plane.normal, world.particles.position[row]));
                    farthest = std::max(farthest, depth / std::max(double(world.particles.radius[row]), size));
                }
            return farthest;
        },
        any);
}

bool is_finite(const AnyWorld& any) {
    return std::visit(
        [](const auto& world) {
            return std::all_of(world.particles.position.begin(), world.particles.position.end(),
                               [](const auto& place) { return is_finite(place); });
        },
        any);
}

/// The worst strain of a distance that is not meant to give.
double rigid_strain(const AnyWorld& any) {
    return std::visit(
        []<class WorldT>(const WorldT& world) {
            const auto& distances = std::get<kind_number<Distance, WorldT::dimension>>(world.constraints);
            double worst = 0;
            for (Row row = 0; row < distances.size(); ++row) {
                if (distances.compliance[row] > 0) continue;
                const auto ends = distances.members[row];
                const double length =
                    double(distance(world.particles.position[ends[0]], world.particles.position[ends[1]]));
                const double low = double(distances.low[row]), high = double(distances.high[row]);
                worst = std::max({worst, length / high - 1, low > 0 ? 1 - length / low : 0});
            }
            return worst;
        },
        any);
}

/// How many items have a point in the picture.
std::size_t items_on_screen(const Session& session) {
    Picture picture;
    picture.width = session.scene().view.size[0];
    picture.height = session.scene().view.size[1];
    session.draw(picture);
    return std::size_t(std::count_if(picture.items.begin(), picture.items.end(), [&](const Picture::Item& item) {
        const auto points = picture.points_of(item);
        return std::any_of(points.begin(), points.end(), [&](const auto& point) {
            return point[0] >= 0 && point[1] >= 0 && point[0] <= float(picture.width) &&
                   point[1] <= float(picture.height);
        });
    }));
}

struct Run {
    std::string scene, mode, precision;

    friend std::ostream& operator<<(std::ostream& out, const Run& run) {
        return out << run.scene << ' ' << run.mode << ' ' << run.precision;
    }
};

std::vector<Run> runs() {
    std::vector<Run> all;
    for (const auto& scene : scene_names())
        for (const auto mode : modes)
            for (const auto precision : SolverSection::precisions)
                all.push_back({scene, std::string(mode), std::string(precision)});
    return all;
}

class CatalogueRun : public testing::TestWithParam<Run> {};

TEST_P(CatalogueRun, RunsItsTimeWhole) {
    const auto& [name, mode, precision] = GetParam();
    auto session = open(name, mode, precision);
    ASSERT_TRUE(session);
    EXPECT_FALSE(session->scene().about.empty());
    EXPECT_FALSE(session->scene().source.empty());
    EXPECT_GT(items_on_screen(*session), 0U);

    // An original's sweep comes after its walls, so that a stick pushes a point out again for a frame.
    const double metre = session->scene().measures().per_metre;
    const double size = (mode == "classic" ? 0.5 : 0.01) * metre;
    double outside = 0;
    const double whole = session->scene().seconds, end = test::sanitized ? std::min(1.0, whole) : whole;
    while (session->seconds() < end) {
        session->step();
        ASSERT_TRUE(is_finite(session->world())) << "after " << session->seconds() << " seconds";
        outside = std::max(outside, distance_outside(session->world(), size));
    }
    EXPECT_LE(outside, 1);
    EXPECT_GT(items_on_screen(*session), 0U);
    for (const auto& happening : session->happenings()) EXPECT_NE(happening.what, "quarantined");
    if (mode == "physical" && end == whole) {
        EXPECT_LT(rigid_strain(session->world()), 0.01);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CatalogueRun, testing::ValuesIn(runs()), [](const auto& test) {
    return fmt::format("{}_{}_{}", test.param.scene, test.param.mode, test.param.precision);
});

// The numbers of the originals, in pixels and frames.
struct Original {
    std::string scene;
    double gravity, keep;
    int passes;
    std::size_t particles, distances;
};

TEST(Catalogue, ClassicModeHasTheOriginalsNumbers) {
    const std::array<Original, 7> originals = {{
        {"box", 0.1, 0.99, 6, 4, 5},
        {"ragdoll", 0.1, 0.99, 6, 15, 21},
        {"cloth_wind", 0.1, 0.99, 6, 10 * 7, 9 * 7 + 10 * 6},
        {"chains", 0.6, 0.98 * 0.90, 1, 30 + 20 + 15 + 10 + 5 + 5, 30 + 20 + 15 + 10 + 5},
        {"stick", 0, 1, 1, 2, 1},
        {"fixed_stick", 0, 1, 1, 2, 1},
        {"triangle", 0, 1, 1, 3, 3},
    }};
    for (const auto& [name, gravity, keep, passes, particles, distances] : originals) {
        SCOPED_TRACE(name);
        auto session = open(name, "classic");
        ASSERT_TRUE(session);
        const auto& world = std::get<World<2, double>>(session->world());
        EXPECT_EQ(session->scene().world.gravity, (Point{{0, gravity, 0}}));
        EXPECT_NEAR(world.settings.classic.keep, keep, 1e-12);
        EXPECT_EQ(world.settings.classic.passes, passes);
        EXPECT_EQ(world.settings.frame, 1);
        EXPECT_EQ(world.particles.size(), particles);
        EXPECT_EQ(std::get<0>(world.constraints).size(), distances);
    }
}

World<2, double> classic_world(const std::string& name) {
    auto session = open(name, "classic");
    return session ? std::get<World<2, double>>(session->world()) : World<2, double>{};
}

Vec2<double> place(const World<2, double>& world, std::string_view name) {
    return position_of(world, find_particle(world, name).value_or(ParticleId{})).value_or(Vec2<double>{});
}

TEST(Catalogue, BoxStandsWhereTheOriginalStood) {
    const auto world = classic_world("box");
    EXPECT_EQ(place(world, "box/top_left"), (Vec2<double>{{275, 275}}));
    EXPECT_EQ(place(world, "box/bottom_right"), (Vec2<double>{{325, 325}}));
    EXPECT_EQ(world.settings.classic.bounce, 0.8);
    EXPECT_TRUE(world.settings.classic.damp_after_force);
}

TEST(Catalogue, RagdollIsKickedTwentyPixelsAFrame) {
    const auto world = classic_world("ragdoll");
    EXPECT_EQ(velocity_of(world, *find_particle(world, "bob/left_shoulder")), (Vec2<double>{{0, -20}}));
    EXPECT_EQ(velocity_of(world, *find_particle(world, "bob/right_shoulder")), (Vec2<double>{{0, 0}}));
    EXPECT_EQ(place(world, "bob/left_shoulder"), (Vec2<double>{{310, 200}}));
}

TEST(Catalogue, ChainsHangFromTheirPlacesAndTheLowerLoopTakesAll) {
    const auto world = classic_world("chains");
    constexpr std::array<int, 5> links = {30, 20, 15, 10, 5};
    for (std::size_t i = 0; i < links.size(); ++i) {
        const auto name = fmt::format("chain_{}", links[i]);
        const auto start = place(world, name + "/start"), end = place(world, name + "/end");
        EXPECT_EQ(start, (Vec2<double>{{100 + 200 * double(i), 12}}));
        EXPECT_NEAR(end[1] - start[1], 26 * links[i], 1e-9);
    }
    for (const double split : std::get<0>(world.constraints).split) EXPECT_EQ(split, 0);
}

TEST(Catalogue, SticksStartOnOneSpotAndPartToAHundredPixels) {
    for (const std::string name : {"stick", "fixed_stick", "triangle"}) {
        SCOPED_TRACE(name);
        auto session = open(name, "classic");
        ASSERT_TRUE(session);
        const auto& world = std::get<World<2, double>>(session->world());
        for (const auto& start : world.particles.position) EXPECT_EQ(start, (Vec2<double>{{240, 165}}));
        session->run_until(1); // a triangle is pushed out along a line first and takes half a second to find out
        EXPECT_LT(rigid_strain(session->world()), 0.01);
        for (const double split : std::get<0>(world.constraints).split)
            EXPECT_EQ(split, name == "fixed_stick" ? 1 : 0.5);
    }
}

TEST(Catalogue, ClothHasFiftyPixelCellsAndItsTopRowHeld) {
    const auto world = classic_world("cloth_wind");
    EXPECT_EQ(place(world, "cloth/particle_1_1") - place(world, "cloth/particle_0_0"), (Vec2<double>{{50, 50}}));
    EXPECT_EQ(place(world, "cloth/particle_0_0")[1], 50);
    EXPECT_EQ(world.pins.size(), 10U);
    const auto* push = std::get_if<RandomPush<2, double>>(&world.forces.at(1));
    ASSERT_TRUE(push);
    EXPECT_EQ(push->low, (Vec2<double>{{-2, 0}}));
    EXPECT_EQ(push->high, (Vec2<double>{{6, 0}}));
}

// x_prev = (0, 0), x = (1, 1), a = -10: Verlet's own parabola is  y_n = 1 + n - a h^2 n (n + 1) / 2. Rounding of the
// places, which velocities are differences of, adds up twice: 1e-14 n^2.
TEST(Catalogue, ClassicProjectileFollowsTheDiscreteParabola) {
    auto session = open("projectile", "classic");
    ASSERT_TRUE(session);
    const auto& world = std::get<World<2, double>>(session->world());
    for (int n = 1; n <= 720; ++n) {
        session->step();
        const auto ball = place(world, "point/ball");
        EXPECT_NEAR(ball[0], 1 + n, 1e-9);
        EXPECT_NEAR(ball[1], 1 + n - 10.0 / 3600 * n * (n + 1) / 2, 1e-8);
    }
}

// The same start in physical mode: 60 m/s either way, and the parabola of the textbook, to rounding.
TEST(Catalogue, PhysicalProjectileFollowsTheExactParabola) {
    auto session = open("projectile", "physical");
    ASSERT_TRUE(session);
    const auto& world = std::get<World<2, double>>(session->world());
    for (int n = 1; n <= 700; ++n) {
        session->step();
        const double t = n / 60.0;
        const auto ball = place(world, "point/ball");
        EXPECT_NEAR(ball[0], 1 + 60 * t, 1e-9);
        EXPECT_NEAR(ball[1], 1 + 60 * t - 5 * t * t, 1e-9);
    }
}

TEST(Catalogue, BallsAtThirtyAndSixtyDegreesLandOnOneSpot) {
    auto session = open("projectile", "physical");
    ASSERT_TRUE(session);
    const auto& world = std::get<World<2, double>>(session->world());
    double low = 0, high = 0;
    for (int n = 0; n < 16 * 60; ++n) {
        session->step();
        for (const auto& [ball, landed] : {std::pair("low/ball", &low), std::pair("high/ball", &high)})
            if (const auto at = place(world, ball); *landed == 0 && at[1] < 1) *landed = at[0];
    }
    EXPECT_NEAR(low, high, 1.5); // a frame of the faster is 1.2 m
}

// --- golden hashes ------------------------------------------------------------------------------------------------

const std::string golden_file = std::string(SINEW_SOURCE_DIR) + "/tests/golden/scenes.txt";

std::string golden_hashes() {
    std::string text = "# State of every scene after two seconds. To renew this file, run the tests with "
                       "SINEW_RENEW_GOLDEN=1 in the environment.\n";
    for (const auto& [name, mode, precision] : runs()) {
        auto session = open(name, mode, precision);
        if (!session) continue;
        session->run_until(2);
        text += fmt::format("{} {} {} {:016x}\n", name, mode, precision, session->report().hash);
    }
    return text;
}

TEST(Catalogue, ScenesEndInTheSameBitsAsEver) {
    const auto now = golden_hashes();
    if (std::getenv("SINEW_RENEW_GOLDEN")) std::ofstream(golden_file) << now;
    EXPECT_EQ(now, text_of(golden_file));
}

} // namespace
} // namespace sinew
