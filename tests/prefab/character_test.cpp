#include "sinew/prefab/bridge.h"
#include "sinew/prefab/rope.h"
#include "sinew/prefab/walk.h"
#include "sinew/snapshot/snapshot.h"
#include "sinew/world/colliders.h"
#include "sinew/world/environment.h"

#include "tests/worlds.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

/// Laws of a character that walks, jumps, rides, hangs and climbs.
namespace sinew::SINEW_TEST_FILE {
namespace {

using World2 = test::Stepped<2, double>;
using V2 = Vec<2, double>;
constexpr double dt = 1.0 / 60, g = 9.81;

struct Hero {
    World2 world;
    Character character{};
    FigureIndex figure = no_figure;
    Footing footing{};

    explicit Hero(V2 at = {}, double friction = 0.5) {
        test::fall(world, g);
        add_plane(world, {.normal = {{0, 1}}, .offset = 0, .friction = friction});
        enter(at);
    }
    void enter(V2 at) {
        figure = build(world, character, "hero", {.at = at});
        set_contact(world, figure, {.figures = true});
    }
    V2 place(const char* part) const { return *position_of(world, *world.figures[figure].particle_names.find(part)); }
    V2 velocity() const { return *velocity_of(world, *world.figures[figure].particle_names.find("feet")); }
    double soles() const { return place("feet")[1] - character.radius(); }
    double lean() const {
        const auto spine = place("head") - place("feet");
        return std::atan2(spine[0], spine[1]);
    }
    void step(const Controls& controls) {
        footing = walk(world, figure, character, controls, dt);
        test::step(world, dt);
    }
    void play(double seconds, const Controls& controls = {}) {
        for (int i = 0; i < int(std::lround(seconds / dt)); ++i) step(controls);
    }
};

ColliderId add_box(World2& world, V2 at, V2 half, double turn = 0) {
    return add_collider(world, collide::Collider<2, double>{
                                   .shape = collide::Box<2, double>{half * 2},
                                   .target = {.position = at, .rotation = collide::Rotation<2, double>::of(turn)},
                                   .friction = 0.5});
}

/// v(t) = min(a t, speed); the way of a second is speed - speed^2 / 2a, to a step.
TEST(Character, WalksAtItsSpeedUpright) {
    Hero hero;
    hero.play(0.2);
    hero.play(1, {.along = 1});
    const auto& c = hero.character;
    EXPECT_NEAR(hero.velocity()[0], c.speed, 0.02 * c.speed);
    EXPECT_NEAR(hero.place("feet")[0], c.speed - c.speed * c.speed / (2 * c.acceleration), 0.05 * c.speed);
    EXPECT_NEAR(hero.lean(), 0, 0.02);
    EXPECT_NEAR(hero.soles(), 0, 0.01);
    hero.play(0.5);
    EXPECT_NEAR(hero.velocity()[0], 0, 0.01);
}

/// Without legs a slope of 40 degrees would take it g sin(40) t^2 / 2, 12.6 m in two seconds; it stands to 2 cm.
TEST(Character, StandsOnASlopeAndSlidesOffASteepOne) {
    for (const double degrees : {40.0, 60.0}) {
        Hero hero(V2{{{-50, 50}}});
        const double angle = degrees * std::numbers::pi / 180;
        add_box(hero.world, {}, {{100, 1}}, angle);
        const double up = 1 / std::cos(angle), r = hero.character.radius();
        hero.world.bounds.clear();
        teleport(hero.world, hero.figure, V2{{{50, -50 + up + r / std::cos(angle) - r}}});
        hero.play(0.3);
        const auto from = hero.place("feet");
        hero.play(2);
        const double way = norm(hero.place("feet") - from);
        if (degrees < 50)
            EXPECT_LT(way, 0.02);
        else
            EXPECT_GT(way, 5);
        EXPECT_NEAR(hero.lean(), 0, 0.05);
    }
}

/// Up and down: the speed along the slope is that on level ground, and the feet do not leave it.
TEST(Character, WalksUpAndDownSlopesAtItsSpeed) {
    for (const double sign : {1.0, -1.0}) {
        Hero hero(V2{{{-50, 50}}});
        const double angle = 30 * std::numbers::pi / 180;
        add_box(hero.world, {}, {{100, 1}}, angle);
        const double up = 1 / std::cos(angle), r = hero.character.radius();
        hero.world.bounds.clear();
        teleport(hero.world, hero.figure, V2{{{50, -50 + up + r / std::cos(angle) - r}}});
        hero.play(0.3);
        hero.play(0.5, {.along = sign});
        const auto from = hero.place("feet");
        hero.play(1, {.along = sign});
        EXPECT_NEAR(norm(hero.place("feet") - from), hero.character.speed, 0.03 * hero.character.speed) << sign;
        EXPECT_TRUE(hero.footing.on_ground);
    }
}

/// h = v^2 / 2g, less what the discrete steps of gravity take: v g dt / 2.
TEST(Character, JumpsAsHighAsItSays) {
    Hero hero;
    hero.play(0.3);
    double highest = 0;
    hero.step({.jump = true});
    for (int i = 0; i < 90; ++i) hero.step({}), highest = std::max(highest, hero.soles());
    EXPECT_NEAR(highest, hero.character.jump_height, 0.05);
    EXPECT_NEAR(hero.soles(), 0, 0.01);
    EXPECT_TRUE(hero.footing.on_ground);
}

TEST(Character, DoesNotJumpInTheAir) {
    Hero hero(V2{{{0, 3}}});
    hero.play(0.3, {.jump = true});
    EXPECT_LT(hero.velocity()[1], -2);
    EXPECT_FALSE(hero.footing.on_ground);
}

TEST(Character, ClimbsStepsAndStopsAtWalls) {
    Hero hero;
    for (int i = 0; i < 5; ++i) add_box(hero.world, {{2.0 + 0.6 * i + 5, 0.15 * (i + 1) - 1}}, {{5, 1}});
    hero.play(0.2);
    hero.play(2.5, {.along = 1});
    EXPECT_GT(hero.place("feet")[0], 5);
    EXPECT_NEAR(hero.soles(), 0.75, 0.02);

    Hero other;
    add_box(other.world, {{2 + 5, 0.35 - 1}}, {{5, 1}});
    other.play(0.2);
    other.play(2.5, {.along = 1});
    EXPECT_NEAR(other.place("feet")[0], 2 - other.character.radius(), 0.03);
    EXPECT_NEAR(other.soles(), 0, 0.05);
}

/// A platform carries it without slip, to the sides and up and down; on it, its speed is relative.
TEST(Character, RidesPlatforms) {
    Hero hero(V2{{{0, 1}}});
    const auto platform = add_box(hero.world, {{0, 0.9}}, {{3, 0.1}});
    double time = 0;
    const auto ride = [&](double seconds, const Controls& controls) {
        for (int i = 0; i < int(std::lround(seconds / dt)); ++i) {
            time += dt;
            move_collider(hero.world, platform, {.position = {{1.5 * time, 0.9 + 0.3 * std::sin(2 * time)}}});
            hero.step(controls);
        }
    };
    ride(2, {});
    EXPECT_NEAR(hero.place("feet")[0], 1.5 * time, 0.03);
    EXPECT_NEAR(hero.soles(), 1 + 0.3 * std::sin(2 * time), 0.02);
    const double before = hero.place("feet")[0] - 1.5 * time;
    ride(0.5, {.along = -1});
    const auto& c = hero.character;
    EXPECT_NEAR(hero.place("feet")[0] - 1.5 * time - before, -0.5 * c.speed + c.speed * c.speed / (2 * c.acceleration),
                0.15);
}

/// The bridge feels the opposite of what accelerates the character: momentum along the bridge is that of the banks
/// alone, and the planks sag below it.
TEST(Character, WalksOverABridgeThatSags) {
    Hero hero(V2{{{-1, 0}}});
    hero.world.bounds.clear();
    add_box(hero.world, {{-3, -1}}, {{3, 1}});
    add_box(hero.world, {{7, -1}}, {{3, 1}});
    const auto bridge = build(hero.world, Bridge{.span = 4, .planks = 10, .mass = 60}, "bridge", {.at = {{0, -0.04}}});
    set_contact(hero.world, bridge, {.figures = true, .friction = 1});
    hero.play(0.5);
    double lowest = 0;
    for (int i = 0; i < 150; ++i) {
        hero.step({.along = 1});
        lowest = std::min(lowest, hero.soles());
    }
    EXPECT_GT(hero.place("feet")[0], 5);
    EXPECT_LT(lowest, -0.1);
    EXPECT_NEAR(hero.lean(), 0, 0.1);
}

struct Swinger : Hero {
    Swinger() : Hero(V2{{{0, 1}}}) {
        const auto rope = build(world, Rope{.length = 3, .segments = 15, .mass = 3}, "rope", {.at = {{0.2, 5}}});
        set_contact(world, rope, {});
    }
};

TEST(Character, HangsOnARopeUntilItLetsGo) {
    Swinger hero;
    hero.play(2, {.hold = true});
    EXPECT_TRUE(hero.footing.is_holding);
    EXPECT_GT(hero.soles(), 0.3);
    EXPECT_EQ(hero.world.figures[hero.footing.figure].name, "rope");
    hero.play(1);
    EXPECT_FALSE(hero.footing.is_holding);
    EXPECT_NEAR(hero.soles(), 0, 0.02);
}

/// Pushing with the swing, as on a swing, makes it larger; holding still keeps the period of a pendulum of that length
/// to a tenth.
TEST(Character, SwingsTheRopeUp) {
    Swinger hero;
    hero.play(1, {.hold = true});
    double widest = 0;
    for (int i = 0; i < 60 * 12; ++i) {
        const double speed = hero.velocity()[0];
        hero.step({.along = i < 30 ? 1.0 : speed > 0 ? 1.0 : -1.0, .hold = true});
        widest = std::max(widest, std::abs(hero.place("head")[0] - 0.2));
    }
    EXPECT_GT(widest, 1.5);
    EXPECT_TRUE(hero.footing.is_holding);
}

TEST(Character, ClimbsARopeUpAndDown) {
    Swinger hero;
    hero.play(1, {.hold = true});
    const double from = hero.place("head")[1];
    hero.play(1, {.up = 1, .hold = true});
    const double up = hero.place("head")[1];
    EXPECT_NEAR(up - from, hero.character.climb_speed, 0.5 * hero.character.climb_speed);
    hero.play(4, {.up = 1, .hold = true});
    EXPECT_GT(hero.place("head")[1], 4.3); // arms below the upper end
    EXPECT_LT(hero.place("head")[1], 5.01);
    hero.play(1, {.up = -1, .hold = true});
    EXPECT_LT(hero.place("head")[1], 4.3);
    EXPECT_TRUE(hero.footing.is_holding);
}

/// Rungs between two ropes.
TEST(Character, ClimbsALadderOfPlanks) {
    Hero hero(V2{{{0, 0}}});
    auto& world = hero.world;
    const auto ladder = add_figure(world, "ladder");
    std::vector<ParticleId> left, right;
    for (int i = 0; i < 13; ++i) {
        for (const double x : {-0.3, 0.3})
            (x < 0 ? left : right)
                .push_back(add_particle(world, {.position = {{x, 5 - 0.3 * i}}, .mass = 1, .figure = ladder}));
        world.figures[ladder].particles.push_back(left.back());
        world.figures[ladder].particles.push_back(right.back());
        add<Distance>(world, {left.back(), right.back()}, {.figure = ladder});
        if (i == 0) continue;
        add<Distance>(world, {left[std::size_t(i - 1)], left.back()}, {.limits = at_most(0.3), .figure = ladder});
        add<Distance>(world, {right[std::size_t(i - 1)], right.back()}, {.limits = at_most(0.3), .figure = ladder});
    }
    pin(world, left[0]), pin(world, right[0]);
    hero.play(0.5, {.hold = true});
    EXPECT_TRUE(hero.footing.is_holding);
    hero.play(6, {.up = 1, .hold = true});
    EXPECT_GT(hero.place("head")[1], 4.2);
    EXPECT_LT(std::abs(hero.place("head")[0]), 0.35);
    hero.play(6, {.up = -1, .hold = true});
    EXPECT_LT(hero.place("head")[1], 2.5);
}

/// Nothing but the world decides: a copy and a loaded snapshot go on with the same bits.
TEST(Character, GoesOnAlikeAfterASnapshot) {
    Swinger hero;
    const auto wish = [](int i) {
        return Controls{
            .along = i % 90 < 45 ? 1.0 : -1.0, .up = i > 200 ? 1.0 : 0.0, .jump = i % 70 == 0, .hold = i > 60};
    };
    for (int i = 0; i < 150; ++i) hero.step(wish(i));
    World<2, double> loaded;
    ASSERT_FALSE(restore(loaded, save(static_cast<const World<2, double>&>(hero.world))));
    Hero other = hero;
    other.world = World2(loaded);
    for (int i = 150; i < 300; ++i) {
        hero.step(wish(i)), other.step(wish(i));
        ASSERT_EQ(state_hash(hero.world), state_hash(other.world)) << i;
    }
}

TEST(Character, WrongNumbersDoNoHarm) {
    Hero hero;
    for (const double wrong : {std::nan(""), 1e300, -1e300, double(INFINITY)}) {
        hero.play(0.2, {.along = wrong, .up = wrong, .hold = true});
        EXPECT_TRUE(is_finite(hero.place("feet"))) << wrong;
    }
    EXPECT_FALSE(walk(hero.world, no_figure, hero.character, {}, dt).on_ground);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
