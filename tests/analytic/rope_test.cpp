#include "sinew/prefab/prefabs.h"
#include "sinew/world/measure.h"

#include "tests/sanitized.h"
#include "tests/stepped.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <cmath>

/// Ropes and swings against what the textbook says.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

using Position = Vec2<double>;

/// a of  2 a sinh(span / 2 a) = length.
double catenary_parameter(double span, double length) {
    double low = 0.1, high = 1000;
    for (int i = 0; i < 100; ++i) {
        const double a = 0.5 * (low + high);
        (2 * a * std::sinh(0.5 * span / a) > length ? low : high) = a;
    }
    return low;
}

TEST(Truth, ARopeHangsInACatenary) {
    constexpr double span = 10, length = 12;
    constexpr int links = 100;
    test::Stepped<2, double> world;
    fall(world, gravity);
    world.settings.damping = 3;
    build(world,
          Rope{.length = length,
               .segments = links,
               .angle = pi<double> / 2,
               .slack = length / span - 1,
               .pinned = "both",
               .mass = 1},
          "rope");
    run(world, sanitized ? 1 : 20);
    if (sanitized) return;
    const double a = catenary_parameter(span, length);
    for (int i = 0; i <= links; ++i) {
        const auto position = world.particles.position[std::size_t(i)];
        const double expected = a * (std::cosh((position[0] - span / 2) / a) - std::cosh(span / 2 / a));
        EXPECT_NEAR(position[1], expected, 1e-3 * length) << i;
    }
}

/// Two weights on a rigid frame about a pivot; small swings take  2 pi sqrt(I / (M g d)) (1 + angle^2 / 16).
TEST(Truth, ACompoundPendulumHasItsPeriod) {
    constexpr double angle = 0.1, offset = 0.4, near = 0.5, far = 1.5, light = 1, heavy = 2;
    test::Stepped<2, double> world;
    fall(world, gravity);
    const auto at_angle = [](double r, double turn) { return at<Position>(r * std::sin(turn), -r * std::cos(turn)); };
    // the mass of the frame is balanced so that the middle hangs straight below
    const double turn_light = offset, turn_heavy = -std::asin(light * near * std::sin(offset) / (heavy * far));
    const auto pivot = add_particle(world, {});
    const auto a = add_particle(world, {.position = at_angle(near, angle + turn_light), .mass = light});
    const auto b = add_particle(world, {.position = at_angle(far, angle + turn_heavy), .mass = heavy});
    pin(world, pivot);
    for (const auto& pair : {std::pair(pivot, a), std::pair(pivot, b), std::pair(a, b)})
        add<Distance>(world, {pair.first, pair.second});
    const double inertia = light * near * near + heavy * far * far;
    const double moment = light * near * std::cos(turn_light) + heavy * far * std::cos(turn_heavy); // M d
    const double period = 2 * pi<double> * std::sqrt(inertia / (moment * gravity)) * (1 + angle * angle / 16);

    const auto swing = [&] {
        const auto p = *position_of(world, b);
        return std::atan2(p[0], -p[1]) - turn_heavy;
    };
    double before = swing(), first = 0, last = 0;
    int crossings = 0;
    for (int i = 1; i <= 60 * 20; ++i) {
        step(world, 1.0 / 60);
        const double now = swing();
        if (before > 0 && now <= 0) {
            last = (i - now / (now - before)) / 60;
            if (crossings++ == 0) first = last;
        }
        before = now;
    }
    ASSERT_GT(crossings, 3);
    EXPECT_NEAR((last - first) / (crossings - 1) / period, 1, 1e-3);
}

// A chain hangs in a fold, its ends side by side, and one is let go. When that has fallen x,
//     v^2 = g x (2 L - x) / (L - x)        (all energy is in the arm that still falls)
// which is more than free fall, and without end: a whip.
// (Calkin and March 1989; one dimension, no losses.) Of links that can go slack as of rods.
TEST(Truth, TheTipOfAFoldedChainSpeedsUpAsAWhipDoes) {
    constexpr int links = 201;
    constexpr double length = 4, piece = length / links;
    for (const bool slack : {false, true})
        for (const int rate : {60, 240}) {
            test::Stepped<2, double> world;
            fall(world, gravity);
            std::vector<ParticleId> ids;
            for (int i = 0; i <= links; ++i) {
                const bool down = i <= links / 2; // the link in the fold lies level
                const double y = -piece * (down ? i : links + 1 - i);
                ids.push_back(
                    add_particle(world, {.position = at<Position>(down ? 0 : piece, y), .mass = 1.0 / links}));
                if (i > 0)
                    add<Distance>(world, {ids[std::size_t(i) - 1], ids.back()},
                                  {.limits = slack ? at_most(piece) : exactly(piece)});
            }
            pin(world, ids.front());
            int checked = 0;
            for (int i = 0; i < rate; ++i) {
                step(world, 1.0 / rate);
                const double x = -(*position_of(world, ids.back()))[1] - piece;
                if (x > 0.8 * length) break; // from there on it is a matter of single links
                if (x < 0.3 * length) continue;
                const double expected = std::sqrt(gravity * x * (2 * length - x) / (length - x));
                EXPECT_NEAR(-(*velocity_of(world, ids.back()))[1] / expected, 1, 0.03)
                    << (slack ? "slack" : "rods") << " at " << rate << " Hz, fallen " << x / length;
                ++checked;
            }
            EXPECT_GT(checked, 3);
        }
}

/// Released from 0.9 rad, undamped, at the default settings: half a minute, and ten, all stay within 0.01 % of the
/// energy of all weight falling the whole length.
template <class Build> void expect_energy_kept(std::string_view name, double scale, Build&& put) {
    test::Stepped<2, double> world;
    fall(world, gravity);
    put(world);
    const double begun = energy(world).total();
    const int frames = sanitized ? 60 : few_or_many(30, 600) * 60;
    double max = 0;
    for (int i = 0; i < frames; ++i) {
        step(world, 1.0 / 60);
        max = std::max(max, std::abs(energy(world).total() - begun) / scale);
    }
    EXPECT_LT(max, 1e-4) << name;
    EXPECT_LT(stretch(world).max, 1e-5) << name;
}

TEST(Truth, WhatSwingsKeepsItsEnergy) {
    constexpr double angle = 0.9, mass = 70, tall = 1.6;
    for (const int links : {1, 2, 20})
        expect_energy_kept(std::to_string(links) + " links", links * gravity, [&](auto& world) {
            const auto ids = chain(world, links + 1, {{0, 0}}, {{std::sin(angle) / links, -std::cos(angle) / links}});
            pin(world, ids[0]);
            world.figures[add_figure(world, "figure")].direct = Direct::on;
            for (auto& figure : world.particles.figure) figure = 0;
        });
    for (const double turn : {angle, -angle})
        expect_energy_kept("ragdoll", mass * gravity * tall, [&](auto& world) {
            build(world, Ragdoll{.height = tall, .mass = mass}, "bob", {.turn = turn});
            pin(world, *find_particle(world, "bob/left_hand"));
        });
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
