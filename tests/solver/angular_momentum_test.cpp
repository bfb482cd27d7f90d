#include "sinew/world/colliders.h"
#include "sinew/world/energy_terms.h"

#include "tests/dice.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <cmath>
#include <string>
#include <vector>

/// Figures that strike each other in free space, in the plane of the first two axes.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct AngularMomentum : ::testing::Test {};
TYPED_TEST_SUITE(AngularMomentum, Everywhere, Names);

constexpr double turn_of_circle = 6.283185307179586; ///< radians

enum class Form { rod, triangle, chain };

/// Two figures thrown at each other, each turning.
template <int D, class Real> class Strike {
  public:
    using Vector = Vec<D, Real>;
    Stepped<D, Real> world;

    Strike(std::uint64_t seed, double friction, bool bounces, bool has_joints) : dice_(seed) {
        world.settings.substeps = int(dice_.between(4, 13));
        for (const double side : {-1.0, 1.0}) {
            const auto form = Form(dice_.below(has_joints ? 3 : 2));
            add(form, side * 1.2, -side * dice_.between(1, 6));
            set_contact(world, FigureIndex(world.figures.size() - 1),
                        {.figures = true, .friction = friction, .bounce = bounces ? dice_.share() : 0});
        }
    }
    /// Sum of the sizes of all momenta, times a metre.
    double scale() const {
        double sum = 0;
        for (Row row = 0; row < world.particles.size(); ++row)
            sum += mass_of(world.particles, row) * double(norm(world.particles.velocity[row]));
        return sum;
    }

  private:
    Dice dice_;

    struct Place {
        double x = 0, y = 0;
    };
    std::vector<Place> places(Form form) {
        const double length = dice_.between(0.2, 0.6);
        const int count = form == Form::rod ? 2 : form == Form::triangle ? 3 : 3 + dice_.below(3);
        double angle = dice_.between(0, turn_of_circle);
        std::vector<Place> all{{}};
        while (int(all.size()) < count) {
            all.push_back({all.back().x + length * std::cos(angle), all.back().y + length * std::sin(angle)});
            angle += form == Form::triangle ? turn_of_circle / 3 : dice_.between(-1, 1);
        }
        Place mean;
        for (const auto& place : all) mean.x += place.x / count, mean.y += place.y / count;
        for (auto& place : all) place.x -= mean.x, place.y -= mean.y;
        return all;
    }
    void add(Form form, double x, double speed) {
        const auto figure = add_figure(world, "figure" + std::to_string(world.figures.size()));
        const double turn = dice_.between(-8, 8), radius = dice_.between(0.02, 0.1), mass = dice_.scale(0.1, 10);
        Piece piece{.mark = form == Form::triangle ? Mark::loop : Mark::stroke};
        for (const auto& place : places(form))
            piece.particles.push_back(
                add_particle(world, {.position = at<Vector>(x + place.x, place.y),
                                     .velocity = at<Vector>(speed - turn * place.y, turn * place.x),
                                     .mass = Real(mass),
                                     .radius = Real(radius),
                                     .figure = figure}));
        link_in_turn(world, piece.particles, form == Form::triangle);
        world.figures[figure].particles = piece.particles;
        world.figures[figure].pieces.push_back(piece);
    }
};

/// Largest change of angular momentum in a second, as a share of the scale; all figures are asked to have met.
template <int D, class Real> double worst_change(double friction, bool bounces, bool has_joints) {
    const int cases = few_or_many(30, 1000);
    double worst = 0;
    int met = 0;
    for (int seed = 1; seed <= cases; ++seed) {
        Strike<D, Real> strike(std::uint64_t(seed), friction, bounces, has_joints);
        auto& world = strike.world;
        const double scale = strike.scale(), energy_before = energy(world).kinetic;
        const auto before = angular_momentum(world);
        run(world, 1);
        worst = std::max(worst, double(norm(angular_momentum(world) - before)) / scale);
        EXPECT_LE(energy(world).kinetic, energy_before * (1 + 1e-5)) << seed;
        met += energy(world).kinetic < energy_before * 0.999;
    }
    EXPECT_GT(met, cases / 2);
    return worst;
}

/// Rods, triangles and chains without friction: normals follow the nearest points, links are pulled along their own
/// directions, and gains of energy in a step are taken from inner motion.
TYPED_TEST(AngularMomentum, OfFiguresThatStrikeStays) {
    constexpr double exact = TypeParam::precise ? 1e-5 : 1e-3;
    for (const bool bounces : {false, true})
        EXPECT_LT((worst_change<TypeParam::dimension, typename TypeParam::Real>(0, bounces, true)), exact) << bounces;
}

/// Rigid bodies rub at their surfaces, each with the moment that the other loses.
TYPED_TEST(AngularMomentum, OfRigidFiguresThatRubStays) {
    constexpr double exact = TypeParam::precise ? 1e-5 : 1e-3;
    for (const double friction : {0.3, 1.0})
        for (const bool bounces : {false, true})
            EXPECT_LT((worst_change<TypeParam::dimension, typename TypeParam::Real>(friction, bounces, false)), exact)
                << friction << ' ' << bounces;
}

/// Balls that meet head on, at any speeds: momentum stays, they part by their restitution. A wall far away changes
/// nothing, though the energy of each ball alone rises.
TYPED_TEST(AngularMomentum, BallsThatMeetHeadOnPartByTheirRestitution) {
    using World = typename TypeParam::World;
    using Real = typename World::Real;
    using Vector = typename World::Vector;
    Dice dice(3);
    for (int i = 0; i < 40; ++i) {
        World world;
        world.settings.substeps = 1 << dice.below(6);
        if (i % 4 != 0) world.bounds.push_back({Vector::axis(1), Real(-dice.scale(0.2, 100)), Real(dice.share()), 0});
        const double bounce = i % 3 == 0 ? 1 : dice.share(), mass = i % 2 == 0 ? 1 : dice.scale(0.01, 100);
        const double left = dice.between(-5, 5), right = left - dice.between(1, 10);
        const auto add_ball = [&](double x, double speed, double kilograms) {
            const auto figure = add_figure(world, "ball" + std::to_string(world.figures.size()));
            set_contact(world, figure, {.figures = true, .friction = 0, .bounce = bounce});
            world.figures[figure].particles = {add_particle(world, {.position = at<Vector>(x, 0),
                                                                    .velocity = at<Vector>(speed, 0),
                                                                    .mass = Real(kilograms),
                                                                    .radius = Real(0.1),
                                                                    .figure = figure})};
        };
        add_ball(0, left, 1), add_ball(0.25, right, mass);
        run(world, 0.2);
        const double mean = (left + mass * right) / (1 + mass), apart = bounce * (left - right);
        const double exact = (TypeParam::precise ? 1e-9 : 1e-4) * (left - right);
        EXPECT_NEAR(double(world.particles.velocity[0][0]), mean - mass / (1 + mass) * apart, exact) << i;
        EXPECT_NEAR(double(world.particles.velocity[1][0]), mean + 1 / (1 + mass) * apart, exact) << i;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
