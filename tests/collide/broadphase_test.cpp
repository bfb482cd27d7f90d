#include "sinew/collide/broadphase.h"
#include "sinew/collide/segment.h"

#include "tests/collide/shapes.h"

namespace sinew::collide::SINEW_TEST_FILE {
namespace {

using namespace test;

template <int D> std::vector<BoundingBox<D, double>> random_boxes(int count, std::uint64_t seed) {
    Dice dice(seed);
    std::vector<BoundingBox<D, double>> boxes(std::size_t(count), BoundingBox<D, double>{});
    for (auto& box : boxes) {
        const double kind = dice.between(0, 1);
        box.include(dice.point<D>(10));
        box = box.grown(kind < 0.9 ? dice.between(0, 0.4) : dice.between(0, 8));
        if (kind > 0.99) box = BoundingBox<D, double>::everything();
        if (kind < 0.01) box = {};
    }
    return boxes;
}

template <int D> void expect_all_pairs() {
    Broadphase<D, double> broadphase;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const auto boxes = random_boxes<D>(seed == 5 ? 3 : 400, seed);
        const auto wanted = [](std::uint32_t i, std::uint32_t k) { return (i + k) % 3 != 0; };
        std::vector<typename Broadphase<D, double>::Pair> expected;
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            for (std::uint32_t k = i + 1; k < boxes.size(); ++k)
                if (boxes[i].overlaps(boxes[k]) && wanted(i, k)) expected.push_back({i, k});
        EXPECT_EQ(broadphase.find(boxes, wanted), expected) << seed;
    }
}

TEST(BroadphaseGrid, FindsEveryPairOnceInOrder) {
    expect_all_pairs<2>();
    expect_all_pairs<3>();
}

template <int D> void expect_nearest_segments() {
    Dice dice(D);
    for (int i = 0; i < 300; ++i) {
        const auto a = dice.point<D>(1), c = dice.point<D>(1);
        const auto b = i % 10 ? dice.point<D>(1) : a, d = i % 7 ? dice.point<D>(1) : c + (b - a) * 1.5;
        const auto [s, t] = nearest_parameters(a, b, c, d);
        const double found = distance(a + (b - a) * s, c + (d - c) * t);
        double min = 1e9;
        for (int k = 0; k <= 1000; ++k) {
            const auto p = a + (b - a) * (k / 1000.0);
            min = std::min(min, distance(p, c + (d - c) * nearest_parameter(c, d, p)));
        }
        EXPECT_LE(found, min + 1e-9);
        EXPECT_GE(found, min - 2e-3);
    }
}

TEST(SegmentPairs, NearestPointsAreTheNearestOfAll) {
    expect_nearest_segments<2>();
    expect_nearest_segments<3>();
}

TEST(PoseOfAShape, ToWorldAndBackIsTheIdentity) {
    Dice dice(1);
    for (int i = 0; i < 100; ++i) {
        const auto pose = dice.pose<3>();
        const auto point = dice.point<3>(2);
        EXPECT_NEAR(distance(pose.to_local(pose.to_world(point)), point), 0, 1e-14);
        EXPECT_NEAR(norm(pose.turn(point)), norm(point), 1e-14);
    }
    using R = Rotation<3, double>;
    EXPECT_NEAR(distance(R::of({{0, 0, 2}}, pi<double> / 2) * Vec<3, double>{{1, 0, 0}}, Vec<3, double>{{0, 1, 0}}), 0,
                1e-15);
    EXPECT_NEAR(distance(Rotation<2, double>::of(pi<double> / 2) * Vec<2, double>{{1, 0}}, Vec<2, double>{{0, 1}}), 0,
                1e-15);
}

TEST(PoseOfAShape, BetweenTwoPosesIsExactAtBothEnds) {
    Dice dice(2);
    for (int i = 0; i < 100; ++i) {
        const auto from = dice.pose<3>(), to = dice.pose<3>();
        const auto point = dice.point<3>(2);
        EXPECT_NEAR(distance(Pose<3, double>::between(from, to, 0).to_world(point), from.to_world(point)), 0, 1e-12);
        EXPECT_NEAR(distance(Pose<3, double>::between(from, to, 1).to_world(point), to.to_world(point)), 0, 1e-12);
    }
}

} // namespace
} // namespace sinew::collide::SINEW_TEST_FILE
