#include "sinew/prefab/prefabs.h"

#include "tests/stepped.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <algorithm>
#include <cmath>

/// Figures that are joined by hand: loads on cloth, jelly on ropes, ragdolls with cloth. Undamped, 16 substeps; bounds
/// are what was measured in 6 s with a little room (docs/measured/joined.md).
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <int D> struct Scene {
    using Vector = Vec<D, double>;
    test::Stepped<D, double> world;

    Scene() {
        fall(world, gravity);
        world.settings.substeps = 16;
    }
    ParticleId id(const std::string& name) const { return *find_particle(world, name); }
    Vector position(ParticleId particle) const { return *position_of(world, particle); }
    void join(ParticleId a, ParticleId b) {
        add<Distance>(world, {a, b}, {.limits = at_most(distance(position(a), position(b)))});
    }
    /// Returns its end.
    ParticleId rope(double length, int pieces) {
        build(world, Rope{.length = length, .segments = pieces, .angle = 0, .pinned = "start", .mass = 0.2}, "rope",
              {});
        return id("rope/end");
    }
    void cloth(const char* pins, double mass, const Placement<D, double>& at = {}) {
        build(world, Cloth{.columns = 16, .rows = 16, .spacing = 1.0 / 15, .pins = pins, .mass = mass}, "cloth", at);
    }
    /// A bead of so much, so far below a particle.
    ParticleId hang(ParticleId on, double mass, double length) {
        const auto bead = add_particle(world, {.position = position(on) - at<Vector>(0, length), .mass = mass});
        join(on, bead);
        return bead;
    }
};

struct Worst {
    double stretch = 0, gain = 0, last_speed = 0;
};

/// Over so many seconds; the gain as a part of weight times metres.
template <int D> Worst watch(Scene<D>& scene, double seconds, double metres) {
    Worst worst;
    auto& world = scene.world;
    const double put_in = energy(world).total(), scale = total_mass(world) * gravity * metres;
    for (int frame = 0; frame < int(60 * seconds); ++frame) {
        step(world, 1.0 / 60);
        worst.stretch = std::max(worst.stretch, double(stretch(world).max));
        worst.gain = std::max(worst.gain, (energy(world).total() - put_in) / scale);
    }
    worst.last_speed = max_speed(world);
    return worst;
}

constexpr double any = 1e3; // speed of what swings

void expect(const Worst& worst, double stretch, double speed, const char* what) {
    EXPECT_LE(worst.stretch, stretch) << what;
    EXPECT_LE(worst.gain, 1e-6) << what;
    EXPECT_LE(worst.last_speed, sanitized ? any : speed) << what;
}

TEST(JoinedFigures, AJellyRestsOnARope) {
    for (const auto& [mass, pieces] : {std::pair(2.0, 50), std::pair(20.0, 14), std::pair(100.0, 14)}) {
        Scene<2> scene;
        const auto end = scene.rope(1.1, pieces);
        const Polygon jelly{.sides = 9, .radius = 0.2, .braced = "area", .mass = mass};
        build(scene.world, jelly, "jelly", {.at = scene.position(end) - at<Vec<2, double>>(0, 0.25)});
        scene.join(end, scene.id("jelly/corner_4"));
        expect(watch(scene, lasting(5), 1.5), 4e-3, 0.2, "jelly");
    }
}

TEST(JoinedFigures, WhatHangsOnATetheredClothHangsOnItsPins) {
    for (const double mass : {2.0, 20.0, 300.0})
        for (const char* at : {"cloth/bottom_right", "cloth/particle_8_15"}) {
            Scene<3> scene;
            scene.cloth("corners", 1);
            scene.hang(scene.id(at), mass, 0.1);
            expect(watch(scene, lasting(3), 1.1), 3e-3, 0.1, at);
        }
}

TEST(JoinedFigures, EightLoadsOnAHem) {
    Scene<3> scene;
    scene.cloth("corners", 1);
    for (int i = 0; i < 16; i += 2) scene.hang(scene.id("cloth/particle_" + std::to_string(i) + "_15"), 20, 0.1);
    expect(watch(scene, 2, 1.1), 3e-3, 0.1, "hem");
}

TEST(JoinedFigures, ALoadThatIsDroppedOrThrownAddsNothing) {
    for (const double mass : {20.0, 300.0}) {
        Scene<3> dropped, thrown;
        for (auto* scene : {&dropped, &thrown}) scene->cloth("corners", 1);
        const auto raised = dropped.hang(dropped.id("cloth/bottom_right"), mass, 0.3);
        set_position(dropped.world, raised, dropped.position(raised) + at<Vec<3, double>>(0, 0.3));
        expect(watch(dropped, lasting(3), 1.3), 3e-3, 0.1, "dropped");
        const auto flung = thrown.hang(thrown.id("cloth/bottom_right"), mass, 0.1);
        set_velocity(thrown.world, flung, Vec<3, double>{{0, 0, 3}});
        expect(watch(thrown, lasting(3), 1.1), 0.1, any, "thrown");
    }
}

/// Stretch of the worst link of a cloth at its lower right corner.
double stretch_at_corner(const Scene<3>& scene) {
    const Row corner = *row_of(scene.world, scene.id("cloth/bottom_right"));
    const auto& links = std::get<Constraints<Distance<3>, double>>(scene.world.constraints);
    const auto& positions = scene.world.particles.position;
    double worst = 0;
    for (Row link = 0; link < links.size(); ++link) {
        const auto ends = links.members[link];
        if (ends[0] == corner || ends[1] == corner)
            worst = std::max(worst, distance(positions[ends[0]], positions[ends[1]]) / links.high(link) - 1);
    }
    return worst;
}

// Solutions in which links pushed had flung the corner of 4 g by up to 0.8 of a link, in one frame of 25.
TEST(JoinedFigures, AThrownLoadDoesNotFlingItsCorner) {
    int frames = 0, beyond = 0;
    for (int direction = 0; direction < 8; ++direction) {
        Scene<3> scene;
        scene.world.settings.substeps = 32;
        scene.cloth("corners", 1);
        const auto bead = scene.hang(scene.id("cloth/bottom_right"), 2, 0.1);
        const double angle = 0.75 * direction;
        set_velocity(scene.world, bead, Vec<3, double>{{3 * std::sin(angle), 0, 3 * std::cos(angle)}});
        for (int frame = 0; frame < 60 * lasting(4); ++frame, ++frames) {
            step(scene.world, 1.0 / 60);
            const double stretch = stretch_at_corner(scene);
            EXPECT_LE(stretch, 0.15) << direction << " in frame " << frame;
            beyond += stretch > 0.03;
        }
    }
    EXPECT_LE(beyond, 0.01 * frames);
}

TEST(JoinedFigures, ARagdollOnAClothAndAClothInItsHand) {
    Scene<3> attached_trees;
    attached_trees.cloth("corners", 1);
    const auto hem = attached_trees.id("cloth/particle_8_15");
    build(attached_trees.world, Ragdoll{.pose = "hands_up"}, "doll", {});
    const auto hand = attached_trees.id("doll/left_hand");
    const auto below = attached_trees.position(hem) - at<Vec<3, double>>(0, 0.03);
    teleport(attached_trees.world, *find_figure(attached_trees.world, "doll"), below - attached_trees.position(hand));
    attached_trees.join(hem, hand);
    expect(watch(attached_trees, lasting(3), 3), 0.15, any, "on a cloth");

    Scene<3> holding;
    build(holding.world, Ragdoll{}, "doll", {});
    pin(holding.world, holding.id("doll/left_hand"));
    const auto free = holding.id("doll/right_hand");
    holding.cloth("none", 1, {.at = holding.position(free) + at<Vec<3, double>>(0.5, -0.02)});
    holding.join(free, holding.id("cloth/top_left"));
    expect(watch(holding, lasting(3), 3), 0.6, any, "in its hand");
}

/// The end of a light rope that holds a ragdoll by a hand, right below.
void hold_ragdoll(Scene<3>& scene, double angle, double mass) {
    const Rope rope{.length = 1.1, .segments = 50, .angle = angle, .pinned = "start", .mass = mass};
    build(scene.world, rope, "rope", {});
    build(scene.world, Ragdoll{.pose = "hands_up"}, "doll", {});
    const auto hand = scene.id("doll/left_hand"), end = scene.id("rope/end");
    const auto below = scene.position(end) - at<Vec<3, double>>(0, 0.03);
    teleport(scene.world, *find_figure(scene.world, "doll"), below - scene.position(hand));
    scene.join(end, hand);
}

// As one block, Newton's method found no solution where the rope snaps taut: 450 ms a step, and frozen in mid-air.
TEST(JoinedFigures, ARagdollOnALightRopeSwings) {
    constexpr double level = -1.5707963267948966;
    Scene<3> scene;
    hold_ragdoll(scene, level, 0.2);
    const double start = center_of_mass(scene.world)[1];
    run(scene.world, 0.4);
    EXPECT_LT(center_of_mass(scene.world)[1], start - 0.3) << "falls";
    EXPECT_TRUE(scene.world.solver.blocks.list.empty());
    EXPECT_EQ(scene.world.solver.blocks.attached_trees.size(), 1u) << "the rope";
    expect(watch(scene, lasting(3), 3), 0.02, any, "on a rope");
}

// The choice depends on masses, and follows them as in a world made anew.
TEST(JoinedFigures, ARagdollOnARopeIsABlockByItsMasses) {
    Scene<3> scene;
    hold_ragdoll(scene, 0, 0.2);
    run(scene.world, 0.1);
    for (const auto id : scene.world.figures[*find_figure(scene.world, "rope")].particles)
        set_mass(scene.world, id, 1.0);
    auto copy = scene.world;
    for (auto* world : {&scene.world, &copy}) run(*world, 0.1);
    EXPECT_EQ(scene.world.solver.blocks.list.size(), 1u);
    EXPECT_EQ(state_hash(copy), state_hash(scene.world));
}

/// The particle of a level cloth that is nearest to being right below, or above, another.
ParticleId beside(const Scene<3>& scene, const Vec<3, double>& position, int columns, int rows) {
    ParticleId nearest{};
    double min = 1e9;
    for (int i = 0; i < columns * rows; ++i) {
        const auto thread =
            scene.id("cloth/particle_" + std::to_string(i % columns) + "_" + std::to_string(i / columns));
        const auto offset = scene.position(thread) - position;
        const double away = square(offset[0]) + square(offset[2]);
        if (away < min) min = away, nearest = thread;
    }
    return nearest;
}

TEST(JoinedFigures, ARagdollInAHammockOfClothGainsNothing) {
    for (const double mass : {1.0, 6.0}) {
        Scene<3> scene;
        constexpr int columns = 25, rows = 13;
        const Cloth cloth{.columns = columns,
                          .rows = rows,
                          .spacing = 0.08,
                          .plane = "horizontal",
                          .pins = "all_corners",
                          .mass = mass};
        build(scene.world, cloth, "cloth", {.at = {{0, 0, -0.48}}});
        build(scene.world, Ragdoll{}, "doll", {.at = {{-0.6, 0.15, 0}}, .turn = 90});
        for (const char* name :
             {"head", "left_shoulder", "right_shoulder", "left_hip", "right_hip", "left_foot", "right_foot"}) {
            const auto joint = scene.id(std::string("doll/") + name);
            scene.join(beside(scene, scene.position(joint), columns, rows), joint);
        }
        expect(watch(scene, lasting(1), 2), 0.2, any, "hammock");
    }
}

TEST(JoinedFigures, MoreIterationsLeaveLess) {
    double before = 1;
    for (const int iterations : {1, 2, 4}) {
        Scene<2> scene;
        scene.world.settings.iterations = iterations;
        const auto end = scene.rope(1.5, 14);
        const Polygon jelly{.sides = 9, .radius = 0.2, .braced = "area", .mass = 20};
        build(scene.world, jelly, "jelly", {.at = scene.position(end) - at<Vec<2, double>>(0, 0.3)});
        scene.join(end, scene.id("jelly/corner_4"));
        const auto worst = watch(scene, 2, 1.5);
        EXPECT_LT(worst.stretch, before);
        EXPECT_LE(worst.gain, 1e-6);
        before = worst.stretch;
    }
}

TEST(JoinedFigures, DampedTheyComeToRest) {
    Scene<3> scene;
    scene.world.settings.damping = 2;
    scene.cloth("corners", 1);
    scene.hang(scene.id("cloth/particle_8_15"), 20, 0.1);
    EXPECT_LE(watch(scene, lasting(5), 1.1).last_speed, sanitized ? any : 0.02);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
