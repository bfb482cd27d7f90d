#include "sinew/sinew.h"
#include "sinew/world/asleep.h"
#include "sinew/world/colliders.h"
#include "sinew/world/measure.h"

#include "tests/worlds.h"

#include <algorithm>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class RealT> struct Alone : ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Alone, Precisions);

/// Ropes let go level, side by side.
template <class Real> World<3, Real> crowd(bool contact) {
    World<3, Real> world;
    set_gravity(world, {{0, Real(-9.81), 0}});
    for (int i = 0; i < 12; ++i)
        build(world, Rope{.length = 2, .segments = 20, .angle = pi<double> / 2, .mass = 20},
              "rope_" + std::to_string(i), {.at = {{0, 0, Real(0.1 * i)}}});
    for (FigureIndex i = 0; i < world.figures.size(); ++i) set_contact(world, i, {.figures = contact});
    return world;
}

TYPED_TEST(Alone, AWorldInWhichNothingTouchesEndsInTheSameBitsAsWithoutContact) {
    using Real = TypeParam;
    Simulation<3, Real> with{crowd<Real>(true), {}}, without{crowd<Real>(false), {}};
    for (int i = 0; i < 120; ++i) with.step(Real(1) / 60), without.step(Real(1) / 60);
    const auto& p = with.world.particles;
    for (Row row = 0; row < p.size(); ++row) EXPECT_FALSE(p.near[row] && p.mobility[row] > Real(0));
    EXPECT_EQ(with.world.particles.position, without.world.particles.position);
    EXPECT_EQ(with.world.particles.velocity, without.world.particles.velocity);
}

/// Zigzag of three links that a direct block may solve.
template <class Real> FigureIndex add_zigzag(World<2, Real>& world, double x, double speed) {
    const auto figure = add_figure(world, "zigzag_" + std::to_string(world.figures.size()));
    std::vector<ParticleId> ids;
    for (int i = 0; i < 4; ++i) {
        ids.push_back(add_particle(world, {.position = {{Real(x + 0.1 * (i % 2)), Real(0.3 * i)}},
                                           .velocity = Vec<2, Real>{{Real(speed), 0}},
                                           .radius = Real(0.04),
                                           .figure = figure}));
        world.figures[figure].particles.push_back(ids.back());
        if (i == 0) continue;
        const auto length = distance(world.particles.position[world.particles.size() - 2],
                                     world.particles.position[world.particles.size() - 1]);
        const auto id = add<Distance>(world, {ids[std::size_t(i) - 1], ids[std::size_t(i)]},
                                      {.limits = exactly(length), .figure = figure});
        world.figures[figure].constraints.push_back(*id);
        world.figures[figure].pieces.push_back(
            {.mark = Mark::stroke, .particles = {ids[std::size_t(i) - 1], ids[std::size_t(i)]}});
    }
    set_contact(world, figure, {.figures = true});
    return figure;
}
template <class Real> Vec<2, Real> middle_of(const World<2, Real>& world, FigureIndex figure) {
    Vec<2, Real> sum{};
    for (const auto& id : world.figures[figure].particles) sum += *position_of(world, id);
    return sum * (Real(1) / Real(world.figures[figure].particles.size()));
}
template <class Real> bool is_alone(const World<2, Real>& world, FigureIndex figure) {
    return world.particles.near[*world.particles.handles.find(world.figures[figure].particles[0])] == 0;
}

TYPED_TEST(Alone, FiguresMeetBeforeTheyTouchAndAreAloneAgainAfterwards) {
    using Real = TypeParam;
    for (const double speed : {2.0, 20.0, 100.0}) {
        Simulation<2, Real> simulation{};
        auto& world = simulation.world;
        const auto left = add_zigzag(world, -6.05, speed), right = add_zigzag(world, 6, -speed);
        simulation.step(Real(1) / 60);
        EXPECT_TRUE(is_alone(world, left) && is_alone(world, right));
        bool have_met = false;
        for (int i = 0; i < int(60 * 12 / speed) + 80; ++i) {
            simulation.step(Real(1) / 60);
            have_met = have_met || !is_alone(world, left);
            EXPECT_LT(double(middle_of(world, left)[0]), double(middle_of(world, right)[0])) << speed;
            EXPECT_EQ(is_alone(world, left), is_alone(world, right));
        }
        EXPECT_TRUE(have_met) << speed;
        for (const auto& id : world.figures[right].particles)
            world.particles.velocity[*world.particles.handles.find(id)][0] += Real(5);
        for (int i = 0; i < 60; ++i) simulation.step(Real(1) / 60);
        EXPECT_TRUE(is_alone(world, left)) << speed;
        EXPECT_LT(stretch(world).max, 1e-4);
    }
}

TYPED_TEST(Alone, AFigureMeetsTheGroundAndRestsOnIt) {
    using Real = TypeParam;
    Simulation<2, Real> simulation{};
    auto& world = simulation.world;
    set_gravity(world, {{0, Real(-9.81)}});
    world.bounds.push_back({{{0, 1}}, Real(-3), 0, Real(0.5)});
    const auto figure = add_zigzag(world, 0, 0);
    simulation.step(Real(1) / 60);
    EXPECT_TRUE(is_alone(world, figure));
    for (int i = 0; i < 300; ++i) simulation.step(Real(1) / 60);
    EXPECT_FALSE(is_alone(world, figure));
    for (const auto& id : world.figures[figure].particles) EXPECT_GT(double((*position_of(world, id))[1]), -2.97);
}

/// A rope pinned by its first particle, whose links are longer than what it falls on is wide, with a weight on its end;
/// it touches walls alone.
template <class Real> struct OverARail {
    static constexpr double rail = 0.05, radius = 0.02;
    Simulation<2, Real> simulation{};
    World<2, Real>& world = simulation.world;
    FigureIndex figure;

    explicit OverARail(double weight) {
        set_gravity(world, {{0, Real(-9.81)}});
        world.settings.damping = Real(0.5);
        add_collider(world, collide::Collider<2, Real>{.shape = collide::Sphere<2, Real>{Real(rail)}});
        figure = build(world, Rope{.length = 3, .segments = 10, .angle = pi<double> / 2, .mass = 1, .weight = weight},
                       "rope", {.at = {{Real(-1.17), Real(0.4)}}});
        for (const auto& id : world.figures[figure].particles)
            if (const Row row = *world.particles.handles.find(id); world.particles.radius[row] < Real(radius))
                world.particles.radius[row] = Real(radius);
    }
    /// Distance of the middle line from the middle of the rail.
    double nearest() const {
        double least = 1e9;
        const auto& ids = world.figures[figure].particles;
        for (std::size_t i = 1; i < ids.size(); ++i) {
            const auto a = *position_of(world, ids[i - 1]), b = *position_of(world, ids[i]);
            least = std::min(least, double(norm(a + (b - a) * collide::nearest_parameter(a, b, Vec<2, Real>{}))));
        }
        return least;
    }
};

TYPED_TEST(Alone, LinksLieOnWhatIsNarrowerThanTheyAreLong) {
    using Real = TypeParam;
    for (const double weight : {0.2, 2.0}) {
        OverARail<Real> show(weight);
        bool have_met = false;
        for (int i = 0; i < 600; ++i) {
            show.simulation.step(Real(1) / 60);
            have_met = have_met || !is_alone(show.world, show.figure);
            ASSERT_GT(show.nearest(), show.rail) << weight << ' ' << i;
            ASSERT_LT(stretch(show.world).max, 1e-3) << weight << ' ' << i;
        }
        EXPECT_TRUE(have_met);
        EXPECT_NEAR(show.nearest(), show.rail + show.radius, 0.1 * show.radius) << weight;
    }
}

TYPED_TEST(Alone, ACopyGoesOnToTheSameBits) {
    using Real = TypeParam;
    Simulation<2, Real> simulation{};
    add_zigzag(simulation.world, -1.5, 6);
    add_zigzag(simulation.world, 1.5, -6);
    for (int i = 0; i < 60; ++i) {
        Simulation<2, Real> copy{simulation.world, {}};
        simulation.step(Real(1) / 60), copy.step(Real(1) / 60);
        EXPECT_EQ(state_hash(simulation.world), state_hash(copy.world)) << i;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
