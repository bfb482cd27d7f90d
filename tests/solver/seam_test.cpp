#include "sinew/world/colliders.h"
#include "sinew/world/environment.h"

#include "tests/crates.h"
#include "tests/worlds.h"

#include <algorithm>
#include <cmath>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Seam : ::testing::Test {};
TYPED_TEST_SUITE(Seam, Everywhere, Names);
template <class Type> struct FlatSeam : ::testing::Test {};
using Precisions = std::conditional_t<sanitized, ::testing::Types<double>, ::testing::Types<float, double>>;
TYPED_TEST_SUITE(FlatSeam, Precisions);

double drawn(double low, double high, int trial, int number) {
    return random::uniform(std::uint64_t(trial) + 1, std::uint64_t(number), 7) * (high - low) + low;
}

/// A box with its top at a height.
template <int D, class Real>
collide::Collider<D, Real> tile(const Vec<D, Real>& middle_of_top, const Vec<D, Real>& size, double bounce) {
    auto middle = middle_of_top;
    middle[1] -= size[1] / 2;
    return {.shape = collide::Box<D, Real>{size}, .target = {middle, {}}, .restitution = Real(bounce)};
}

/// Height to which a ball returns that falls from a height.
template <int D, class Real> double height_of_return(Stepped<D, Real>& world, ParticleId ball, double rate) {
    double highest = 0, before = 1e9;
    bool rises = false;
    for (int i = 0; i < int(3 * rate); ++i) {
        step(world, Real(1 / rate));
        const double now = double((*position_of(world, ball))[1]);
        if (rises && now < before) break;
        rises = rises || now > before;
        if (rises) highest = std::max(highest, now);
        before = now;
    }
    return highest;
}

// A blow may come early or late in a substep, and on one wall, on two or on four: the ball returns to e^2 of its
// height. Heights of steps miss the top by at most g dt^2 / 8; float: rounding of the velocity in 16 substeps.
TYPED_TEST(Seam, AReboundIsThatOfOneWall) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    constexpr int D = TypeParam::dimension;
    for (int trial = 0; trial < 12; ++trial) {
        typename TypeParam::World world;
        fall(world, 9.81);
        const double e = drawn(0.3, 1, trial, 0), radius = drawn(0.01, 0.3, trial, 1), height = drawn(0.5, 4, trial, 2);
        const double size = drawn(0.5, 2, trial, 3);
        for (int i = -1; i < 1; ++i)
            for (int k = D == 3 ? -1 : 0; k < 1; ++k) {
                Vector top{}, sizes = Vector::map([&](int) { return Real(size); });
                top[0] = Real((i + 0.5) * size);
                if (D == 3) top[D - 1] = Real((k + 0.5) * size);
                add_collider(world, tile(top, sizes, e));
            }
        Vector place{};
        place[0] = Real(drawn(-1, 1, trial, 4) * 0.5 * radius);
        if (D == 3) place[D - 1] = Real(trial % 3 == 0 ? 0 : drawn(-1, 1, trial, 5) * 0.5 * radius);
        place[1] = Real(radius + height);
        const auto ball = add_particle(world, {.position = place, .radius = Real(radius)});
        const double top = height_of_return(world, ball, 120) - radius;
        EXPECT_NEAR(top, e * e * height, 2e-3 * height) << "e " << e << ", radius " << radius << ", height " << height;
        EXPECT_NEAR(double((*position_of(world, ball))[0]), double(place[0]), 1e-3) << "pushed aside";
    }
}

template <class Real> struct OnSurfaces : ::testing::Test {};
TYPED_TEST_SUITE(OnSurfaces, Precisions);

template <class Real> collide::HeightField<3, Real> flat_field(std::uint32_t lines, double spacing) {
    return {
        .columns = lines, .spacing = Real(spacing), .height = std::vector<Real>(std::size_t(lines) * lines, Real(0))};
}
template <class Real> collide::Mesh<3, Real> flat_mesh(std::uint32_t lines, double spacing) {
    std::vector<Vec3<Real>> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t z = 0; z < lines; ++z)
        for (std::uint32_t x = 0; x < lines; ++x) corners.push_back({{Real(x * spacing), 0, Real(z * spacing)}});
    for (std::uint32_t z = 0; z + 1 < lines; ++z)
        for (std::uint32_t x = 0; x + 1 < lines; ++x) {
            const auto a = z * lines + x, b = a + 1, c = a + lines, d = c + 1;
            triangles.push_back({a, c, b});
            triangles.push_back({b, c, d});
        }
    return {corners, triangles};
}

// Edges and corners of a flat surface are no edges: on them, beside them, and between them a ball returns straight up.
TYPED_TEST(OnSurfaces, AReboundIsThatOfOneWall) {
    using Real = TypeParam;
    for (const bool is_mesh : {false, true})
        for (int trial = 0; trial < 8; ++trial) {
            Stepped<3, Real> world;
            fall(world, 9.81);
            collide::Collider<3, Real> ground{.restitution = Real(0.8)};
            if (is_mesh)
                ground.shape = flat_mesh<Real>(6, 1);
            else
                ground.shape = flat_field<Real>(6, 1);
            ground.target.position = {{-2, 0, -2}};
            add_collider(world, ground);
            const double x = trial < 3 ? 0.001 * trial : drawn(0, 1, trial, 0),
                         z = trial < 3 ? 0.001 : drawn(0, 1, trial, 1);
            const auto ball = add_particle(world, {.position = {{Real(x), 2, Real(z)}}, .radius = Real(0.1)});
            EXPECT_NEAR(height_of_return(world, ball, 120) - 0.1, 0.64 * 1.9, 4e-3) << x << " " << z;
            // The normal at an edge that two triangles share is right to 1e-2 in floats.
            EXPECT_NEAR(double((*position_of(world, ball))[0]), x, sizeof(Real) == 8 ? 1e-3 : 0.03);
        }
}

// Without gravity a ball in a room with e = 1 keeps its speed, corners and all; speeds of floats have 24 bits.
TYPED_TEST(Seam, ABallInARoomKeepsItsSpeed) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    for (int trial = 0; trial < 6; ++trial) {
        typename TypeParam::World world;
        set_bounds(world, Vector::map([](int) { return Real(-0.5); }), Vector::map([](int) { return Real(0.5); }),
                   Real(1));
        const auto velocity = Vector::map([&](int i) { return Real(trial == 0 ? 5 : drawn(-20, 20, trial, i)); });
        const auto ball = add_particle(world, {.velocity = velocity, .radius = Real(0.1)});
        run(world, 10);
        EXPECT_NEAR(double(norm(*velocity_of(world, ball))), double(norm(velocity)), 1e-4 * double(norm(velocity)));
    }
}

// Under gravity, too: no blow adds energy, and all of them take no more than gravity adds in one substep and a half.
TYPED_TEST(Seam, ABallThatBouncesForAMinuteKeepsItsEnergy) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    for (const int substeps : {1, 4, 16}) {
        typename TypeParam::World world;
        world.settings.substeps = substeps;
        fall(world, 9.81);
        set_bounds(world, Vector::map([](int) { return Real(-2); }), Vector::map([](int) { return Real(2); }), Real(1));
        add_particle(world, {.velocity = at<Vector>(3, 1), .radius = Real(0.1)});
        step(world, Real(1.0 / 60));
        const double begun = energy(world).total() + 9.81 * 2;
        run(world, 20);
        const double lost = begun - (energy(world).total() + 9.81 * 2);
        const double rounding = (TypeParam::precise ? 1e-6 : 2e-3) * begun;
        EXPECT_GT(lost, -rounding) << substeps;
        EXPECT_LT(lost, 1.5 * square(9.81 / 60 / substeps) + rounding) << substeps;
    }
}

// A crate without friction on flush tiles feels no edge between them.
TYPED_TEST(FlatSeam, ACrateGlidesOverFlushTiles) {
    using Real = TypeParam;
    for (const double size : {0.2, 0.5, 1.0}) {
        FlatWorld<Real> world;
        fall(world, 9.81);
        for (int i = 0; i < 20; ++i) add_collider(world, tile<2, Real>({{Real(i - 0.5), 0}}, {{1, 1}}, 0));
        const auto crate = add_crate(world, 0.5, size / 2, size, 1);
        for (const auto id : crate) set_velocity(world, id, {{5, 0}});
        double highest = 0;
        for (int i = 0; i < 150; ++i) {
            step(world, Real(1.0 / 60));
            highest = std::max(highest, double(middle_of(world, crate)[1]) - size / 2);
        }
        double speed = 0;
        for (const auto id : crate) speed += double((*velocity_of(world, id))[0]) / 4;
        EXPECT_NEAR(speed, 5, 0.05) << size;
        EXPECT_LE(highest, 1e-3) << size;
    }
}

// Collider friction bears the whole weight, wherever the tile ends: a crate slides to a stop in v^2 / (2 mu g).
TYPED_TEST(FlatSeam, ACrateSlidesToAStopOverFlushTiles) {
    using Real = TypeParam;
    FlatWorld<Real> world;
    fall(world, 9.81);
    for (int i = 0; i < 20; ++i) {
        auto one = tile<2, Real>({{Real(i - 0.5), 0}}, {{1, 1}}, 0);
        one.friction = Real(0.3);
        add_collider(world, one);
    }
    const auto crate = add_crate(world, 0.5, 0.25, 0.5, 1, 0, 0.3);
    for (const auto id : crate) set_velocity(world, id, {{5, 0}});
    run(world, 3);
    EXPECT_NEAR(double(middle_of(world, crate)[0]) - 0.5, 25 / (2 * 0.3 * 9.81), 0.1);
}

// A crate that falls flat on a pad narrower than itself comes back flat: the pad's corners bear it together.
TYPED_TEST(FlatSeam, ACrateReturnsFlatFromANarrowPad) {
    using Real = TypeParam;
    for (const double width : {0.3, 0.75, 0.9})
        for (const double e : {0.5, 1.0}) {
            FlatWorld<Real> world;
            fall(world, 9.81);
            add_collider(world, tile<2, Real>({{0, 0}}, {{Real(width), Real(0.2)}}, e));
            const auto crate = add_crate(world, 0, 1.5, 1, 1);
            double highest = 0;
            bool rises = false;
            for (int i = 0; i < 90; ++i) {
                step(world, Real(1.0 / 60));
                rises = rises || (*velocity_of(world, crate[0]))[1] > Real(0.5);
                if (rises) highest = std::max(highest, double(middle_of(world, crate)[1]) - 0.5);
            }
            const auto side = *position_of(world, crate[1]) - *position_of(world, crate[0]);
            EXPECT_NEAR(highest, e * e, 0.02) << width << " " << e;
            EXPECT_LE(std::abs(double(side[1])), 0.02) << width << " " << e;
        }
}

// Crates and rods that tumble in a room with e = 1 keep their energy, with gravity and without; 2e-5 was measured.
TYPED_TEST(FlatSeam, AFigureInARoomKeepsItsEnergy) {
    using Real = TypeParam;
    for (const bool is_rod : {false, true})
        for (const double g : {0.0, 9.81}) {
            FlatWorld<Real> world;
            fall(world, g);
            set_bounds<2, Real>(world, {{-2, -2}}, {{2, 2}}, Real(1));
            std::vector<ParticleId> ids;
            if (is_rod) {
                const auto figure = add_touching(world, 0);
                for (const double x : {-0.5, -0.25})
                    ids.push_back(add_particle(
                        world, {.position = {{Real(x), Real(0.4 * x)}}, .radius = Real(0.02), .figure = figure}));
                add<Distance>(world, {ids[0], ids[1]}, {.figure = figure});
                world.figures[figure].particles = ids;
            } else {
                ids = add_crate(world, 0, 0, 0.8, 1, 0.3);
            }
            for (const auto id : ids) set_velocity(world, id, {{3, 1}});
            const double begun = energy(world).total(), size = energy(world).kinetic + 2 * g;
            double most = 0, least = 0;
            for (int i = 0; i < 10 * 60; ++i) {
                step(world, Real(1.0 / 60));
                most = std::max(most, energy(world).total() - begun);
                least = std::min(least, energy(world).total() - begun);
            }
            EXPECT_LE(most, 1e-3 * size) << is_rod << " " << g;
            EXPECT_GE(least, -1e-3 * size) << is_rod << " " << g;
        }
}

// A crate that tumbles between walls with e = 1, without friction and damping, keeps its energy.
TYPED_TEST(FlatSeam, ACrateThatTumblesGainsNoEnergy) {
    using Real = TypeParam;
    for (int trial = 0; trial < 4; ++trial) {
        FlatWorld<Real> world;
        fall(world, 9.81);
        add_collider(world, tile<2, Real>({{0, 0}}, {{400, 1}}, 1));
        const auto crate = add_crate(world, 0, 3, 1, 1, drawn(0, 1.5, trial, 0));
        const double begun = energy(world).total();
        double most = 0;
        for (int i = 0; i < 20 * 60; ++i) {
            step(world, Real(1.0 / 60));
            if (i % 10 == 0) most = std::max(most, energy(world).total() - begun);
        }
        EXPECT_LE(most, 1e-3 * 9.81 * 3) << trial;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
