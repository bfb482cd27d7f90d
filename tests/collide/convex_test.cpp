#include "tests/collide/shapes.h"

namespace sinew::collide::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Convex : ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Convex, Dimensions);

/// Distance from a point to the solid, from many directions: an upper bound that is near the truth.
template <int D> double searched_distance(const Sample<D>& sample, const Vec<D, double>& local, Dice& dice) {
    double best = 1e9;
    for (int i = 0; i < 4000; ++i) {
        const auto way = direction(dice.point<D>(1));
        double low = 0, high = 8;
        if (!sample.inside(local + way * high)) { // a chord through the solid, if any
            bool met = false;
            for (double s = 0; s < 8 && !met; s += 0.05)
                if (sample.inside(local + way * s)) high = s, met = true;
            if (!met) continue;
        }
        for (int k = 0; k < 40; ++k) {
            const double middle = (low + high) / 2;
            (sample.inside(local + way * middle) ? high : low) = middle;
        }
        best = std::min(best, high);
    }
    return best;
}

TYPED_TEST(Convex, TheSignTellsInsideFromOutside) {
    constexpr int D = TypeParam::value;
    each_convex_placement<D>(500, [](const auto& sample, const auto& pose, Dice& dice) {
        const auto point = dice.point<D>(3);
        EXPECT_EQ(nearest_of(sample.shape, pose, point).distance <= 0, sample.inside(pose.to_local(point)));
    });
}

// The nearest point lies on the surface, as far away as the distance says, and along the normal.
TYPED_TEST(Convex, TheNearestPointLiesOnTheSurfaceAlongTheNormal) {
    constexpr int D = TypeParam::value;
    each_convex_placement<D>(500, [](const auto& sample, const auto& pose, Dice& dice) {
        const auto point = dice.point<D>(3);
        const auto surface = nearest_of(sample.shape, pose, point);
        EXPECT_NEAR(norm(surface.normal), 1, 1e-12);
        EXPECT_NEAR(distance(surface.point + surface.normal * surface.distance, point), 0, 1e-12);
        EXPECT_FALSE(sample.inside(pose.to_local(surface.point + surface.normal * 1e-9)));
        EXPECT_TRUE(sample.inside(pose.to_local(surface.point - surface.normal * 1e-9)));
    });
}

TYPED_TEST(Convex, NoPointOfTheSolidIsNearer) {
    constexpr int D = TypeParam::value;
    each_convex_placement<D>(8, [](const auto& sample, const auto& pose, Dice& dice) {
        const auto point = dice.point<D>(3);
        const double found = nearest_of(sample.shape, pose, point).distance;
        if (found <= 0) return;
        const double searched = searched_distance(sample, pose.to_local(point), dice);
        EXPECT_LE(found, searched + 1e-9);
        if (searched < 8) {
            EXPECT_GE(found, searched * (D == 2 ? 0.99 : 0.8) - 0.02);
        }
    });
}

// Inside, the distance is how far the solid can be moved out: no direction is shorter.
TYPED_TEST(Convex, InsideTheDepthIsTheShortestWayOut) {
    constexpr int D = TypeParam::value;
    each_convex_placement<D>(500, [](const auto& sample, const auto& pose, Dice& dice) {
        const auto point = dice.point<D>(2);
        const double found = nearest_of(sample.shape, pose, point).distance;
        if (found > 0) return;
        for (int i = 0; i < 30; ++i)
            EXPECT_TRUE(sample.inside(pose.to_local(point + direction(dice.point<D>(1)) * (-found * 0.999))));
    });
}

TYPED_TEST(Convex, TheNearestApproachOfASegmentIsTheLeastOverItsPoints) {
    constexpr int D = TypeParam::value;
    each_convex_placement<D>(60, [](const auto& sample, const auto& pose, Dice& dice) {
        const auto a = dice.point<D>(3), b = dice.point<D>(3);
        const auto found = *nearest_to_segment(sample.shape, pose, a, b, 1e6);
        double min = 1e9;
        for (int i = 0; i <= 2000; ++i)
            min = std::min(min, nearest_of(sample.shape, pose, a + (b - a) * (i / 2000.0)).distance);
        EXPECT_LE(found.surface.distance, min + 1e-9);
        EXPECT_GE(found.surface.distance, min - 5e-3);
        EXPECT_NEAR(nearest_of(sample.shape, pose, a + (b - a) * found.t).distance, found.surface.distance, 1e-12);
    });
}

TYPED_TEST(Convex, ASweptSphereMeetsTheShapeAtTheFirstTouch) {
    constexpr int D = TypeParam::value;
    int met = 0;
    each_convex_placement<D>(200, [&](const auto& sample, const auto& pose, Dice& dice) {
        const auto from = dice.point<D>(4), displacement = (pose.position + dice.point<D>(1.5) - from) * 1.5;
        const double radius = dice.between(0, 0.5);
        if (nearest_of(sample.shape, pose, from).distance < radius) return;
        const auto impact = sweep(sample.shape, pose, from, displacement, radius);
        const double end = impact ? impact->time : 1;
        for (int i = 0; i <= 500; ++i)
            EXPECT_GE(nearest_of(sample.shape, pose, from + displacement * (end * i / 500)).distance, radius - 1e-9);
        if (!impact) return;
        ++met;
        EXPECT_NEAR(nearest_of(sample.shape, pose, from + displacement * end).distance, radius, 1e-9);
        EXPECT_LT(dot(impact->surface.normal, displacement), 0);
    });
    EXPECT_GT(met, 100);
}

TYPED_TEST(Convex, ASweptCapsuleMeetsTheShapeAtTheFirstTouch) {
    constexpr int D = TypeParam::value;
    int met = 0;
    each_convex_placement<D>(40, [&](const auto& sample, const auto& pose, Dice& dice) {
        const auto a = dice.point<D>(4), b = a + dice.point<D>(1);
        const auto displacement_a = (pose.position + dice.point<D>(1.5) - a) * 1.5,
                   displacement_b = displacement_a + dice.point<D>(1);
        const double radius = dice.between(0, 0.3);
        const auto apart = [&](double time) {
            return std::visit(
                [&](const auto& shape) {
                    if constexpr (IsSurface<std::remove_cvref_t<decltype(shape)>>)
                        return 0.0;
                    else
                        return nearest_to_segment(shape, pose.to_local(a + displacement_a * time),
                                                  pose.to_local(b + displacement_b * time))
                            .surface.distance;
                },
                sample.shape);
        };
        if (apart(0) < radius) return;
        std::visit(
            [&](const auto& shape) {
                if constexpr (!IsSurface<std::remove_cvref_t<decltype(shape)>>) {
                    const auto impact = sweep(shape, pose.to_local(a), pose.to_local(b), pose.turn_back(displacement_a),
                                              pose.turn_back(displacement_b), radius);
                    const double end = impact ? impact->time : 1;
                    for (int i = 0; i <= 200; ++i) EXPECT_GE(apart(end * i / 200), radius - 1e-7);
                    if (!impact) return;
                    ++met;
                    EXPECT_NEAR(apart(end), radius, 1e-7);
                }
            },
            sample.shape);
    });
    EXPECT_GT(met, 20);
}

TYPED_TEST(Convex, TheBoundingBoxHoldsTheShape) {
    constexpr int D = TypeParam::value;
    each_convex_placement<D>(300, [](const auto& sample, const auto& pose, Dice& dice) {
        const auto box = bounds(sample.shape, pose).grown(1e-12);
        EXPECT_TRUE(box.contains(nearest_of(sample.shape, pose, dice.point<D>(3)).point));
    });
}

TYPED_TEST(Convex, NothingIsFoundBeyondTheReach) {
    constexpr int D = TypeParam::value;
    each_convex_placement<D>(100, [](const auto& sample, const auto& pose, Dice& dice) {
        const auto point = dice.point<D>(4);
        const double distance = nearest_of(sample.shape, pose, point).distance;
        if (distance <= 0) return;
        EXPECT_FALSE(nearest(sample.shape, pose, point, distance * 0.999));
        EXPECT_TRUE(nearest(sample.shape, pose, point, distance * 1.001));
    });
}

TEST(ConvexPolygon, OnlyConvexCornersInCounterClockwiseOrderCount) {
    using V = Vec<2, double>;
    const auto convex = [](std::vector<V> corners) { return is_convex<double>(corners); };
    EXPECT_TRUE(convex(pentagon().corners));
    EXPECT_TRUE(convex({{{0, 0}}, {{1, 0}}, {{0, 1}}}));
    EXPECT_FALSE(convex({{{0, 0}}, {{0, 1}}, {{1, 0}}}));                                           // clockwise
    EXPECT_FALSE(convex({{{0, 0}}, {{2, 0}}, {{0.5, 0.5}}, {{0, 2}}}));                             // a dent
    EXPECT_FALSE(convex({{{0, 0}}, {{1, 0}}, {{2, 0}}, {{0, 1}}}));                                 // a straight corner
    EXPECT_FALSE(convex({{{0, 1}}, {{-0.6, -0.8}}, {{0.95, 0.3}}, {{-0.95, 0.3}}, {{0.6, -0.8}}})); // a star
    EXPECT_FALSE(convex({{{0, 0}}, {{1, 0}}}));
}

} // namespace
} // namespace sinew::collide::SINEW_TEST_FILE
