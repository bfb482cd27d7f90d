#include "sinew/collide/decompose.h"

#include "tests/collide/shapes.h"

namespace sinew::collide::SINEW_TEST_FILE {
namespace {

using namespace test;

double area(const Corners& corners) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) sum += cross(corners[i], corners[(i + 1) % corners.size()]) / 2;
    return sum;
}

bool holds(const Corners& corners, const Vec2<double>& point) {
    bool inside = false;
    for (std::size_t i = 0, k = corners.size() - 1; i < corners.size(); k = i++)
        if ((corners[i][1] > point[1]) != (corners[k][1] > point[1]) &&
            point[0] < corners[i][0] + (corners[k][0] - corners[i][0]) * (point[1] - corners[i][1]) /
                                           (corners[k][1] - corners[i][1]))
            inside = !inside;
    return inside;
}

/// A star-shaped polygon about the origin with random radii.
Corners random_star(Dice& dice, int corners) {
    Corners star;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * pi<double> * (i + dice.between(0.1, 0.9)) / corners, radius = dice.between(0.2, 2);
        star.push_back({{radius * cosine(angle), radius * sine(angle)}});
    }
    return star;
}

TEST(Decomposition, PartsAreConvexAndCoverThePolygonOnce) {
    Dice dice(3);
    for (int n = 3; n < 30; ++n) {
        auto star = random_star(dice, n);
        if (n % 2) std::reverse(star.begin(), star.end());
        const auto parts = convex_parts(star);
        ASSERT_FALSE(parts.empty());
        double sum = 0;
        for (const auto& part : parts) {
            EXPECT_TRUE(is_convex<double>(part));
            sum += area(part);
        }
        EXPECT_NEAR(sum, absolute(area(star)), 1e-9);
        EXPECT_LE(parts.size(), std::size_t(n - 2));
        for (int i = 0; i < 200; ++i) {
            const auto point = dice.point<2>(2);
            int held = 0;
            for (const auto& part : parts) held += holds(part, point);
            EXPECT_EQ(held, int(holds(star, point)));
        }
    }
}

TEST(Decomposition, AConvexPolygonStaysWhole) {
    EXPECT_EQ(convex_parts(pentagon().corners).size(), 1U);
    EXPECT_EQ(convex_parts(Corners{{{0, 0}}, {{1, 0}}, {{2, 0}}, {{2, 1}}, {{0, 1}}}).size(), 1U); // a straight corner
    EXPECT_EQ(convex_parts(Corners{{{0, 0}}, {{2, 0}}, {{2, 2}}, {{1, 2}}, {{1, 1}}, {{0, 1}}}).size(), 2U); // an L
}

TEST(Decomposition, APolygonThatCrossesItselfHasNoParts) {
    EXPECT_TRUE(convex_parts(Corners{{{0, 0}}, {{1, 1}}, {{1, 0}}, {{0, 1}}}).empty());
    EXPECT_TRUE(convex_parts(Corners{{{0, 0}}, {{1, 1}}, {{2, 2}}}).empty());
    EXPECT_TRUE(convex_parts(Corners{{{0, 0}}, {{1, 1}}}).empty());
}

} // namespace
} // namespace sinew::collide::SINEW_TEST_FILE
