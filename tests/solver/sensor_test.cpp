#include "sinew/world/colliders.h"
#include "sinew/world/query.h"

#include "tests/crates.h"
#include "tests/worlds.h"

#include <algorithm>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

/// Begins and ends of touches of any particle of the world, figure by figure.
struct Passage {
    int begins = 0, ends = 0;
    bool is_touched = false;

    template <class World> void look(const World& world) {
        const bool now = !world.contacts.touching.empty();
        begins += now && !is_touched, ends += !now && is_touched;
        is_touched = now;
    }
};

template <class Real>
std::vector<ParticleId> add_passing_crate(FlatWorld<Real>& world, double x, double size, double speed) {
    const auto crate = add_crate(world, x, 0, size, 1);
    set_contact(world, 0, {});
    for (const auto id : crate) set_velocity(world, id, {{Real(speed), 0}});
    return crate;
}

// A body touches a sensor from its first side to its last one, with all that is between: wherever it passes, however
// small the sensor, and whatever the figure touches else.
TEST(Sensor, InsideACrateBeginsOnceAndEndsOnce) {
    for (const double radius : {0.01, 0.05, 0.5})
        for (const double y : {0.0, 0.3, -0.45}) {
            FlatWorld<double> world;
            add_passing_crate(world, -3, 2, 2);
            add_collider(world, collide::Collider<2, double>{.shape = collide::Sphere<2, double>{radius},
                                                             .target = {{{0, y}}, {}},
                                                             .is_sensor = true});
            Passage passage;
            for (int i = 0; i < 240; ++i) step(world, 1.0 / 60), passage.look(world);
            EXPECT_EQ(passage.begins, 1) << radius << " " << y;
            EXPECT_EQ(passage.ends, 1) << radius << " " << y;
        }
}

TEST(Sensor, BesideACrateIsNotTouched) {
    FlatWorld<double> world;
    add_passing_crate(world, -3, 2, 2);
    add_collider(world, collide::Collider<2, double>{
                            .shape = collide::Sphere<2, double>{0.1}, .target = {{{0, 1.2}}, {}}, .is_sensor = true});
    Passage passage;
    for (int i = 0; i < 240; ++i) step(world, 1.0 / 60), passage.look(world);
    EXPECT_EQ(passage.begins, 0);
}

// A ray meets the side of a crate where it is drawn, and not its corners alone.
TEST(Ray, MeetsTheSideOfACrate) {
    FlatWorld<double> world;
    add_crate(world, 0, 0, 2, 1);
    for (const double y : {-0.7, 0.0, 0.5}) {
        const auto hit = cast_ray<2, double>(world, {{-5, y}}, {{10, 0}});
        ASSERT_TRUE(hit) << y;
        EXPECT_NEAR(hit->point[0], -1, 1e-9);
        EXPECT_NEAR(hit->normal[0], -1, 1e-9);
        EXPECT_EQ(hit->figure, 0U);
        EXPECT_TRUE(hit->line_end.has_value());
    }
    EXPECT_FALSE((cast_ray<2, double>(world, {{-5, 1.1}}, {{10, 0}})));
}

TEST(Overlap, OfWhatACrateEncloses) {
    FlatWorld<double> world;
    add_crate(world, 0, 0, 2, 1);
    const collide::Shape<2, double> coin = collide::Sphere<2, double>{0.05};
    EXPECT_EQ(overlapping_figures(world, coin, {{{0.2, 0.1}}, {}}), std::vector<FigureIndex>{0});
    EXPECT_EQ(overlapping_figures(world, coin, {{{1.02, 0.1}}, {}}), std::vector<FigureIndex>{0});
    EXPECT_TRUE(overlapping_figures(world, coin, {{{1.2, 0.1}}, {}}).empty());
}

// A ball thrown up is slow at the top, and falls all the same; so does a crate.
TEST(Sleep, NeverComesInMidAir) {
    for (const double speed : {0.3, 1.0, 3.0})
        for (const double delay : {0.0, 0.1, 0.5}) {
            FlatWorld<double> world;
            add_ground(world);
            world.settings.sleep = {speed, delay};
            const auto ball = add_particle(world, {.position = {{-3, 1}}, .velocity = {{0, 5}}, .radius = 0.1});
            const auto crate = add_crate(world, 3, 1, 1, 1);
            for (const auto id : crate) set_velocity(world, id, {{0, 5}});
            run(world, 4);
            EXPECT_NEAR((*position_of(world, ball))[1], 0.1, 1e-3) << speed << " " << delay;
            EXPECT_NEAR(middle_of(world, crate)[1], 0.5, 1e-2) << speed << " " << delay;
        }
}

// A rod of one link lies on a post between its ends, with the figure's flag and without it.
TEST(Rod, IsCaughtByAPost) {
    for (const bool touches : {true, false})
        for (const double height : {0.3, 1.0, 3.0}) {
            FlatWorld<double> world;
            fall(world, 9.81);
            add_collider(world, collide::Collider<2, double>{.shape = collide::Sphere<2, double>{0.1}});
            const auto figure = add_touching(world, 0.5);
            if (!touches) set_contact(world, figure, {});
            std::vector<ParticleId> ends;
            for (const double x : {-0.5, 0.5})
                ends.push_back(add_particle(world, {.position = {{x, height}}, .radius = 0.02, .figure = figure}));
            add<Distance>(world, {ends[0], ends[1]}, {.figure = figure});
            world.figures[figure].particles = ends;
            world.figures[figure].pieces.push_back({.mark = Mark::stroke, .particles = {ends[0], ends[1]}});
            run(world, std::sqrt(2 * height / 9.81) + 0.2);
            EXPECT_GT(middle_of(world, ends)[1], 0.1) << touches << " " << height;
        }
}

// A belt brings what lies on it to its speed, by friction: v = mu g t until then.
TEST(Belt, CarriesABallAndACrate) {
    for (const double speed : {1.0, -2.0}) {
        FlatWorld<double> world;
        fall(world, 10);
        add_collider(world, collide::Collider<2, double>{.shape = collide::Box<2, double>{{{100, 1}}},
                                                         .target = {{{0, -0.5}}, {}},
                                                         .friction = 0.5,
                                                         .surface_velocity = {{speed, 0}}});
        const auto ball = add_particle(world, {.position = {{-3, 0.1}}, .radius = 0.1, .rolls = Rolls::never});
        const auto disc = add_particle(world, {.position = {{-6, 0.1}}, .radius = 0.1});
        const auto crate = add_crate(world, 3, 0.5, 1, 1);
        run(world, 0.1);
        EXPECT_NEAR((*velocity_of(world, ball))[0], speed > 0 ? 0.5 : -0.5, 0.03);
        run(world, 1);
        EXPECT_NEAR((*velocity_of(world, ball))[0], speed, 1e-3);
        EXPECT_NEAR((*velocity_of(world, disc))[0], speed / 3, 1e-3) << "half of m r^2 turns";
        EXPECT_NEAR((*velocity_of(world, crate[0]))[0], speed, 1e-2);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
