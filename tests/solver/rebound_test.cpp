#include "sinew/world/colliders.h"

#include "tests/crates.h"
#include "tests/worlds.h"

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Real> struct Rebound : ::testing::Test {};
using Precisions = std::conditional_t<sanitized, ::testing::Types<double>, ::testing::Types<float, double>>;
TYPED_TEST_SUITE(Rebound, Precisions);

enum class Ground { collider, plane };

template <class Real> void add_bouncy(FlatWorld<Real>& world, Ground ground, double restitution) {
    fall(world, 10);
    if (ground == Ground::plane)
        world.bounds.push_back({{{0, 1}}, 0, Real(restitution), 0});
    else
        add_collider(world, collide::Collider<2, Real>{.shape = collide::HalfSpace<2, Real>{.normal = {{0, 1}}},
                                                       .restitution = Real(restitution)});
}

/// A regular hexagon with a middle, all linked to it and along the outline, which lies on a side.
template <class Real> std::vector<ParticleId> add_hexagon(FlatWorld<Real>& world, double y, double size) {
    const auto figure = add_touching(world, 0);
    std::vector<ParticleId> ids;
    for (int i = 0; i < 7; ++i) {
        const double angle = pi<double> / 3 * i, reach = i < 6 ? size : 0;
        ids.push_back(
            add_particle(world, {.position = {{Real(reach * std::cos(angle)), Real(y + reach * std::sin(angle))}},
                                 .mass = Real(0.2),
                                 .radius = Real(0.02),
                                 .figure = figure}));
    }
    for (std::size_t i = 0; i < 6; ++i) {
        add<Distance>(world, {ids[i], ids[(i + 1) % 6]}, {.figure = figure});
        add<Distance>(world, {ids[i], ids[6]}, {.figure = figure});
    }
    world.figures[figure].particles = ids;
    return ids;
}

template <class Real> double lowest_of(const FlatWorld<Real>& world) {
    double lowest = 1e9;
    for (const auto& position : world.particles.position) lowest = std::min(lowest, double(position[1]));
    return lowest;
}
/// Height that the lowest particle returns to, from its first way down on.
template <class Real> double height_of_bounce(FlatWorld<Real>& world) {
    double highest = 0, before_all = energy(world).total();
    bool rises = false;
    double before = lowest_of(world);
    for (int i = 0; i < 240; ++i) {
        step(world, Real(1.0 / 120));
        const double now = lowest_of(world);
        rises = rises || now > before;
        if (rises) highest = std::max(highest, now);
        if (rises && now < before - 1e-3) break;
        before = now;
        EXPECT_LE(energy(world).total(), before_all * (1 + 1e-3)) << "energy grows";
    }
    return highest - 0.02;
}

// A flat fall strikes two corners at once: no impulse of one alone is right for both.
TYPED_TEST(Rebound, OfAFlatFallIsTheSquareOfTheRestitution) {
    for (const auto ground : {Ground::collider, Ground::plane})
        for (const double e : {0.5, 0.8, 1.0})
            for (const double turn : {0.0, pi<double> / 4}) {
                FlatWorld<TypeParam> world;
                add_bouncy(world, ground, e);
                const double reach = turn > 0 ? 0.48 * std::sqrt(2.0) : 0.48;
                add_crate(world, 0, 1 + 0.02 + reach, 1, 1, turn, 0);
                EXPECT_NEAR(height_of_bounce(world), e * e, 0.02 * e * e) << e << " " << turn;
            }
}
TYPED_TEST(Rebound, OfAHexagonIsTheSquareOfTheRestitution) {
    for (const double e : {0.5, 1.0}) {
        FlatWorld<TypeParam> world;
        add_bouncy(world, Ground::collider, e);
        add_hexagon(world, 1 + 0.02 + 0.3 * std::sqrt(0.75), 0.3);
        EXPECT_NEAR(height_of_bounce(world), e * e, 0.02 * e * e) << e;
    }
}

// The impulse of a blow is no load that presses on.
TYPED_TEST(Rebound, NothingHopsWithoutRestitution) {
    for (const auto ground : {Ground::collider, Ground::plane})
        for (const double turn : {0.0, 0.1, 0.3, pi<double> / 4}) {
            FlatWorld<TypeParam> world;
            add_bouncy(world, ground, 0);
            const double reach = 0.48 * (std::cos(turn) + std::sin(turn));
            add_crate(world, 0, 1 + 0.02 + reach, 1, 1, turn, 0);
            EXPECT_LE(height_of_bounce(world), 1e-3) << turn;
        }
}

// On a corner the fall turns into a spin, and on two floors of different restitution one may not feed the other.
TYPED_TEST(Rebound, AddsNoEnergyHoweverAFigureFalls) {
    for (int i = 0; i < 20; ++i) {
        FlatWorld<TypeParam> world;
        add_bouncy(world, Ground::collider, 1);
        add_collider(world,
                     collide::Collider<2, TypeParam>{.shape = collide::HalfSpace<2, TypeParam>{.normal = {{1, 0}}},
                                                     .restitution = TypeParam(0.2)});
        const double turn = random::uniform(1, 2, std::uint64_t(i));
        const auto crate = add_crate(world, 0.9, 2, 1, 1, turn, 0);
        for (const auto id : crate) set_velocity(world, id, {{-2, 0}});
        const double begun = energy(world).total();
        double most = 0;
        for (int k = 0; k < 600; ++k) {
            step(world, TypeParam(1.0 / 120));
            most = std::max(most, energy(world).total());
        }
        EXPECT_LE(most, begun * (1 + 2e-3)) << i;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
