#include "sinew/world/colliders.h"

#include "tests/crates.h"
#include "tests/worlds.h"

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct OneWayContact : ::testing::Test {};
TYPED_TEST_SUITE(OneWayContact, Everywhere, Names);

/// One platform of each kind, whose surface at the origin is at the height 0.
template <int D, class Real> std::vector<collide::Shape<D, Real>> platforms() {
    using V = Vec<D, Real>;
    std::vector<collide::Shape<D, Real>> shapes = {
        collide::Box<D, Real>{V::map([](int i) { return Real(i == 1 ? 0.2 : 6); })},
        collide::Capsule<D, Real>{V::axis(0) * Real(-3), V::axis(0) * Real(3), Real(0.1)},
    };
    if constexpr (D == 2) {
        shapes.push_back(collide::Chain<2, Real>{{{{-3, 0}}, {{-1, 0}}, {{0.5, 0}}, {{3, 0}}}});
        shapes.push_back(
            collide::Polygon<2, Real>{{{{-3, Real(-0.1)}}, {{3, Real(-0.1)}}, {{3, Real(0.1)}}, {{-3, Real(0.1)}}}});
    } else {
        shapes.push_back(
            collide::Mesh<3, Real>{{{{-3, 0, -3}}, {{3, 0, -3}}, {{3, 0, 3}}, {{-3, 0, 3}}}, {{0, 2, 1}, {0, 3, 2}}});
    }
    return shapes;
}
/// Height of the surface of a shape of `platforms`.
template <int D, class Shape> double top_of(const Shape& shape) {
    return std::visit([]<class Held>(const Held&) { return collide::IsSurface<Held> ? 0.0 : 0.1; }, shape);
}

enum class By { rows, block, sweep };

/// Three rods in a row and a loose particle, thrown at a platform from a height.
template <class Type> struct Thrown {
    using Real = typename Type::Real;
    using Vector = typename Type::Vector;
    typename Type::World world;
    std::vector<ParticleId> ids;

    Thrown(const collide::Shape<Type::dimension, Real>& shape, By by, double height, double speed) {
        fall(world, 10);
        add_collider(world, collide::Collider<Type::dimension, Real>{.shape = shape, .one_way = at<Vector>(0, 1)});
        const auto figure = add_figure(world, "thrown");
        if (by == By::rows) set_contact(world, figure, {.figures = true});
        world.figures[figure].direct = by == By::sweep ? Direct::off : Direct::automatic;
        for (const double x : {-0.6, -0.2, 0.2, 0.6, -1.0})
            ids.push_back(add_particle(world, {.position = at<Vector>(x, height),
                                               .velocity = at<Vector>(0, speed),
                                               .radius = Real(0.05),
                                               .figure = figure}));
        for (std::size_t i = 0; i < 3; ++i) add<Distance>(world, {ids[i], ids[i + 1]}, {.figure = figure});
        world.figures[figure].particles = ids;
        Piece stroke{.mark = Mark::stroke};
        for (std::size_t i = 0; i < 4; ++i) stroke.particles.push_back(ids[i]);
        world.figures[figure].pieces.push_back(stroke);
    }
    double lowest() const {
        double lowest = 1e9;
        for (const auto id : ids) lowest = std::min(lowest, double((*position_of(world, id))[1]));
        return lowest;
    }
};

// A contact gives a little, and what it holds is not taken for something that comes from below.
TYPED_TEST(OneWayContact, HoldsWhatFallsOnIt) {
    for (const auto& shape : platforms<TypeParam::dimension, typename TypeParam::Real>())
        for (const auto by : {By::rows, By::block, By::sweep}) {
            Thrown<TypeParam> thrown(shape, by, 1, -2);
            run(thrown.world, 4);
            const double height = top_of<TypeParam::dimension>(shape) + 0.05;
            EXPECT_NEAR(thrown.lowest(), height, 1e-3) << shape.index() << " " << int(by);
        }
}

// Free flight up through the platform, to speed^2 / 2 g, and back onto it.
TYPED_TEST(OneWayContact, LetsThroughWhatComesFromBelow) {
    for (const auto& shape : platforms<TypeParam::dimension, typename TypeParam::Real>())
        for (const auto by : {By::rows, By::block, By::sweep}) {
            Thrown<TypeParam> thrown(shape, by, -1, 7);
            double highest = -1;
            for (int i = 0; i < 240; ++i) {
                step(thrown.world, typename TypeParam::Real(1.0 / 60));
                highest = std::max(highest, thrown.lowest());
            }
            EXPECT_NEAR(highest, -1 + 4.9 / 2, 0.02) << shape.index() << " " << int(by);
            const double height = top_of<TypeParam::dimension>(shape) + 0.05;
            EXPECT_NEAR(thrown.lowest(), height, 1e-3) << shape.index() << " " << int(by);
        }
}

// The lowest of a stack carries the load of all, which presses it a little into the platform.
TEST(OneWayContactOfCrates, HoldsAStack) {
    FlatWorld<double> world;
    fall(world, 10);
    add_collider(world,
                 collide::Collider<2, double>{.shape = collide::Box<2, double>{{{6, 0.2}}}, .one_way = {{0, 1}}});
    std::vector<ParticleId> top;
    for (int i = 0; i < 5; ++i) top = add_crate(world, 0, 0.6 + i, 1, 1);
    run(world, 5);
    EXPECT_NEAR(middle_of(world, top)[1], 4.6, 0.02);
}

// A link over a narrow platform lies on it between its ends.
TYPED_TEST(OneWayContact, HoldsALinkBetweenItsEnds) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    constexpr int D = TypeParam::dimension;
    const auto low = Vector::map([](int i) { return Real(i == 2 ? -1 : 0); });
    const auto high = Vector::map([](int i) { return Real(i == 2 ? 1 : 0); });
    for (const double speed : {0.0, 9.0}) {
        Thrown<TypeParam> thrown(collide::Capsule<D, Real>{low, high, Real(0.1)}, By::rows, speed > 0 ? -1 : 1, speed);
        run(thrown.world, 2);
        const double middle = double((*position_of(thrown.world, thrown.ids[1]))[1]);
        EXPECT_GT(middle, -0.3) << speed;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
