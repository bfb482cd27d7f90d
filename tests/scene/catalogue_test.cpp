#include "sinew/picture/draw.h"
#include "sinew/world/crossings.h"

#include "tests/paths.h"
#include "tests/sanitized.h"
#include "tests/scene/scene_runs.h"
#include "tests/stepped.h"

#include <cstdlib>
#include <limits>

/// Every file under scenes/, in both modes and precisions.
namespace sinew::SINEW_TEST_FILE {
namespace {

/// How many items have a point in the picture.
std::size_t items_on_screen(const Session& session) {
    Picture picture;
    picture.width = session.scene().view.size[0];
    picture.height = session.scene().view.size[1];
    draw(session, picture);
    return std::size_t(std::count_if(picture.items.begin(), picture.items.end(), [&](const Picture::Item& item) {
        const auto points = picture.points_of(item);
        return std::any_of(points.begin(), points.end(), [&](const auto& point) {
            return point[0] >= 0 && point[1] >= 0 && point[0] <= float(picture.width) &&
                   point[1] <= float(picture.height);
        });
    }));
}

/// Every scene in both modes and precisions; under the sanitizers a scene's modes have different precisions.
std::vector<SceneRun> watched_runs() {
    const auto all = runs(); // four of each scene
    std::vector<SceneRun> watched;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (const auto scene = i / 4, mode = i / 2, precision = i;
            !test::sanitized || (scene + mode + precision) % 2 == 0)
            watched.push_back(all[i]);
    return watched;
}

class CatalogueRun : public testing::TestWithParam<SceneRun> {};

/// Until then a fall does not count as motion, seconds.
constexpr double settled = 1;

TEST_P(CatalogueRun, RunsItsTimeWhole) {
    const auto& [name, mode, precision] = GetParam();
    auto session = open(name, mode, precision);
    ASSERT_TRUE(session);
    EXPECT_FALSE(session->scene().about.empty());
    EXPECT_FALSE(session->scene().source.empty());
    EXPECT_GT(items_on_screen(*session), 0U);

    const double size = min_size(*session, mode);
    double outside = 0;
    Travel travel(session->scene());
    const double whole = session->scene().seconds, end = test::sanitized ? std::min(0.3, whole) : whole;
    while (session->seconds() < end) {
        session->step();
        ASSERT_TRUE(is_finite(session->world())) << "after " << session->seconds() << " seconds";
        outside = std::max(outside, distance_outside(session->world(), size));
        if (session->seconds() > std::min(settled, whole / 4)) travel.see(session->world());
    }
    EXPECT_LE(outside, 1);
    if (end == whole) {
        EXPECT_GT(travel.share(), 0.05) << "nothing to see";
    }
    EXPECT_GT(items_on_screen(*session), 0U);
    for (const auto& happening : session->happenings()) EXPECT_NE(happening.what, "quarantined");
    if (mode == "physical" && end == whole) {
        EXPECT_LT(rigid_strain(session->world()), 0.01);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CatalogueRun, testing::ValuesIn(watched_runs()), name_of_run);

// As its description says.
TEST(Catalogue, NoPartOfTheFoldingClothGoesThroughAnother) {
    if (test::sanitized) GTEST_SKIP() << "takes a minute";
    auto session = open("folding_cloth", "physical", "double");
    for (int second = 1; second <= 5; ++second) {
        while (session->seconds() < second) session->step();
        std::visit([&](const auto& world) { EXPECT_EQ(count_crossings(world), 0U) << second; }, session->world());
    }
}

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
        {"chains", 0.6, 0.98 * 0.90, 1, 30 + 20 + 15 + 10 + 5 + 5 + 2, 30 + 20 + 15 + 10 + 5}, // 2: the ceiling's
        {"stick", 0, 0, 1, 2, 1},
        {"fixed_stick", 0, 0, 1, 2, 1},
        {"triangle", 0, 0, 1, 3, 3},
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

test::Stepped<2, double> classic_world(const std::string& name) {
    auto session = open(name, "classic");
    return session ? std::get<World<2, double>>(session->world()) : test::Stepped<2, double>{};
}

Vec2<double> place(const World<2, double>& world, std::string_view name) {
    return position_of(world, find_particle(world, name).value_or(ParticleId{})).value_or(Vec2<double>{});
}

TEST(Catalogue, BoxStandsWhereTheOriginalStood) {
    const auto world = classic_world("box");
    EXPECT_EQ(place(world, "box/top_left"), (Vec2<double>{{300, 300}}));
    EXPECT_EQ(place(world, "box/bottom_right"), (Vec2<double>{{350, 350}}));
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
    for (const double split : std::get<0>(world.constraints).split.rows()) EXPECT_EQ(split, 0);
}

TEST(Catalogue, SticksStartOnOneSpotAndPartToAHundredPixels) {
    for (const std::string name : {"stick", "fixed_stick", "triangle"}) {
        SCOPED_TRACE(name);
        auto session = open(name, "classic");
        ASSERT_TRUE(session);
        const auto& world = std::get<World<2, double>>(session->world());
        for (const auto& start : world.particles.position) EXPECT_EQ(start, (Vec2<double>{{240, 165}}));
        // A stick is as long as it should be in every frame; three together only once the pointer rests.
        session->run_until(name == "triangle" ? 8 : 1);
        EXPECT_LT(rigid_strain(session->world()), 1e-9);
        for (const double split : std::get<0>(world.constraints).split.rows())
            EXPECT_EQ(split, name == "fixed_stick" ? 1 : 0.5);
    }
}

TEST(Catalogue, ClothHasFiftyPixelCellsAndItsTopRowHeld) {
    const auto world = classic_world("cloth_wind");
    EXPECT_EQ(place(world, "cloth/particle_1_1") - place(world, "cloth/particle_0_0"), (Vec2<double>{{50, 50}}));
    EXPECT_EQ(place(world, "cloth/particle_0_0")[1], 50);
    EXPECT_EQ(world.pins.size(), 10U);
    const auto* push = std::get_if<RandomPush<2, double>>(&world.forces[1]);
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

const std::string golden_file = test::source_dir() + "/tests/golden/scenes.txt";

std::string golden_line(const SceneRun& run, Session& session) {
    session.run_until(2);
    const auto& [name, mode, precision] = run;
    return fmt::format("{} {} {} {:016x}\n", name, mode, precision, session.report().hash);
}

TEST(Catalogue, ScenesEndInTheSameBitsAsEver) {
    if (test::sanitized) GTEST_SKIP() << "see ASampleOfScenesToo";
    std::string now = "# State of every scene after two seconds. To renew this file, run the tests with "
                      "SINEW_RENEW_GOLDEN=1 in the environment.\n";
    for (const auto& run : runs())
        if (auto session = open(run.scene, run.mode, run.precision)) now += golden_line(run, *session);
    if (std::getenv("SINEW_RENEW_GOLDEN")) std::ofstream(golden_file) << now;
    EXPECT_EQ(now, text_of(golden_file));
}

// The sanitizers' build is another compiler's, with other optimizations: its bits are the same.
TEST(Catalogue, ASampleOfScenesToo) {
    const auto golden = text_of(golden_file);
    std::size_t number = 0;
    for (const auto& run : runs()) {
        if (number++ % 7 != 0) continue;
        auto session = open(run.scene, run.mode, run.precision);
        ASSERT_TRUE(session);
        if (session->report().particles > 300) continue; // takes too long
        const auto line = golden_line(run, *session);
        EXPECT_NE(golden.find(line), std::string::npos) << line;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
