#include "tests/worlds.h"

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Quarantine : ::testing::Test {};
TYPED_TEST_SUITE(Quarantine, Everywhere, Names);

template <class World> void add_stick(World& world, const char* name, double x) {
    using Vector = typename World::Vector;
    const auto figure = add_figure(world, name);
    std::vector<ParticleId> ends;
    for (int i = 0; i < 2; ++i) ends.push_back(add_particle(world, {.position = at<Vector>(x, i), .figure = figure}));
    add<Distance>(world, {ends[0], ends[1]}, {.figure = figure});
    world.figures[figure].particles = ends;
}

// Each way to break a particle, in both modes: its figure stands still and is reported once, the other goes on as if
// alone.
TYPED_TEST(Quarantine, OnlyTheFigureThatIsNotFiniteStops) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    using World = typename TypeParam::World;
    constexpr Real nan = std::numeric_limits<Real>::quiet_NaN(), infinity = std::numeric_limits<Real>::infinity();
    const auto break_it = {
        +[](World& w, ParticleId p) { set_position(w, p, at<Vector>(nan, 0)); },
        +[](World& w, ParticleId p) { set_position(w, p, at<Vector>(0, infinity)); },
        +[](World& w, ParticleId p) { set_velocity(w, p, at<Vector>(-infinity, 0)); },
        +[](World& w, ParticleId p) { apply_force(w, p, at<Vector>(nan, nan)); },
        +[](World& w, ParticleId p) { apply_impulse(w, p, at<Vector>(infinity, 0)); },
        +[](World& w, ParticleId p) { set_mass(w, p, nan); },
        +[](World& w, ParticleId p) { w.particles.radius[*row_of(w, p)] = nan; },
    };
    for (const Mode mode : {Mode::physical, Mode::classic})
        for (const auto& damage : break_it) {
            World world, alone;
            for (auto* w : {&world, &alone}) {
                w->settings.mode = mode;
                fall(*w, 10);
                add_stick(*w, "good", 0);
            }
            add_stick(world, "bad", 5);
            run(world, 0.5);
            run(alone, 0.5);
            const auto bad = world.figures[1].particles;
            const auto other_end = *position_of(world, bad[0]);
            damage(world, bad[1]);
            step(world, Real(1.0 / 60));
            step(alone, Real(1.0 / 60));
            ASSERT_EQ(world.events.size(), 1U);
            EXPECT_EQ(world.events[0].type, EventType::quarantined);
            EXPECT_EQ(world.events[0].figure, 1U);
            EXPECT_EQ(world.events[0].particle, bad[1]);
            EXPECT_TRUE(world.figures[1].quarantined);
            for (int i = 0; i < 30; ++i) {
                step(world, Real(1.0 / 60));
                step(alone, Real(1.0 / 60));
                EXPECT_TRUE(world.events.empty());
            }
            EXPECT_EQ(*position_of(world, bad[0]), other_end);
            EXPECT_TRUE(is_finite(*position_of(world, bad[1])));
            for (Row row = 0; row < 2; ++row) EXPECT_EQ(world.particles.position[row], alone.particles.position[row]);
        }
}

TYPED_TEST(Quarantine, ReleasedItMovesAgain) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    fall(world, 10);
    add_stick(world, "stick", 0);
    const auto ends = world.figures[0].particles;
    set_velocity(world, ends[0], at<Vector>(std::numeric_limits<Real>::quiet_NaN(), 0));
    run(world, 0.5);
    const auto position = *position_of(world, ends[0]);
    release_quarantine(world, 0);
    step(world, Real(1.0 / 60));
    EXPECT_LT((*position_of(world, ends[0]))[1], position[1]);
    EXPECT_FALSE(world.figures[0].quarantined);
}

TYPED_TEST(Quarantine, APinThatLeadsNowhereIsIgnored) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    add_stick(world, "stick", 0);
    const auto hand = *pin(world, world.figures[0].particles[0]);
    move_pin(world, hand, at<Vector>(std::numeric_limits<Real>::quiet_NaN(), 0));
    step(world, Real(1.0 / 60));
    EXPECT_TRUE(is_finite(world.particles.position[0]));
    EXPECT_TRUE(world.events.empty());
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
