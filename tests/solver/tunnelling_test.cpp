#include "sinew/math/trig.h"
#include "sinew/prefab/ragdoll.h"
#include "sinew/prefab/rope.h"
#include "sinew/world/colliders.h"

#include "tests/crates.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <algorithm>

/// Nothing passes through anything: links, hands, boxes that squeeze, rims of landscapes.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class RealT> struct Tunnelling : ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Tunnelling, Precisions);

template <class Real> using Space = Stepped<3, Real>;

/// A figure of a row of particles with a link from each to the next, drawn as a line.
template <int D, class Real>
std::vector<ParticleId> add_line(Stepped<D, Real>& world, int links, const Vec<D, Real>& from, const Vec<D, Real>& link,
                                 double mass, double radius) {
    const auto figure = add_figure(world, "line" + std::to_string(world.figures.size()));
    set_contact(world, figure, {.figures = true, .friction = 0.3});
    std::vector<ParticleId> line;
    for (int i = 0; i <= links; ++i) {
        line.push_back(add_particle(
            world, {.position = from + link * Real(i), .mass = Real(mass), .radius = Real(radius), .figure = figure}));
        if (i > 0) add<Distance>(world, {line.end()[-2], line.back()}, {.figure = figure});
    }
    Piece drawn{.mark = Mark::stroke};
    for (const auto id : line) drawn.particles.push_back(id), world.figures[figure].particles.push_back(id);
    world.figures[figure].pieces.push_back(drawn);
    return line;
}

template <int D, class Real>
double gap_of_links(const World<D, Real>& world, const std::vector<ParticleId>& a, const std::vector<ParticleId>& b) {
    double min = 1e9;
    for (std::size_t i = 1; i < a.size(); ++i)
        for (std::size_t k = 1; k < b.size(); ++k) {
            const auto p = *position_of(world, a[i - 1]), q = *position_of(world, a[i]);
            const auto r = *position_of(world, b[k - 1]), s = *position_of(world, b[k]);
            const auto nearest = collide::nearest_parameters(p, q, r, s);
            const Real t = nearest.s, u = nearest.t;
            min = std::min(min, double(distance(p + (q - p) * t, r + (s - r) * u)));
        }
    return min;
}

// The middle of a long link lies on an edge of a collider, as a capsule: no particle is near.
TYPED_TEST(Tunnelling, ALinkLiesOnTheEdgeOfACollider) {
    using Real = TypeParam;
    FlatWorld<Real> world;
    fall(world, 10);
    world.settings.damping = Real(0.5);
    constexpr double side = 0.4, radius = 0.03;
    add_collider(world, collide::Collider<2, Real>{.shape = collide::Box<2, Real>{{{Real(2 * side), Real(2 * side)}}},
                                                   .friction = Real(0.5)});
    const auto rope = add_line<2, Real>(world, 8, {{-1, Real(0.6)}}, {{Real(0.25), 0}}, 0.1, radius);
    for (int i = 0; i < 360; ++i) {
        step(world, Real(1.0 / 60));
        for (const double x : {-side, side})
            for (std::size_t k = 1; k < rope.size(); ++k) {
                const V2<Real> corner{{Real(x), Real(side)}};
                const auto a = *position_of(world, rope[k - 1]), b = *position_of(world, rope[k]);
                const auto t = collide::nearest_parameter(a, b, corner);
                ASSERT_GT(double(distance(a + (b - a) * t, corner)), 0.8 * radius) << i;
            }
    }
    EXPECT_LT(double((*position_of(world, rope[0]))[1]), 0.2); // its ends hang down
    EXPECT_LT(stretch(world).max, 1e-3);
}

// Two ropes in space, held at their ends, laid across each other: only their links touch.
TYPED_TEST(Tunnelling, ALinkLiesAcrossALinkInSpace) {
    using Real = TypeParam;
    constexpr double radius = 0.02;
    Space<Real> world;
    fall(world, 10);
    world.settings.damping = Real(1);
    const auto below = add_line<3, Real>(world, 5, {{Real(-0.5), 0, 0}}, {{Real(0.2), 0, 0}}, 0.1, radius);
    const auto above = add_line<3, Real>(world, 5, {{0, Real(0.2), Real(-0.5)}}, {{0, 0, Real(0.2)}}, 0.1, radius);
    for (const auto& [id, x] : {std::pair{below.front(), -0.48}, {below.back(), 0.48}}) // it sags
        pin(world, id, PinSpec<3, Real>{.target = Vec3<Real>{{Real(x), 0, 0}}});
    for (int i = 0; i < 600; ++i) {
        step(world, Real(1.0 / 60));
        ASSERT_GT(gap_of_links(world, below, above), 2 * radius * 0.6) << i; // it lands at 2 m/s
    }
    EXPECT_GT(gap_of_links(world, below, above), 2 * radius * 0.95);
    EXPECT_GT(double((*position_of(world, above[2]))[1]), -0.5); // it hangs over the lower one
    EXPECT_LT(stretch(world).max, 1e-3);
}

// A straight rope held at both ends gives way across it to first order and not to second: with each projection of its
// lengths it would kick what lies on it, until that has fallen through.
TYPED_TEST(Tunnelling, ARopeFallsOnATautRopeAndHangsOverIt) {
    using Real = TypeParam;
    constexpr double radius = 0.05;
    Space<Real> world;
    fall(world, 10);
    world.settings.damping = Real(0.5);
    const auto below = add_line<3, Real>(world, 20, {{-1, 0, 0}}, {{Real(0.1), 0, 0}}, 0.024, radius);
    for (const auto end : {below.front(), below.back()}) pin(world, end);
    const auto above =
        add_line<3, Real>(world, 20, {{Real(0.03), Real(0.2), Real(-0.5)}}, {{0, 0, Real(0.05)}}, 0.03, radius);
    for (int i = 0; i < 180; ++i) {
        step(world, Real(1.0 / 60));
        ASSERT_GT(gap_of_links(world, below, above), 2 * radius * 0.6) << i; // it lands at 1.4 m/s
        ASSERT_GT(double((*position_of(world, above[10]))[1]), 0.5 * radius) << i;
        ASSERT_LT(stretch(world).max, 1e-3) << i;
    }
    EXPECT_LT(double((*position_of(world, above.front()))[1]), 0); // its ends hang down
    EXPECT_LT(double((*position_of(world, above.back()))[1]), 0);
}

// Weights on both ends of a rope that falls across a taut one draw it down with many times the mass of the links that
// touch: the taut rope holds as a whole, and nothing gains energy.
TYPED_TEST(Tunnelling, AWeightedRopeFallsOnATautRopeAndHangsOverIt) {
    using Real = TypeParam;
    struct Fall {
        double radius, height, weight; // m, m, kg
    };
    for (const auto& [radius, height, weight] : {Fall{0.01, 0.2, 1}, Fall{0.02, 0.5, 2}, Fall{0.05, 1, 1}}) {
        Space<Real> world;
        fall(world, 10);
        world.settings.damping = Real(0.5);
        const auto below = add_line<3, Real>(world, 20, {{-1, 0, 0}}, {{Real(0.1), 0, 0}}, 1.0 / 21, radius);
        for (const auto end : {below.front(), below.back()}) pin(world, end);
        const auto above = add_line<3, Real>(world, 20, {{Real(0.03), Real(height), Real(-0.5)}}, {{0, 0, Real(0.05)}},
                                             1.0 / 21, radius);
        for (const auto end : {above.front(), above.back()}) set_mass(world, end, Real(weight + 1.0 / 21));
        const double begun = energy(world).total(), fallen = (2 + 2 * weight) * 10 * height;
        for (int i = 0; i < 90; ++i) {
            step(world, Real(1.0 / 60));
            ASSERT_LT(energy(world).total(), begun + 0.01 * fallen) << radius << ' ' << i;
            ASSERT_LT(stretch(world).max, 1e-3) << radius << ' ' << i;
        }
        double highest = -1e9;
        for (const auto id : above) highest = std::max(highest, double((*position_of(world, id))[1]));
        EXPECT_GT(highest, 0) << radius;
        EXPECT_LT(double((*position_of(world, above.front()))[1]), 0) << radius; // its ends hang down
        EXPECT_LT(double((*position_of(world, above.back()))[1]), 0) << radius;
    }
}

/// Ways from the axes of the links of b to those of a which they cross; zero where they are further off than `far`.
template <class Real>
std::vector<Vec3<Real>> ways_between(const World<3, Real>& world, const std::vector<ParticleId>& a,
                                     const std::vector<ParticleId>& b, double far) {
    std::vector<Vec3<Real>> ways;
    for (std::size_t i = 1; i < a.size(); ++i)
        for (std::size_t k = 1; k < b.size(); ++k) {
            const auto p = *position_of(world, a[i - 1]), q = *position_of(world, a[i]);
            const auto r = *position_of(world, b[k - 1]), s = *position_of(world, b[k]);
            const auto [t, u] = collide::nearest_parameters(p, q, r, s);
            const auto way = p + (q - p) * t - (r + (s - r) * u);
            const bool cross = t > 0 && t < 1 && u > 0 && u < 1 && double(norm(way)) < far;
            ways.push_back(cross ? way : Vec3<Real>{});
        }
    return ways;
}

// A limp rope that falls across a taut one folds up on it and winds around it, so that links beside each other cross
// the taut one from either side; weights on its ends tear at it. No axis passes another.
TYPED_TEST(Tunnelling, ALimpRopeFoldsUpOnATautRopeAndDoesNotPassIt) {
    using Real = TypeParam;
    struct Fall {
        double height, weight, seconds; // m, kg, s
    };
    for (const auto& [height, weight, seconds] :
         {Fall{0.2, 0, 4}, Fall{0.5, 0.2, 2}, Fall{1, 0.2, 2}, Fall{1, 1, 1.5}, Fall{1, 2, 1}}) {
        constexpr double radius = 0.01;
        Space<Real> world;
        fall(world, 9.81);
        const auto rope = [&](double length, double mass, const char* pinned) {
            const auto figure = build(world,
                                      Rope{.length = length,
                                           .angle = pi<double> / 2,
                                           .pinned = pinned,
                                           .weight = mass,
                                           .thickness = 2 * radius},
                                      pinned, {.at = {{-1, 0, 0}}});
            set_contact(world, figure, {.figures = true, .friction = 0.3});
            const auto& ids = world.figures[figure].particles;
            return std::vector<ParticleId>(ids.begin(), ids.end());
        };
        const auto below = rope(2, 0, "both"), above = rope(1, weight, "none");
        if (weight > 0) set_mass(world, above.front(), Real(weight + 1.0 / 40));
        for (std::size_t i = 0; i < above.size(); ++i)
            set_position(world, above[i], {{Real(0.03), Real(height), Real(0.05 * double(i) - 0.5)}});
        auto before = ways_between(world, below, above, 2 * radius);
        for (int i = 0; i < int(60 * seconds); ++i) {
            step(world, Real(1.0 / 60));
            const auto now = ways_between(world, below, above, 2 * radius);
            for (std::size_t k = 0; k < now.size(); ++k) ASSERT_GE(dot(now[k], before[k]), 0) << height << ' ' << i;
            before = now;
        }
        EXPECT_LT(stretch(world).max, 1e-3) << height;
    }
}

// Links thrown at each other at 50 m/s, 40 mm thick, do not pass either.
TYPED_TEST(Tunnelling, AThrownLinkDoesNotCrossALinkInSpace) {
    using Real = TypeParam;
    constexpr double radius = 0.02;
    for (int n = 0; n < 10; ++n) {
        Space<Real> world;
        const auto fence = add_line<3, Real>(world, 1, {{Real(-0.5), 0, 0}}, {{1, 0, 0}}, 1, radius);
        for (const auto id : fence) pin(world, id);
        const double x = 0.3 * random::symmetric<double>(3, 1, std::uint64_t(n));
        const auto stick =
            add_line<3, Real>(world, 1, {{Real(x), Real(1 + 0.031 * n), Real(-0.5)}}, {{0, 0, 1}}, 0.1, radius);
        for (const auto id : stick) set_velocity(world, id, Vec3<Real>{{0, -50, 0}});
        run(world, 0.05);
        const double middle = 0.5 * double((*position_of(world, stick[0]))[1] + (*position_of(world, stick[1]))[1]);
        EXPECT_GT(middle, 0) << n;
    }
}

// A box presses a rope against the ground, flatter than the rope is thick, and goes away: the rope is as it was.
TYPED_TEST(Tunnelling, ARopeSqueezedByAMovingBoxRecovers) {
    using Real = TypeParam;
    for (const bool collides : {false, true}) {
        FlatWorld<Real> world;
        add_ground(world);
        world.settings.damping = Real(0.5);
        constexpr double radius = 0.03;
        const auto rope = add_line<2, Real>(world, 10, {{-1, Real(radius)}}, {{Real(0.2), 0}}, 0.1, radius);
        if (!collides) set_contact(world, world.particles.figure[0], {});
        const auto box =
            add_collider(world, collide::Collider<2, Real>{.shape = collide::Box<2, Real>{{{Real(0.9), Real(0.6)}}},
                                                           .target = {{{Real(0.07), Real(0.8)}}}});
        double fastest = 0;
        for (int i = 0; i < 360; ++i) {
            const double low = i < 60    ? 0.8 - 0.49 * i / 60
                               : i < 120 ? 0.31
                                         : std::min(0.8, 0.31 + 0.49 * (i - 120) / 60);
            move_collider(world, box, {{{Real(0.07), Real(low)}}}); // from 0.5 m over the ground to 0.01
            step(world, Real(1.0 / 60));
            for (const auto& velocity : world.particles.velocity) fastest = std::max(fastest, double(norm(velocity)));
            ASSERT_LT(stretch(world).max, 0.02) << collides << ' ' << i;
        }
        EXPECT_LT(fastest, 10) << collides; // the box moves at half a metre a second
        EXPECT_LT(mean_speed(world), 1e-2) << collides;
        EXPECT_LT(stretch(world).max, 1e-3) << collides;
        for (const auto id : rope) EXPECT_GT(double((*position_of(world, id))[1]), 0.9 * radius) << collides;
    }
}

// A taut rope whose end is pinned below the ground has no way out. It lies still in its block; where it meets figures,
// rows of contact and exact links contradict each other, but it is not thrown about.
TYPED_TEST(Tunnelling, ARopeAnchoredInTheGroundIsNotThrown) {
    using Real = TypeParam;
    for (const bool collides : {false, true}) {
        FlatWorld<Real> world;
        add_ground(world);
        world.settings.damping = Real(0.5);
        const auto rope = add_line<2, Real>(world, 40, {{0, Real(0.8)}}, {{Real(0.001), Real(-0.035)}}, 0.2, 0.05);
        if (!collides) set_contact(world, world.particles.figure[0], {});
        pin(world, rope.front());
        pin(world, rope.back());
        double fastest = 0;
        for (int i = 0; i < 90; ++i) {
            step(world, Real(1.0 / 60));
            for (const auto& velocity : world.particles.velocity) fastest = std::max(fastest, double(norm(velocity)));
        }
        EXPECT_LT(fastest, collides ? 15 : 1);
        EXPECT_LT(mean_speed(world), collides ? 1 : 1e-3);
        EXPECT_LT(stretch(world).max, collides ? 0.2 : 0.01);
    }
}

// A hand behind a wall pulls with a thousand times the weight of the figure: the wall holds, the links stay exact.
TYPED_TEST(Tunnelling, AHandDoesNotDragAFigureThroughAWall) {
    using Real = TypeParam;
    for (const bool collides : {false, true}) {
        FlatWorld<Real> world;
        add_ground(world);
        add_collider(
            world, collide::Collider<2, Real>{.shape = collide::Box<2, Real>{{{Real(0.04), 4}}}, .target = {{{1, 1}}}});
        const auto rope = add_line<2, Real>(world, 6, {{-1, Real(0.5)}}, {{Real(0.2), 0}}, 0.5, 0.03);
        if (!collides) set_contact(world, world.particles.figure[0], {});
        pin(world, rope.back(), PinSpec<2, Real>{.target = V2<Real>{{3, Real(0.7)}}, .max_force = Real(35000)});
        for (int i = 0; i < 120; ++i) {
            step(world, Real(1.0 / 60));
            for (const auto id : rope) ASSERT_LT(double((*position_of(world, id))[0]), 1) << collides << ' ' << i;
        }
        EXPECT_LT(stretch(world).max, 0.01) << collides;
    }
}

/// Furthest place along x of a ragdoll thrown at a wall 2 cm thick, 3 m away, within half a second.
template <int D, class Real> double furthest_of_thrown_ragdoll(Real speed) {
    Stepped<D, Real> world;
    fall(world, gravity);
    world.bounds.push_back({Vec<D, Real>::axis(1), Real(0)});
    auto half = Vec<D, Real>{};
    for (int k = 0; k < D; ++k) half[k] = k == 0 ? Real(0.01) : Real(200);
    add_collider(world, collide::Collider<D, Real>{.shape = collide::Box<D, Real>{half},
                                                   .target = {Vec<D, Real>::axis(0) * Real(3)}});
    const auto ragdoll = build(world, Ragdoll{}, "ragdoll", Placement<D, Real>{.at = Vec<D, Real>::axis(1) * Real(2)});
    set_contact(world, ragdoll.figure, {.figures = true});
    for (Row row = 0; row < world.particles.size(); ++row)
        set_velocity(world, world.particles.handles.id_of(row), Vec<D, Real>::axis(0) * speed);
    double furthest = 0;
    for (int i = 0; i < 30; ++i) {
        step(world, Real(1.0 / 60));
        for (Row row = 0; row < world.particles.size(); ++row)
            furthest = std::max(furthest, double(world.particles.position[row][0]));
    }
    return furthest;
}

// At a blow the links, which are made exact after the contacts, must not press a limb through.
TYPED_TEST(Tunnelling, ARagdollThrownAtAThinWallStaysBeforeIt) {
    for (int speed = 100; speed <= 900; speed += few_or_many(200, 20)) {
        EXPECT_LT((furthest_of_thrown_ragdoll<2>(TypeParam(speed))), 3) << speed << " m/s";
        EXPECT_LT((furthest_of_thrown_ragdoll<3>(TypeParam(speed))), 3) << speed << " m/s in space";
    }
}

// Over a landscape nothing is ever below it, be it as fast as it may, and over its rim.
TYPED_TEST(Tunnelling, ABallOverTheRimOfALandscapeDoesNotComeOutBelow) {
    using Real = TypeParam;
    for (const double radius : {0.0, 0.1, 0.4})
        for (int n = 0; n < 40; ++n) {
            Space<Real> world;
            fall(world, 10);
            add_collider(world, collide::Collider<3, Real>{
                                    .shape = collide::HeightField<3, Real>{
                                        .columns = 5, .spacing = 1, .height = std::vector<Real>(25, Real(0))}});
            const double speed = 100 + 50 * n, slant = 0.05 + 0.02 * (n % 7),
                         way = 2 + 1.6 * random::uniform<double>(5, 1, std::uint64_t(n));
            const auto ball = add_particle(
                world,
                {.position = {{2, Real(radius + slant * way), Real(2 - way * (n % 2 ? 1 : -1) / 2)}},
                 .velocity = {{Real(speed * (n % 3 ? 0 : 0.3)), Real(-slant * speed), Real(n % 2 ? speed : -speed)}},
                 .radius = Real(radius)});
            for (int i = 0; i < 20; ++i) {
                step(world, Real(1.0 / 960));
                const auto at = *position_of(world, ball);
                const bool is_over = at[0] >= 0 && at[0] <= 4 && at[2] >= 0 && at[2] <= 4;
                EXPECT_TRUE(!is_over || double(at[1]) > radius - 1e-3) << radius << ' ' << n << ' ' << i;
                // beyond the rim it has fallen freely at most
                const double t = (i + 1) / 960.0;
                EXPECT_GT(double(at[1]), -5 * t * t - 0.02) << radius << ' ' << n << ' ' << i << " beyond";
            }
        }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
