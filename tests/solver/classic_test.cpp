#include "tests/stepped.h"
#include "tests/worlds.h"

/// Classic mode reproduces the originals' rules: the first frames by hand. Lengths in pixels, time in frames, y down.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

constexpr double tight = 1e-11; // coordinates near 500, rounded a few times a frame

test::Stepped<2, double> classic(ClassicRules<double> rules) {
    test::Stepped<2, double> world;
    world.settings.mode = Mode::classic;
    world.settings.frame = 1;
    world.settings.classic = rules;
    return world;
}

Vec2<double> position(const World<2, double>& world, ParticleId id) {
    return *position_of(world, id);
}

void expect_at(const World<2, double>& world, ParticleId id, double x, double y) {
    EXPECT_NEAR(position(world, id)[0], x, tight);
    EXPECT_NEAR(position(world, id)[1], y, tight);
}

/// y down: the floor at `bottom` pushes up, towards smaller y.
void room(test::Stepped<2, double>& world, double right, double bottom) {
    world.bounds = {{{0, -1}, -bottom, 0, 0}, {{0, 1}, 0, 0, 0}, {{1, 0}, 0, 0, 0}, {{-1, 0}, -right, 0, 0}};
}

// Roblox: (v + f) * 0.99.  Frame 1: (0 + 0.1) 0.99 = 0.099; frame 2: (0.099 + 0.1) 0.99 = 0.19701.
TEST(Classic, RobloxDampsAfterTheForce) {
    auto world = classic({.keep = 0.99, .damp_after_force = true});
    world.forces = {Gravity<2, double>{{0, 0.1}}};
    const auto p = add_particle(world, {.position = {300, 300}});
    step(world, 1.0);
    expect_at(world, p, 300, 300.099);
    step(world, 1.0);
    expect_at(world, p, 300, 300.099 + 0.19701);
}

// Godot: v * 0.98 * 0.90, then gravity 0.6.  v1 = 0.6, v2 = 0.6 * 0.882 + 0.6 = 1.1292.
TEST(Classic, GodotDampsBeforeTheForce) {
    auto world = classic({.keep = 0.98 * 0.90});
    world.forces = {Gravity<2, double>{{0, 0.6}}};
    const auto p = add_particle(world, {.position = {100, 12}});
    step(world, 1.0);
    expect_at(world, p, 100, 12.6);
    step(world, 1.0);
    expect_at(world, p, 100, 12.6 + 1.1292);
}

// The Roblox box, 50 x 50 at (300, 300): free, it falls as one point would, for its sticks have nothing to do.
TEST(Classic, RobloxBoxFallsAsAPoint) {
    auto world = classic({.passes = 6, .keep = 0.99, .damp_after_force = true, .bounce = 0.8});
    world.forces = {Gravity<2, double>{{0, 0.1}}};
    room(world, 640, 480);
    std::vector<ParticleId> p;
    for (const auto& [x, y] : {std::pair{300, 300}, {350, 300}, {350, 350}, {300, 350}})
        p.push_back(add_particle(world, {.position = {double(x), double(y)}}));
    for (int i = 0; i < 4; ++i) add<Distance>(world, {p[std::size_t(i)], p[std::size_t((i + 1) % 4)]});
    add<Distance>(world, {p[0], p[2]});
    double y = 300, v = 0;
    for (int frame = 0; frame < 20; ++frame) {
        step(world, 1.0);
        v = (v + 0.1) * 0.99;
        y += v;
        expect_at(world, p[0], 300, y);
        expect_at(world, p[2], 350, y + 50);
    }
}

// At the floor the point is put back on it and x_prev mirrored: it leaves with 0.8 of the speed it came with.
//     y = 479, v = 3, no gravity: 482 is 2 through; back to 480 with v = -2.4, so next 477.6, 475.2.
TEST(Classic, RobloxBoxBouncesWithItsFactor) {
    auto world = classic({.bounce = 0.8});
    room(world, 640, 480);
    const auto p = add_particle(world, {.position = {300, 479}, .previous = Vec2<double>{299, 476}});
    step(world, 1.0);
    expect_at(world, p, 301, 480);
    step(world, 1.0);
    expect_at(world, p, 302, 477.6);
    step(world, 1.0);
    expect_at(world, p, 303, 475.2);
}

// Flash: rest 100; both ends start on (240, 165). atan2(0, 0) = 0, an error of -100: the first goes to 165 + 50, the
// second to 165 - 50. The end that takes no share of the error stays.
TEST(Classic, FlashStickPartsFromOnePointAlongY) {
    for (const auto& [split, first, second] :
         {std::tuple{0.5, 215.0, 115.0}, {1.0, 265.0, 165.0}, {0.0, 165.0, 65.0}}) {
        auto world = classic({});
        const auto a = add_particle(world, {.position = {240, 165}}), b = add_particle(world, {.position = {240, 165}});
        add<Distance>(world, {a, b}, {.limits = exactly(100.0), .split = split});
        step(world, 1.0);
        expect_at(world, a, 240, first);
        expect_at(world, b, 240, second);
    }
}

// s = 0 x 100^2 / (0 + 100^2) - 1/2 times a difference of 0: without a square root nothing parts them.
TEST(Classic, RootFreeSticksNeverPart) {
    auto world = classic({.root_free = true});
    const auto a = add_particle(world, {.position = {240, 165}}), b = add_particle(world, {.position = {240, 165}});
    add<Distance>(world, {a, b}, {.limits = exactly(100.0)});
    step(world, 1.0);
    expect_at(world, a, 240, 165);
    expect_at(world, b, 240, 165);
}

// Split 0.5: ends at 0 and 130, rest 100: each takes 15. Split 1: the first end takes all 30; split 0: the second.
TEST(Classic, FlashStickSplitsTheError) {
    for (const auto& [split, left, right] : {std::tuple{0.5, 15.0, 115.0}, {1.0, 30.0, 130.0}, {0.0, 0.0, 100.0}}) {
        auto world = classic({});
        const auto a = add_particle(world, {}), b = add_particle(world, {.position = {130, 0}});
        add<Distance>(world, {a, b}, {.limits = exactly(100.0), .split = split});
        step(world, 1.0);
        expect_at(world, a, left, 0);
        expect_at(world, b, right, 0);
    }
}

// The end that the mouse holds takes no correction, and the other still only its own half: 130 -> 115 -> 107.5.
TEST(Classic, AHeldEndLeavesItsShareUndone) {
    auto world = classic({.passes = 2, .keep = 0});
    const auto a = add_particle(world, {}), b = add_particle(world, {.position = {130, 0}});
    add<Distance>(world, {a, b}, {.limits = exactly(100.0)});
    pin(world, a);
    step(world, 1.0);
    expect_at(world, a, 0, 0);
    expect_at(world, b, 107.5, 0);
}

// While the mouse holds a point: x_prev = x, x = mouse; let go, it flies on with the mouse's last motion.
TEST(Classic, AHeldPointIsNotIntegratedAndInheritsTheMousesMotion) {
    for (const double compliance : {0.0, 1e-3}) { // the originals know no soft grab
        auto world = classic({});
        world.forces = {Gravity<2, double>{{0, 5}}};
        const auto p = add_particle(world, {.position = {10, 10}});
        const auto mouse = *pin(world, p, {.compliance = compliance});
        move_pin(world, mouse, {20, 10});
        step(world, 1.0);
        expect_at(world, p, 20, 10);
        move_pin(world, mouse, {33, 11});
        step(world, 1.0);
        expect_at(world, p, 33, 11);
        unpin(world, mouse);
        step(world, 1.0);
        expect_at(world, p, 46, 17);
    }
}

// Godot's chain, three loops 26 apart under gravity 0.6, top held, one pass from the top down, the child takes all:
// both loops fall 0.6; the first is pulled back to 26 below the top, the second to 26 below the first.
TEST(Classic, GodotChainIsRepairedFromTheTopDown) {
    auto world = classic({.keep = 0.98 * 0.90});
    world.forces = {Gravity<2, double>{{0, 0.6}}};
    std::vector<ParticleId> p;
    for (int i = 0; i < 3; ++i) p.push_back(add_particle(world, {.position = {100, 12 + 26.0 * i}}));
    for (std::size_t i = 0; i < 2; ++i) add<Distance>(world, {p[i], p[i + 1]}, {.split = 0});
    pin(world, p[0]);
    step(world, 1.0);
    expect_at(world, p[1], 100, 38);
    expect_at(world, p[2], 100, 64);

    // the last loop is thrown sideways: (10, 0) from (100, 64), then falls 0.6 and is drawn back along its link
    set_velocity(world, p[2], {10, 0});
    step(world, 1.0);
    const Vec2<double> thrown{100 + 10 * 0.882, 64.6}, below = thrown - Vec2<double>{100, 38};
    const auto expected = Vec2<double>{100, 38} + below * (26 / norm(below));
    expect_at(world, p[2], expected[0], expected[1]);
}

// GameMaker: each end takes 0.3 of the error (relaxation 0.6 split evenly), three passes: 0.4^3 of it is left.
TEST(Classic, GameMakerRelaxesInThreePasses) {
    auto world = classic({.passes = 3});
    const auto a = add_particle(world, {}), b = add_particle(world, {.position = {140, 0}});
    add<Distance>(world, {a, b}, {.limits = exactly(40.0), .relaxation = 0.6});
    step(world, 1.0);
    EXPECT_NEAR(distance(position(world, a), position(world, b)), 40 + 100 * 0.064, 1e-10);
}

// GameMaker's step at time scale 2: acceleration 0.5 grows by 2^2, inertia (1 px) does not grow: 1 + 2 = 3.
// Scaled properly, the inertia would be of a step twice as long: 2 + 2 = 4.
TEST(Classic, GameMakersInertiaIsNotScaledWithTheStep) {
    for (const bool bug : {true, false}) {
        auto world = classic({.time_scale = 2, .unscaled_inertia = bug});
        world.forces = {Gravity<2, double>{{0, 0.5}}};
        const auto p = add_particle(world, {.previous = Vec2<double>{0, -1}});
        step(world, 1.0);
        expect_at(world, p, 0, bug ? 3 : 4);
    }
}

// Its drag is an acceleration, c (x - x_prev), times the square of the step: 1 of a way of 2, a quarter of which at
// half the time scale. Scaled properly, the way is 1, and the drag takes a quarter of that.
TEST(Classic, GameMakersDragIsAnAccelerationOfTheWayOfAFrame) {
    for (const bool bug : {true, false}) {
        auto world = classic({.time_scale = 0.5, .unscaled_inertia = bug});
        const auto p = add_particle(world, {.previous = Vec2<double>{0, -2}});
        pin(world, p, {.target = Vec2<double>{}, .steer_damping = 0.5});
        step(world, 1.0);
        expect_at(world, p, 0, bug ? 1.75 : 0.75);
    }
}

// step = min(dt * 60, 4) * time_scale: a stall of a minute counts as four frames.
TEST(Classic, AStallIsNeverMoreThanTheLongestStep) {
    auto world = classic({.unscaled_inertia = true});
    world.forces = {Gravity<2, double>{{0, 1}}};
    const auto p = add_particle(world, {});
    step(world, 3600.0);
    expect_at(world, p, 0, 16);
}

TEST(Classic, StoppedTimeKeepsTheSpeedForLater) {
    auto world = classic({});
    const auto p = add_particle(world, {.velocity = {3, 0}});
    step(world, 1.0);
    world.settings.classic.time_scale = 0;
    step(world, 1.0);
    expect_at(world, p, 3, 0);
    world.settings.classic.time_scale = 1;
    step(world, 1.0);
    expect_at(world, p, 6, 0);
}

// Godot's boxes: bounce 0.9; friction 0.90 along the floor only while resting on it.
//     Resting: v = (5, 0) and gravity 0.2 presses it on: next frame 5 * 0.98, then (5 * 0.98 * 0.9) * 0.98.
TEST(Classic, GodotBoxesRubOnlyWhileResting) {
    auto world = classic({.order = PassOrder::walls_each_pass, .keep = 0.98, .bounce = 0.9, .floor_keep = 0.9});
    world.forces = {Gravity<2, double>{{0, 0.2}}};
    room(world, 1000, 480);
    const auto resting = add_particle(world, {.position = {100, 480}, .velocity = {5, 0}});
    const auto striking = add_particle(world, {.position = {100, 470}, .velocity = {5, 20}});
    step(world, 1.0);
    expect_at(world, resting, 104.9, 480);
    expect_at(world, striking, 104.9, 480);
    step(world, 1.0);
    expect_at(world, resting, 104.9 + 4.9 * 0.9 * 0.98, 480);
    // struck with 20 * 0.98 + 0.2 = 19.8, left with 0.9 of it, sideways undiminished
    expect_at(world, striking, 104.9 + 4.9 * 0.98, 480 - 19.8 * 0.9 * 0.98 + 0.2);
}

// The OpenGL article only clamps: x_prev stays, so the point sticks to the wall and falls along it.
TEST(Classic, OpenGlOnlyClamps) {
    auto world = classic({});
    world.bounds = {{{-1, 0}, -450, 0, 0}};
    const auto p = add_particle(world, {.position = {448, 100}, .velocity = {5, 1}});
    step(world, 1.0);
    expect_at(world, p, 450, 101);
    EXPECT_EQ(world.particles.previous[0], (Vec2<double>{448, 100}));
}

// Jakobsen's sqrt-free stick: d = 120, r = 100: s = 10000 / (14400 + 10000) - 1/2 = -0.0901639; each end moves 120 s.
TEST(Classic, SticksWithoutASquareRoot) {
    auto world = classic({.root_free = true});
    const auto a = add_particle(world, {}), b = add_particle(world, {.position = {120, 0}});
    add<Distance>(world, {a, b}, {.limits = exactly(100.0)});
    step(world, 1.0);
    const double s = 10000.0 / 24400 - 0.5;
    expect_at(world, a, -120 * s, 0);
    expect_at(world, b, 120 + 120 * s, 0);
}

// Three orders on two points, the right one flying through the wall at x = 100; rest 10.
//     move: b = 98 + 6 = 104.
//     sweeps last:     walls 100, then the stick: a = 88 + 1 = 89, b = 99.
//     walls each pass: stick first: gap 16 -> a = 91, b = 101; walls: b = 100; again: gap 9 -> a 90.5, b 100.5 -> 100.
TEST(Classic, OrderOfPassesIsTheOriginals) {
    for (const auto& [order, passes, left, right] :
         {std::tuple{PassOrder::sweeps_last, 1, 89.0, 99.0}, {PassOrder::walls_each_pass, 2, 90.5, 100.0}}) {
        auto world = classic({.passes = passes, .order = order});
        world.bounds = {{{-1, 0}, -100, 0, 0}};
        const auto a = add_particle(world, {.position = {88, 0}});
        const auto b = add_particle(world, {.position = {98, 0}, .velocity = {6, 0}});
        add<Distance>(world, {a, b}, {.limits = exactly(10.0)});
        step(world, 1.0);
        expect_at(world, a, left, 0);
        expect_at(world, b, right, 0);
    }
}

// Roblox: b moves to 104; the stick first, gap 16: a = 91, b = 101; gap 10: nothing; then the wall: b = 100.
TEST(Classic, RobloxWallsComeLast) {
    auto world = classic({.passes = 2, .order = PassOrder::walls_last});
    world.bounds = {{{-1, 0}, -100, 0, 0}};
    const auto a = add_particle(world, {.position = {88, 0}});
    const auto b = add_particle(world, {.position = {98, 0}, .velocity = {6, 0}});
    add<Distance>(world, {a, b}, {.limits = exactly(10.0)});
    step(world, 1.0);
    expect_at(world, a, 91, 0);
    expect_at(world, b, 100, 0);
}

// A reader of the Roblox article: two passes of (points, segments), then the walls.
//     a 0, b 10 + 4 = 14: a 2, b 12. a_prev = 0: a 4, b_prev = 10: b 14: nothing to do. The wall at 13: b = 13.
TEST(Classic, RobloxReaderRepeatsPointsAndSegments) {
    auto world = classic({.passes = 2, .order = PassOrder::walls_last, .moves_each_pass = true});
    world.bounds = {{{-1, 0}, -13, 0, 0}};
    const auto a = add_particle(world, {}), b = add_particle(world, {.position = {10, 0}, .velocity = {4, 0}});
    add<Distance>(world, {a, b});
    step(world, 1.0);
    expect_at(world, a, 4, 0);
    expect_at(world, b, 13, 0);
}

// A force acts once a frame, however often the points are moved: 6 px in the first move, kept in the second.
TEST(Classic, AForceActsInOneMoveOfAFrame) {
    auto world = classic({.passes = 2, .points_only_passes = true});
    const auto p = add_particle(world, {});
    apply_force(world, p, {6, 0});
    step(world, 1.0);
    expect_at(world, p, 12, 0);
}

// The originals turn a speed round whichever way it goes. The stick puts b outside though it moves inward: x_prev =
// 120, x = 112 is drawn to 106; put back on 100, it gets 0.5 (106 - 120) = -7 outward.
TEST(Classic, WallsTurnEvenAnInwardSpeedRound) {
    auto world = classic({.order = PassOrder::walls_last, .bounce = 0.5});
    world.bounds = {{{-1, 0}, -100, 0, 0}};
    const auto a = add_particle(world, {.position = {90, 0}});
    const auto b = add_particle(world, {.position = {120, 0}, .previous = Vec2<double>{128, 0}});
    add<Distance>(world, {a, b}, {.limits = exactly(10.0)});
    step(world, 1.0); // a 96, b 106
    EXPECT_NEAR(position(world, b)[0], 100, tight);
    EXPECT_NEAR(world.particles.previous[1][0], 100 - 7, tight);
}

/// Two ends of a stick of 100; the first is held by a rule and carried to (40, 0) in the next step.
struct HeldStick {
    test::Stepped<2, double> world = classic({.keep = 0.5});
    ParticleId first = add_particle(world, {.position = {10, 0}, .previous = Vec2<double>{6, 0}});
    ParticleId second = add_particle(world, {.position = {110, 0}});

    explicit HeldStick(Hold hold) {
        add<Distance>(world, {first, second}, {.limits = exactly(100.0)});
        move_pin(world, *pin(world, first, {.hold = hold}), {40, 0});
        step(world, 1.0);
    }
};

// fixed:      40 stays, and with it half of the error of 30: second 110 + 15.
// corrected:  40 takes its half too: 25 and 125.
// integrated: x_prev = 6: 40 + (40 - 6)/2 = 57, error 47: 33.5 and 133.5.
// displaced:  x_prev = 10: 40 + (40 - 10)/2 = 55, error 45: 32.5 and 132.5.
// frozen:     10 is neither set nor moved: 10 and 110.
TEST(Classic, HoldsAPointByEachRule) {
    for (const auto& [hold, first, second, previous] : {std::tuple{Hold::fixed, 40.0, 125.0, 10.0},
                                                        {Hold::corrected, 25.0, 125.0, 10.0},
                                                        {Hold::integrated, 33.5, 133.5, 40.0},
                                                        {Hold::displaced, 32.5, 132.5, 40.0},
                                                        {Hold::frozen, 10.0, 110.0, 6.0}}) {
        const HeldStick held(hold);
        EXPECT_NEAR(position(held.world, held.first)[0], first, tight) << int(hold);
        EXPECT_NEAR(position(held.world, held.second)[0], second, tight) << int(hold);
        EXPECT_NEAR(held.world.particles.previous[0][0], previous, tight) << int(hold);
    }
}

// GameMaker's hand: a = 0.05 (100 - 10, 20 - 0) - 0.1 (4, 0) = (4.1, 1); x = 10 + 4 + 4.1. Gravity does not reach it.
TEST(Classic, AHandIsAcceleratedTowardsItsTarget) {
    auto world = classic({});
    world.forces = {Gravity<2, double>{{0, 0.5}}};
    const auto p = add_particle(world, {.position = {10, 0}, .previous = Vec2<double>{6, 0}});
    pin(world, p, {.target = Vec2<double>{100, 20}, .steer = {0.05, 0.05}, .steer_damping = 0.1});
    step(world, 1.0);
    expect_at(world, p, 18.1, 1);
}

// An anchor that a prefab pinned and a driver moves: its speed is its way of the frame, not that from where it rests.
TEST(Classic, APointWithTwoPinsHasTheSpeedOfTheLast) {
    auto world = classic({});
    const auto p = add_particle(world, {.position = {100, 0}});
    pin(world, p);
    const auto driver = *pin(world, p);
    for (int frame = 1; frame <= 20; ++frame) {
        move_pin(world, driver, {100.0 + 3 * frame, 0});
        step(world, 1.0);
    }
    expect_at(world, p, 160, 0);
    EXPECT_NEAR((*velocity_of(world, p))[0], 3, tight);
}

// The known bugs, each off unless asked for.
TEST(Classic, RobloxTopAndRightWallsKeepTheOutwardSpeedWhenAskedTo) {
    for (const bool bug : {true, false}) {
        auto world = classic({.bounce = 0.5, .outward_bounce = bug});
        world.forces = {Gravity<2, double>{{0, 1e-9}}}; // tells top from bottom
        room(world, 640, 480);
        const auto right = add_particle(world, {.position = {639, 240}, .velocity = {4, 0}});
        const auto left = add_particle(world, {.position = {1, 240}, .velocity = {-4, 0}});
        const auto top = add_particle(world, {.position = {320, 1}, .velocity = {0, -4}});
        const auto bottom = add_particle(world, {.position = {320, 479}, .velocity = {0, 4}});
        step(world, 1.0);
        EXPECT_NEAR((*velocity_of(world, right))[0], bug ? 2 : -2, 1e-6);
        EXPECT_NEAR((*velocity_of(world, left))[0], 2, 1e-6);
        EXPECT_NEAR((*velocity_of(world, top))[1], bug ? -2 : 2, 1e-6);
        EXPECT_NEAR((*velocity_of(world, bottom))[1], -2, 1e-6);
    }
}

// Six passes move the points six times and the segments once.
TEST(Classic, RobloxLoopRunsThePointsOnlyWhenAskedTo) {
    auto world = classic({.passes = 6, .points_only_passes = true});
    const auto a = add_particle(world, {.velocity = {1, 0}}), b = add_particle(world, {.position = {10, 0}});
    add<Distance>(world, {a, b}, {.limits = exactly(10.0), .relaxation = 0.5});
    step(world, 1.0);
    expect_at(world, a, 6 - 1.5, 0); // gap 4, 6 short, half of it shared by two
    expect_at(world, b, 11.5, 0);
}

TEST(Classic, TearableClothHalvesTheGravityWhenAskedTo) {
    auto world = classic({.halved_acceleration = true});
    world.forces = {Gravity<2, double>{{0, 10}}};
    const auto p = add_particle(world, {});
    step(world, 1.0);
    expect_at(world, p, 0, 5);
}

// At 60 frames a second a step of 0.96 frames each; at 120 half a frame holds no step, and nothing moves.
TEST(Classic, TearableClothDropsWhatIsLeftOfAFrameWhenAskedTo) {
    auto world = classic({.dropped_leftover = true});
    const auto p = add_particle(world, {.velocity = {1, 0}});
    for (int frame = 0; frame < 10; ++frame) step(world, 1.0);
    EXPECT_NEAR(position(world, p)[0], 9.6, tight);
    for (int half_frame = 0; half_frame < 10; ++half_frame) step(world, 0.5);
    EXPECT_NEAR(position(world, p)[0], 9.6, tight);
    step(world, 2.0); // two steps of 0.96 and 0.08 that are lost
    EXPECT_NEAR(position(world, p)[0], 9.6 + 1.92, tight);
}

// The OpenGL article's projectile: x_prev = (0, 0), x = (1, 1), a = (0, -10): x = 1 + n, y = 1 + n - 10 n (n + 1) / 2.
TEST(Classic, ProjectileLeavesAtFortyFiveDegreesOnAParabola) {
    auto world = classic({});
    world.forces = {Gravity<2, double>{{0, -10}}};
    const auto p = add_particle(world, {.position = {1, 1}, .previous = Vec2<double>{0, 0}});
    for (int n = 1; n <= 100; ++n) {
        step(world, 1.0);
        EXPECT_EQ(position(world, p), (Vec2<double>{1.0 + n, 1 + n - 5.0 * n * (n + 1)}));
    }
}

// A projectile keeps its course through any change of mode, and that is the parabola: each takes over the mean velocity
// of the step before, and adds what it gains from the middle of that to the middle of its own.
TEST(Classic, ModesHandOverWithoutAJolt) {
    test::Stepped<2, double> world;
    fall(world, gravity);
    const auto p = add_particle(world, {.velocity = {3, 4}});
    for (int i = 1; i <= 60; ++i) {
        world.settings.mode = i % 7 > 4 ? Mode::classic : Mode::physical;
        const auto before = position(world, p);
        step(world, 1.0 / 60);
        const double t = i / 60.0;
        ASSERT_NEAR(position(world, p)[0], 3 * t, 1e-12);
        ASSERT_NEAR(position(world, p)[1], 4 * t - gravity * t * t / 2, 1e-12);
        EXPECT_EQ(world.particles.previous[0], before);
    }
}

TEST(Classic, SpeedSetBeforeTheFirstStepIsInLengthsPerTimeUnit) {
    auto world = classic({});
    world.settings.frame = 1.0 / 60;
    const auto p = add_particle(world, {});
    set_velocity(world, p, {6, 0});
    step(world, 1.0 / 60);
    expect_at(world, p, 0.1, 0);
    step(world, 1.0 / 30);
    expect_at(world, p, 0.3, 0);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
