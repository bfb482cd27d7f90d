#include "sinew/math/trig.h"
#include "sinew/world/colliders.h"

#include "tests/thorough.h"
#include "tests/worlds.h"

#include <algorithm>
#include <cmath>

/// Points and small balls on joints of chains, seams of flush boxes, and edges and corners of landscapes.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Joint : ::testing::Test {};
TYPED_TEST_SUITE(Joint, Everywhere, Names);
template <class Real> struct JointOfSurface : ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(JointOfSurface, Precisions);

constexpr double radii[] = {0, 1e-6, 1e-3, 0.05};

/// A loose particle, or one of a figure that touches figures: walls hold these in different ways.
template <int D, class Real>
ParticleId add_ball(Stepped<D, Real>& world, const Vec<D, Real>& place, const Vec<D, Real>& velocity, double radius,
                    bool is_figure) {
    if (!is_figure) return add_particle(world, {.position = place, .velocity = velocity, .radius = Real(radius)});
    const auto figure = add_figure(world, "ball");
    set_contact(world, figure, {.figures = true, .friction = 0});
    const auto id =
        add_particle(world, {.position = place, .velocity = velocity, .radius = Real(radius), .figure = figure});
    world.figures[figure].particles.push_back(id);
    Piece drawn{.mark = Mark::stroke};
    drawn.particles.push_back(id);
    world.figures[figure].pieces.push_back(drawn);
    return id;
}

template <class Real> using FlatSpace = Stepped<2, Real>;

/// Flush boxes with their tops at height 0 and a seam at `shift`.
template <int D, class Real> void add_tiles(Stepped<D, Real>& world, double size, double shift) {
    for (int i = -8; i < 8; ++i)
        for (int k = D == 3 ? -1 : 0; k < 1; ++k) {
            Vec<D, Real> middle{};
            if (D == 3) middle[D - 1] = Real((k + 0.5) * size);
            middle[0] = Real(shift + (i + 0.5) * size), middle[1] = Real(-size / 2);
            add_collider(world, collide::Collider<D, Real>{
                                    .shape = collide::Box<D, Real>{Vec<D, Real>::map([&](int) { return Real(size); })},
                                    .target = {middle, {}}});
        }
}

/// Depth behind two lines from the origin to both sides, which rise by `slope`.
double depth_behind(double x, double y, double slope) {
    const double per_length = 1 / std::sqrt(1 + slope * slope), left = y + slope * x, right = y - slope * x;
    return -per_length * (slope >= 0 ? std::min(left, right) : std::max(left, right));
}

// A ball that falls onto the joint of a chain at any speed is held there: in a valley, on a flat joint and on a summit.
// The overlap of a blow of 1000 m/s comes out slowly, to less than 2 mm.
TYPED_TEST(JointOfSurface, OfAChainHoldsABallOfAnyRadius) {
    using Real = TypeParam;
    int number = 0;
    for (const double degrees : {-45.0, -5.0, 0.0, 5.0, 45.0, 60.0})
        for (const double radius : radii)
            for (const double speed : {0.0, 1.0, 10.0, 1000.0})
                for (const double shift : {0.0, 0.1})
                    for (const bool is_figure : {false, true}) {
                        if (++number % one_of(3) != 0) continue;
                        FlatSpace<Real> world;
                        fall(world, 9.81);
                        const double slope = std::tan(degrees * pi<double> / 180), far = 200;
                        collide::Collider<2, Real> ground{
                            .shape = collide::Chain<2, Real>{
                                {{{Real(-far), Real(far * slope)}}, {{0, 0}}, {{Real(far), Real(far * slope)}}},
                                false}};
                        ground.target.position = {{Real(shift), Real(3 * shift)}};
                        add_collider(world, ground);
                        const double held = degrees > 0 ? radius * std::sqrt(1 + slope * slope) : radius;
                        const Vec<2, Real> place{{Real(shift), Real(3 * shift + held + 0.2)}};
                        const auto ball = add_ball<2, Real>(world, place, {{0, Real(-speed)}}, radius, is_figure);
                        run(world, 1.0);
                        const auto found = *position_of(world, ball) - ground.target.position;
                        EXPECT_LT(depth_behind(double(found[0]), double(found[1]), slope), 2e-3)
                            << degrees << " degrees, radius " << radius << ", " << speed << " m/s, at " << shift
                            << (is_figure ? ", figure" : "");
                    }
}

// Flush boxes hold a ball that meets a seam exactly, wherever rounding puts the faces.
TYPED_TEST(Joint, OfFlushBoxesHoldsABallOfAnyRadius) {
    using Real = typename TypeParam::Real;
    int number = 0;
    constexpr int D = TypeParam::dimension;
    for (const double size : {0.1, 0.3, 1.0})
        for (const double radius : radii)
            for (const double speed : {0.0, 30.0, 1000.0})
                for (const double shift : {0.0, 0.1, 7.3})
                    for (const int seam : {0, 2, 3})
                        for (const bool is_figure : {false, true}) {
                            if (++number % one_of(11) != 0) continue;
                            typename TypeParam::World world;
                            fall(world, 9.81);
                            add_tiles(world, size, shift);
                            Vec<D, Real> place{}, velocity{};
                            place[0] = Real(shift + seam * size), place[1] = Real(radius + 0.2);
                            velocity[1] = Real(-speed);
                            const auto ball = add_ball<D, Real>(world, place, velocity, radius, is_figure);
                            run(world, 0.5);
                            EXPECT_NEAR(double((*position_of(world, ball))[1]), radius, 2e-3)
                                << "size " << size << ", radius " << radius << ", " << speed << " m/s, seam " << seam
                                << " at " << shift << (is_figure ? ", figure" : "");
                        }
}

// No seam slows down or lifts a ball that slides without friction.
TYPED_TEST(Joint, OfFlushBoxesLetsABallOfAnyRadiusSlide) {
    using Real = typename TypeParam::Real;
    constexpr int D = TypeParam::dimension;
    for (const double radius : radii)
        for (const double shift : {0.0, 0.1, 7.3})
            for (const bool is_figure : {false, true}) {
                typename TypeParam::World world;
                fall(world, 9.81);
                add_tiles(world, 0.5, shift);
                Vec<D, Real> place{}, velocity{};
                place[0] = Real(shift - 2.2), place[1] = Real(radius), velocity[0] = 5;
                const auto ball = add_ball<D, Real>(world, place, velocity, radius, is_figure);
                double highest = 0;
                for (int i = 0; i < 48; ++i) {
                    step(world, Real(1.0 / 60));
                    highest = std::max(highest, std::abs(double((*position_of(world, ball))[1]) - radius));
                }
                EXPECT_NEAR(double((*velocity_of(world, ball))[0]), 5, 0.05) << radius << " at " << shift;
                EXPECT_LE(highest, 1e-3) << radius << " at " << shift;
            }
}

/// A landscape of 8 x 8 cells around the origin: a pit, a valley along z, a summit, a ridge, a saddle or a plane.
template <class Real> collide::HeightField<3, Real> landscape(int kind, double slope) {
    collide::HeightField<3, Real> field{.columns = 9, .spacing = 1, .height = {}};
    for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 9; ++column) {
            const double x = std::abs(column - 4), z = std::abs(row - 4);
            const double heights[] = {slope * std::max(x, z), slope * x, -slope * std::max(x, z), -slope * x,
                                      slope * (x - z),        0};
            field.height.push_back(Real(heights[kind]));
        }
    return field;
}

// Corners and edges of a landscape, and of the same mesh, hold a ball of any radius.
TYPED_TEST(JointOfSurface, OfALandscapeHoldsABallOfAnyRadius) {
    using Real = TypeParam;
    int number = 0;
    for (int kind = 0; kind < 6; ++kind)
        for (const double degrees : {5.0, 30.0, 45.0})
            for (const double radius : radii)
                for (const double speed : {0.0, 30.0})
                    for (const double along : {0.0, 0.5})
                        for (const bool is_figure : {false, true}) {
                            if (++number % one_of(11) != 0) continue;
                            Stepped<3, Real> world;
                            fall(world, 9.81);
                            const double slope = std::tan(degrees * pi<double> / 180);
                            collide::Collider<3, Real> ground{.shape = landscape<Real>(kind, slope)};
                            ground.target.position = {{-4, 0, -4}};
                            add_collider(world, ground);
                            const Vec3<Real> place{{0, Real(2 * radius + 1), Real(along)}};
                            const auto ball =
                                add_ball<3, Real>(world, place, {{0, Real(-speed), 0}}, radius, is_figure);
                            double lowest = 0;
                            for (int i = 0; i < 60; ++i) {
                                step(world, Real(1.0 / 60));
                                const auto p = *position_of(world, ball);
                                if (std::abs(p[0]) > 3 || std::abs(p[2]) > 3) break;
                                const double at[] = {0, 0, -slope * 3, -slope * 3, -slope * 3, 0};
                                lowest = std::min(lowest, double(p[1]) - at[kind]);
                            }
                            EXPECT_GT(lowest, -0.02) << "kind " << kind << ", " << degrees << " degrees, radius "
                                                     << radius << ", " << speed << " m/s, " << along;
                        }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
