#include "sinew/topology/cut.h"

#include "tests/prefab/make.h"
#include "tests/sanitized.h"
#include "tests/stepped.h"
#include "tests/worlds.h"

#include <cmath>
#include <fmt/format.h>

/// What a cut leaves joined at a single point comes apart there.
namespace sinew::SINEW_TEST_FILE {
namespace {

using Plane = test::Stepped<2, double>;

Made<2, double> cloth(int side, const std::string& diagonals = "none", const std::string& pins = "none") {
    return make(Cloth{.columns = side, .rows = side, .spacing = 1, .pins = pins, .diagonals = diagonals, .mass = 4});
}

Cut snip(Made<2, double>& made, std::initializer_list<const char*> names) {
    std::vector<ConstraintId> ids;
    for (const std::string name : names) ids.push_back(find_constraint(made.world, "it/" + name).value());
    return cut(made.world, std::span<const ConstraintId>(ids));
}

/// Who can be reached from a particle by links.
std::vector<char> joined_to(const Plane& world, Row start) {
    std::vector<char> reached(world.particles.size(), 0);
    reached[start] = 1;
    for (bool more = true; more;) {
        more = false;
        for (const auto& [a, b] : std::get<0>(world.constraints).members.rows)
            if (reached[a] != reached[b]) reached[a] = reached[b] = 1, more = true;
    }
    return reached;
}

double mass_of(const Plane& world) {
    return whole_mass(world);
}

// Of four cells the upper left and the lower right lose their outer edges: the other two meet at the middle only.
TEST(Split, TwoFlapsThatMeetAtAPointComeApart) {
    auto made = cloth(3);
    auto& world = made.world;
    const auto middle = find_particle(world, "it/particle_1_1").value();
    const double mass = mass_of(world), own = made.mass("particle_1_1");
    set_velocity(world, middle, Vec2<double>{{3, 4}});
    const auto done = snip(made, {"across_0_0", "across_1_2"});
    EXPECT_EQ(done.links, 2U);
    ASSERT_EQ(done.new_particles, 1U);
    ASSERT_EQ(world.particles.size(), 10U);
    EXPECT_EQ(find_particle(world, "it/particle_1_1"), middle);
    EXPECT_EQ(made.mass("particle_1_1"), own / 2);
    EXPECT_EQ(mass_of(world), mass);
    EXPECT_EQ(world.particles.position[9], position_of(world, middle));
    EXPECT_EQ(world.particles.velocity[9], (Vec2<double>{{3, 4}}));
    const auto reached = joined_to(world, *row_of(world, find_particle(world, "it/top_right").value()));
    EXPECT_EQ(std::count(reached.begin(), reached.end(), 1), 5);
    EXPECT_NE(reached[4], reached[9]);
    for (const auto id : {world.particles.handles.id_of(9)})
        EXPECT_NE(std::find(made.figure().particles.begin(), made.figure().particles.end(), id),
                  made.figure().particles.end());
}

TEST(Split, WhatIsDrawnGoesWithItsFlap) {
    auto made = cloth(3);
    snip(made, {"across_0_0", "across_1_2"});
    for (const auto& piece : made.figure().pieces)
        for (std::size_t i = 0; i + 1 < piece.particles.size(); ++i) {
            const Row a = *row_of(made.world, piece.particles[i]), b = *row_of(made.world, piece.particles[i + 1]);
            EXPECT_TRUE(joined_to(made.world, a)[b]) << a << " and " << b;
        }
}

TEST(Split, NothingComesApartThatIsPinnedOrStillHeldRound) {
    auto pinned = cloth(3);
    pin(pinned.world, find_particle(pinned.world, "it/particle_1_1").value());
    EXPECT_EQ(snip(pinned, {"across_0_0", "across_1_2"}).new_particles, 0U);
    auto whole = cloth(3);
    EXPECT_EQ(snip(whole, {"across_0_0"}).new_particles, 0U); // three cells are one fan
    auto thread = cloth(3);
    EXPECT_EQ(snip(thread, {"across_0_1", "across_1_1"}).new_particles, 0U); // no cells: a thread holds
    auto rope = make(Rope{});
    EXPECT_EQ(cut(rope.world, Blade{{{-1, -0.51}}, {{1, -0.51}}}).new_particles, 0U);
}

// Two triangles that share a corner are a hinge, also when one of them is cut.
TEST(Split, AHingeThatWasBuiltStaysOne) {
    Plane world;
    std::vector<ParticleId> p;
    for (const auto& position : {Vec2<double>{{0, 0}}, Vec2<double>{{-1, 1}}, Vec2<double>{{-1, -1}},
                                 Vec2<double>{{1, 1}}, Vec2<double>{{1, -1}}, Vec2<double>{{2, 0}}})
        p.push_back(add_particle(world, {.position = position}));
    for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {2, 0}, {0, 3}, {3, 4}, {4, 0}, {3, 5}, {4, 5}})
        add<Distance>(world, {p[std::size_t(a)], p[std::size_t(b)]});
    const auto done = cut(world, Blade{{{1.5, 2}}, {{1.5, 0.2}}}); // from 3 to 5
    EXPECT_EQ(done.links, 1U);
    EXPECT_EQ(done.new_particles, 0U);
}

TEST(Split, AnAngleAcrossTheFlapsGoesAndOneInsideStays) {
    auto made = cloth(3);
    auto& world = made.world;
    const auto id = [&](const char* name) { return find_particle(world, std::string("it/") + name).value(); };
    const auto middle = id("particle_1_1"), right = id("particle_2_1"), above = id("particle_1_0"),
               below = id("particle_1_2");
    const auto inside = add<Angle>(world, {right, middle, above}), across = add<Angle>(world, {above, middle, below});
    ASSERT_EQ(snip(made, {"across_0_0", "across_1_2"}).new_particles, 1U);
    EXPECT_FALSE(constraint_state(world, *across));
    ASSERT_TRUE(constraint_state(world, *inside));
    EXPECT_NEAR(std::abs(constraint_state(world, *inside)->measure), pi<double> / 2, 1e-12);
}

// Snippet after snippet, in cloth with and without diagonals: mass and links are neither made nor lost, names keep
// their particles, and what is left moves on.
TEST(Split, RandomSnippetsLoseNothingElse) {
    std::size_t new_particles = 0;
    for (std::uint64_t seed = 0; seed < (test::sanitized ? 2 : 6); ++seed) {
        auto made = cloth(9, std::array{"none", "one", "both"}[seed % 3], "corners");
        auto& world = made.world;
        world.settings.substeps = 8;
        test::fall(world, 10);
        const double mass = mass_of(world);
        const auto corner = find_particle(world, "it/bottom_left").value();
        for (std::uint64_t k = 0; k < (test::sanitized ? 8 : 30); ++k) {
            const auto within = [&](std::uint64_t n) { return -8.5 + 17 * random::uniform(seed, k, n); };
            const Vec2<double> from{{within(0) / 2, within(1)}}, way{{within(2) / 8, within(3) / 8}};
            const auto before = std::get<0>(world.constraints).size();
            const auto done = cut(world, Blade{from, from + way});
            EXPECT_EQ(std::get<0>(world.constraints).size() + done.links, before);
            new_particles += done.new_particles;
            EXPECT_NEAR(mass_of(world), mass, 1e-12);
            for (const auto& [a, b] : std::get<0>(world.constraints).members.rows) {
                ASSERT_LT(std::max(a, b), world.particles.size());
                ASSERT_NE(a, b);
            }
            step(world, 1.0 / 60);
            EXPECT_EQ(find_particle(world, "it/bottom_left"), corner);
        }
        test::run(world, 1);
        for (const auto& position : world.particles.position) ASSERT_TRUE(is_finite(position));
        EXPECT_LT(stretch(world).max, 0.05) << seed;
    }
    EXPECT_TRUE(test::sanitized || new_particles > 5) << new_particles;
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
