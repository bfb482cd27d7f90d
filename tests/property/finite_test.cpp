#include "tests/worlds.h"

#include <cfenv>
#include <rapidcheck/gtest.h>

/// Finite input never becomes infinite or not-a-number, whatever it is.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class World> void expect_finite(const World& world) {
    using Real = typename World::Real;
    for (Row row = 0; row < world.particles.size(); ++row) {
        const auto& p = world.particles;
        RC_ASSERT(is_finite(p.position[row]) && is_finite(p.velocity[row]) && is_finite(p.previous[row]));
        for (int i = 0; i < World::dimension; ++i) RC_ASSERT(std::abs(p.position[row][i]) <= limit::coordinate<Real>);
    }
    RC_ASSERT(std::isfinite(energy(world).kinetic));
    for (const auto& event : world.events)
        if (event.type == EventType::quarantined) RC_FAIL("quarantined");
}

/// Mostly ordinary numbers, often zero, sometimes at or beyond every limit.
template <class Real> Real any_number() {
    const int what = *rc::gen::inRange(0, 8);
    const int sign = *rc::gen::inRange(0, 2) * 2 - 1;
    if (what == 0) return 0;
    if (what == 1) return Real(sign * std::pow(10.0, *rc::gen::inRange(-44, 38)));
    if (what == 2) return Real(sign) * limit::coordinate<Real>;
    return Real(sign * *rc::gen::inRange(1, 5)) / 2;
}

template <class Vector> Vector any_position() {
    return Vector::map([](int) { return any_number<std::decay_t<decltype(Vector{}[0])>>(); });
}

template <class World> World any_soup() {
    using Real = typename World::Real;
    using Vector = typename World::Vector;
    constexpr int D = World::dimension;
    World world;
    world.settings.mode = *rc::gen::arbitrary<bool>() ? Mode::physical : Mode::classic;
    world.settings.substeps = *rc::gen::inRange(0, 5);
    world.settings.iterations = *rc::gen::inRange(0, 4);
    world.settings.damping = any_number<Real>();
    world.settings.classic = {.passes = *rc::gen::inRange(0, 3),
                              .order = PassOrder(*rc::gen::inRange(0, 3)),
                              .keep = any_number<Real>(),
                              .damp_after_force = *rc::gen::arbitrary<bool>(),
                              .root_free = *rc::gen::arbitrary<bool>(),
                              .bounce = any_number<Real>(),
                              .floor_keep = any_number<Real>(),
                              .time_scale = any_number<Real>(),
                              .unscaled_inertia = *rc::gen::arbitrary<bool>()};
    if (*rc::gen::arbitrary<bool>()) world.settings.classic = {};
    const int forces = *rc::gen::inRange(0, 4);
    for (int i = 0; i < forces; ++i) {
        const Force<D, Real> fields[] = {
            Gravity<D, Real>{any_position<Vector>()}, Drag<D, Real>{any_number<Real>()},
            Wind<D, Real>{any_position<Vector>(), any_number<Real>(), any_position<Vector>(), any_number<Real>(),
                          any_number<Real>(), 3},
            Attractor<D, Real>{any_position<Vector>(), any_number<Real>(), any_number<Real>()},
            RandomPush<D, Real>{any_position<Vector>(), any_position<Vector>(), 5}};
        world.forces.push_back(fields[*rc::gen::inRange(0, 5)]);
    }
    const int planes = *rc::gen::inRange(0, 3);
    for (int i = 0; i < planes; ++i)
        world.bounds.push_back({Vector::axis(i % D), any_number<Real>(), any_number<Real>(), any_number<Real>()});

    std::vector<ParticleId> p;
    const int n = *rc::gen::inRange(2, 8);
    for (int i = 0; i < n; ++i)
        p.push_back(add_particle(world, {.position = any_position<Vector>(),
                                         .velocity = any_position<Vector>(),
                                         .mass = any_number<Real>(),
                                         .radius = any_number<Real>()}));
    const int constraints = *rc::gen::inRange(0, 10);
    for (int i = 0; i < constraints; ++i) {
        const int kind = *rc::gen::inRange(0, Kinds<D>::size);
        int arity = 0, number = 0;
        Kinds<D>::for_each([&](auto tag) {
            if (number++ == kind) arity = decltype(tag)::type::arity;
        });
        if (arity == any_arity) arity = *rc::gen::inRange(3, 7);
        std::vector<ParticleId> members;
        for (int k = 0; k < arity; ++k) members.push_back(p[std::size_t(*rc::gen::inRange(0, n))]);
        ConstraintSpec<Real> spec{.limits = between(any_number<Real>(), any_number<Real>()),
                                  .compliance = any_number<Real>(),
                                  .relaxation = any_number<Real>(),
                                  .split = any_number<Real>(),
                                  .breaking_strain = any_number<Real>()};
        if (*rc::gen::arbitrary<bool>()) spec = {};
        if (*rc::gen::arbitrary<bool>()) spec.limits = exactly(any_number<Real>());
        add_constraint(world, kind, std::span<const ParticleId>(members), spec);
    }
    const int pins = *rc::gen::inRange(0, 3);
    for (int i = 0; i < pins; ++i)
        pin(world, p[std::size_t(i)],
            {.target = any_position<Vector>(),
             .compliance = any_number<Real>(),
             .damping = any_number<Real>(),
             .max_force = any_number<Real>()});
    apply_force(world, p[0], any_position<Vector>());
    return world;
}

template <class Type> struct Finite : ::testing::Test {};
TYPED_TEST_SUITE(Finite, Everywhere, Names);

/// Clang computes lanes of a vector that nobody reads, 0 / 0 among them.
#if defined(__clang__)
constexpr bool flags_tell_only_of_what_was_written = false;
#else
constexpr bool flags_tell_only_of_what_was_written = true;
#endif

// Beyond ending finite, no operation on the way may be invalid (inf - inf, 0 * inf, sqrt of a negative): what is made
// of such a number is finite only by luck.
TYPED_TEST(Finite, AnySoupOfExtremesStaysFiniteAndNoOperationIsInvalid) {
    using Real = typename TypeParam::Real;
    EXPECT_TRUE(rc::check([] {
        auto world = any_soup<typename TypeParam::World>();
        for (int i = 0; i < 6; ++i) {
            const auto dt = *rc::gen::elementOf(std::vector<Real>{Real(1.0 / 60), 0, Real(1e-9), 10, Real(1e6)});
            std::feclearexcept(FE_INVALID);
            step(world, dt);
            if (flags_tell_only_of_what_was_written) RC_ASSERT(std::fetestexcept(FE_INVALID) == 0);
            if (dt > 0) expect_finite(world);
        }
    }));
}

TYPED_TEST(Finite, AStepOfNoOrNegativeOrNoTimeAtAllChangesNothing) {
    using Real = typename TypeParam::Real;
    for (const Mode mode : {Mode::physical, Mode::classic}) {
        auto world = menagerie<TypeParam::dimension, Real>(mode);
        run(world, 0.2);
        const auto hash = state_hash(world);
        for (const double dt : {0.0, -0.0, -1.0, -double(INFINITY), double(NAN)}) {
            step(world, Real(dt));
            EXPECT_EQ(state_hash(world), hash) << dt;
        }
    }
}

TYPED_TEST(Finite, StepsOfAnyLengthStayFinite) {
    using Real = typename TypeParam::Real;
    for (const Mode mode : {Mode::physical, Mode::classic})
        for (const double dt : {1e-12, 1e-9, 1e-3, 10.0, 1e6, 1e30, double(INFINITY)}) {
            auto world = menagerie<TypeParam::dimension, Real>(mode);
            for (int i = 0; i < 20; ++i) step(world, Real(dt));
            for (const auto& x : world.particles.position) EXPECT_TRUE(is_finite(x)) << dt;
        }
}

// Everything on one spot, every kind, every limit above it.
TYPED_TEST(Finite, AHeapOfCoincidentParticlesUnfolds) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    constexpr int D = TypeParam::dimension;
    for (const double limit : {0.0, 1.0}) {
        World world;
        std::vector<ParticleId> p;
        for (int i = 0; i < 4; ++i) p.push_back(add_particle(world, {}));
        int kind = 0;
        Kinds<D>::for_each([&](auto tag) {
            const int arity = decltype(tag)::type::arity == any_arity ? 4 : decltype(tag)::type::arity;
            add_constraint(world, kind++, std::span<const ParticleId>(p).first(std::size_t(arity)),
                           ConstraintSpec<Real>{.limits = exactly(Real(limit))});
        });
        run(world, 2);
        for (const auto& x : world.particles.position) EXPECT_TRUE(is_finite(x));
        if (limit > 0) {
            EXPECT_GT(double(distance(world.particles.position[0], world.particles.position[1])), 0.5);
        } else {
            EXPECT_EQ(max_speed(world), 0);
        }
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
