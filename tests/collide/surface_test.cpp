#include "tests/collide/shapes.h"

namespace sinew::collide::SINEW_TEST_FILE {
namespace {

using namespace test;
using V2 = Vec<2, double>;
using V3 = Vec<3, double>;

template <int D>
std::vector<SurfacePoint<D, double>> contacts(const Shape<D, double>& shape, const Vec<D, double>& center,
                                              double reach) {
    std::vector<SurfacePoint<D, double>> found;
    contacts_of_sphere<D, double>(shape, {}, center, reach, reach,
                                  [&](const auto& surface) { found.push_back(surface); });
    return found;
}

Chain<2, double> terrain() {
    return {{{{0, 0}}, {{1, 0}}, {{2, 0}}, {{3, 1}}, {{4, 0}}, {{4, -1}}}, false};
}

// A disc that rolls over straight joints of a terrain feels one contact, straight up.
TEST(ChainShape, AFlatJointIsNoBump) {
    for (int i = 0; i <= 400; ++i) {
        const auto found = contacts<2>(terrain(), {{0.2 + 1.3 * i / 400, 0.19}}, 0.2);
        ASSERT_EQ(found.size(), 1U) << i;
        EXPECT_EQ(found[0].normal, (V2{{0, 1}}));
        EXPECT_NEAR(found[0].distance, 0.19, 1e-12);
    }
}

TEST(ChainShape, AValleyHoldsADiscOnBothSides) {
    EXPECT_EQ(contacts<2>(terrain(), V2{{2, 0.1}} + direction(V2{{-std::tan(pi<double> / 8), 1}}) * 0.1, 0.3).size(),
              2U);
}

TEST(ChainShape, ASummitHasOneContactAllAround) {
    for (int i = -10; i <= 10; ++i) {
        const double angle = pi<double> / 4 * i / 10.0;
        const auto found = contacts<2>(terrain(), V2{{3 + 0.1 * std::sin(angle), 1 + 0.1 * std::cos(angle)}}, 0.11);
        ASSERT_EQ(found.size(), 1U) << i;
        EXPECT_NEAR(found[0].distance, 0.1, 1e-12);
    }
}

TEST(ChainShape, IsMetFromTheFreeSideOnly) {
    const Shape<2, double> chain = terrain();
    const auto impact = sweep<2, double>(chain, {}, {{0.5, 1}}, {{0, -2}}, 0.25);
    ASSERT_TRUE(impact);
    EXPECT_NEAR(impact->time, 0.375, 1e-9);
    EXPECT_FALSE((sweep<2, double>(chain, {}, {{0.5, -1}}, {{0, 2}}, 0.25)));
}

TEST(ChainShape, AClosedChainIsARoom) {
    const Shape<2, double> room = Chain<2, double>{{{{0, 0}}, {{2, 0}}, {{2, 1}}, {{0, 1}}}, true};
    for (const auto& way : {V2{{9, 0.1}}, V2{{-9, 0.2}}, V2{{0.1, 9}}, V2{{0.2, -9}}})
        EXPECT_TRUE((sweep<2, double>(room, {}, {{1, 0.5}}, way, 0.1)));
}

/// Surface of Box{half * 2} as twelve triangles.
Mesh<3, double> box_mesh(const V3& half) {
    std::vector<V3> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back(V3::map([&](int axis) { return i >> axis & 1 ? half[axis] : -half[axis]; }));
    return {corners,
            {{0, 2, 1},
             {1, 2, 3},
             {4, 5, 6},
             {5, 7, 6},
             {0, 1, 4},
             {1, 5, 4},
             {2, 6, 3},
             {3, 6, 7},
             {0, 4, 2},
             {2, 4, 6},
             {1, 3, 5},
             {3, 7, 5}}};
}

TEST(MeshShape, OfABoxIsAsFarAwayAsTheBox) {
    const V3 half{{0.4, 0.6, 0.9}};
    const Shape<3, double> mesh = box_mesh(half), box = Box<3, double>{half * 2.0};
    Dice dice(7);
    for (int i = 0; i < 2000; ++i) {
        const auto pose = dice.pose<3>();
        const auto point = dice.point<3>(3);
        const auto solid = *nearest(box, pose, point, 1e6), surface = *nearest(mesh, pose, point, 1e6);
        EXPECT_NEAR(surface.distance, solid.distance, 1e-12);
        EXPECT_NEAR(distance(surface.normal, solid.normal), 0, 1e-9);
    }
}

TEST(MeshShape, IsMetByWhatFallsOnIt) {
    const V3 half{{0.4, 0.6, 0.9}};
    const Shape<3, double> mesh = box_mesh(half), box = Box<3, double>{half * 2.0};
    Dice dice(8);
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto pose = dice.pose<3>();
        const auto from = dice.point<3>(5), displacement = (pose.position + dice.point<3>(1) - from) * 1.5;
        if (nearest(box, pose, from, 1e6)->distance < 0.2) continue;
        const auto expected = sweep(box, pose, from, displacement, 0.2),
                   found = sweep(mesh, pose, from, displacement, 0.2);
        ASSERT_EQ(bool(expected), bool(found)) << i;
        if (!found) continue;
        ++met;
        EXPECT_NEAR(found->time, expected->time, 1e-9);
    }
    EXPECT_GT(met, 30);
}

TEST(MeshShape, TheTreeFindsEveryTriangleNearABox) {
    Dice dice(9);
    std::vector<V3> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const auto at = dice.point<3>(5);
        for (int k = 0; k < 3; ++k) corners.push_back(at + dice.point<3>(0.5));
        triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Mesh<3, double> mesh(corners, triangles);
    for (int i = 0; i < 200; ++i) {
        BoundingBox<3, double> near;
        near.include(dice.point<3>(5));
        near = near.grown(dice.between(0, 2));
        std::vector<char> found(300, 0);
        mesh.parts_near(near, [&](const Triangle<double>& part) { found[part.number] = 1; });
        for (std::uint32_t t = 0; t < 300; ++t) {
            BoundingBox<3, double> box;
            for (const auto corner : triangles[t]) box.include(corners[corner]);
            EXPECT_TRUE(found[t] || !box.overlaps(near)) << t;
        }
    }
}

TEST(HeightFieldShape, OfASlopeIsThePlane) {
    HeightField<3, double> field{.columns = 6, .spacing = 0.5, .height = {}};
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column) field.height.push_back(0.3 * column * 0.5 - 0.2 * row * 0.5);
    const auto normal = direction(V3{{-0.3, 1, 0.2}});
    Dice dice(10);
    for (int i = 0; i < 500; ++i) {
        const V3 point{{dice.between(0.6, 1.9), dice.between(-0.4, 0.8), dice.between(0.6, 1.9)}};
        const auto found = nearest<3, double>(field, {}, point, 0.6);
        if (absolute(dot(normal, point)) > 0.59) continue;
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->distance, dot(normal, point), 1e-12);
        EXPECT_NEAR(distance(found->normal, normal), 0, 1e-9);
    }
}

} // namespace
} // namespace sinew::collide::SINEW_TEST_FILE
