#include "sinew/prefab/cloth.h"

#include "tests/sheets.h"
#include "tests/worlds.h"

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class RealT> struct ClothContacts : ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ClothContacts, Precisions);

/// Crossings after some seconds.
template <class Show> std::size_t crossings_after(double seconds, bool itself) {
    Show show({.contact = {.figures = true, .itself = itself, .friction = 0.3}});
    for (int i = 0; i < int(seconds * 60); ++i) show.advance();
    return count_crossings(show.world);
}

// Without contact hundreds of edges pass through faces in the end; with it none does.
TYPED_TEST(ClothContacts, NoEdgePassesThroughAFaceOnceClothIsDraped) {
    EXPECT_EQ(crossings_after<Drape<TypeParam>>(3, true), 0U);
}
TYPED_TEST(ClothContacts, NoEdgePassesThroughAFaceOnceClothIsFolded) {
    EXPECT_EQ(crossings_after<Fold<TypeParam>>(3, true), 0U);
    EXPECT_GT(crossings_after<Fold<TypeParam>>(3, false), 100U);
}
TYPED_TEST(ClothContacts, NoEdgePassesThroughAFaceOnceClothIsTwisted) {
    EXPECT_EQ(crossings_after<Twist<TypeParam>>(4, true), 0U);
    EXPECT_GT(crossings_after<Twist<TypeParam>>(4, false), 100U);
}

TYPED_TEST(ClothContacts, FoldedClothRests) {
    Fold<TypeParam> show({});
    for (int i = 0; i < 600; ++i) show.advance();
    EXPECT_LT(mean_speed(show.world), 5e-3);
}

// Neighbours in a sheet have their links alone, be they as near as they are.
TYPED_TEST(ClothContacts, AFlatSheetPushesNothing) {
    using Real = TypeParam;
    Space<Real> world;
    const auto sheet = add_sheet(world, {}, [](int i, int k) { return point<Real>(0.01 * i, 0, 0.01 * k); });
    run(world, 0.5);
    for (int i = 0; i < sheet.size; ++i)
        for (int k = 0; k < sheet.size; ++k) {
            const auto off = *position_of(world, sheet.at(i, k)) - point<Real>(0.01 * i, 0, 0.01 * k);
            EXPECT_LT(double(norm(off)), 1e-6);
        }
}

/// Stretch of an elastic cloth of 0.6 m that hangs at rest, m.
template <class Real> double stretch_of_elastic_cloth(bool touches) {
    Stepped<3, Real> world;
    fall(world, gravity);
    world.settings.damping = 4;
    const auto cloth = build(world,
                             Cloth{.columns = 7,
                                   .rows = 7,
                                   .spacing = 0.1,
                                   .pins = "top",
                                   .mass = 2,
                                   .elasticity = {0.01},
                                   .shear_elasticity = {0.01},
                                   .drawn = "fill"},
                             "cloth");
    set_contact(world, cloth.figure, {.figures = touches});
    for (int i = 0; i < 5 * 60; ++i) step(world, Real(1.0 / 60));
    return double(world.particles.position[3][1] - world.particles.position[6 * 7 + 3][1]) - 0.6;
}

// Cloth that may touch figures is swept several times an iteration: its springs stay as stiff as they are.
TYPED_TEST(ClothContacts, ElasticClothIsAsStiffWithContacts) {
    const double alone = stretch_of_elastic_cloth<TypeParam>(false);
    EXPECT_GT(alone, 0.05);
    EXPECT_NEAR(stretch_of_elastic_cloth<TypeParam>(true), alone, 0.05 * alone);
}

// Layers of two sheets keep 1.5 cells, and the lower one carries the upper one.
TYPED_TEST(ClothContacts, ASheetLiesOnAnotherOne) {
    using Real = TypeParam;
    constexpr int size = 24;
    Space<Real> world;
    add_floor(world);
    std::vector<Sheet> sheets;
    for (int n = 0; n < 2; ++n)
        sheets.push_back(
            add_sheet(world, {.size = size, .contact = {.figures = true, .friction = 0.3}},
                      [n](int i, int k) { return point<Real>(0.01 * i + 0.003 * n, 0.02 + 0.03 * n, 0.01 * k); }));
    run(world, 3);
    EXPECT_EQ(count_crossings(world), 0U);
    for (const auto id : sheets[1].particles) EXPECT_GT(double((*position_of(world, id))[1]), 0.008);
    EXPECT_LT(mean_speed(world), 5e-3);
}

// A marble of a third of a cell cannot fall through the meshes of a cloth held at its border, which sags a little.
TYPED_TEST(ClothContacts, AMarbleDoesNotFallThroughTheMeshes) {
    using Real = TypeParam;
    constexpr int size = 16;
    Space<Real> world;
    add_floor(world);
    const auto sheet = add_sheet(world, {.size = size, .contact = {.figures = true}},
                                 [](int i, int k) { return point<Real>(0.01 * i, 0.5, 0.01 * k); });
    for (int i = 0; i < size; ++i)
        for (int k = 0; k < size; ++k)
            if (i == 0 || k == 0 || i == size - 1 || k == size - 1) pin(world, sheet.at(i, k));
    const auto figure = add_figure(world, "marble");
    set_contact(world, figure, {.figures = true});
    const auto marble = add_particle(
        world,
        {.position = point<Real>(0.075, 0.55, 0.075), .mass = Real(0.001), .radius = Real(0.0035), .figure = figure});
    for (int i = 0; i < 120; ++i) {
        step(world, Real(1.0 / 60));
        ASSERT_GT(double((*position_of(world, marble))[1]), 0.47) << i;
    }
}

TYPED_TEST(ClothContacts, CopiesHaveTheSameFuture) {
    using Real = TypeParam;
    Fold<Real> show({.size = 20});
    expect_copies_to_go_alike(show);
}

/// Crossings of two single cells: one in the plane of x and z, and another one.
template <class Real, class Place> std::size_t crossings_of_cells(Place&& place) {
    Space<Real> world;
    add_sheet(world, {.size = 2}, [](int i, int k) { return point<Real>(i, 0, k); });
    add_sheet(world, {.size = 2}, place);
    return count_crossings(world);
}

// The corners of a tilted plane are rounded to either side of it.
TYPED_TEST(ClothContacts, LayersInOnePlaneDoNotCross) {
    using Real = TypeParam;
    Space<Real> world;
    for (const double shift : {0.0, 0.0043})
        add_sheet(world, {.size = 16}, [&](int i, int k) {
            const double u = 0.01 * i + shift, v = 0.01 * k + shift;
            return point<Real>(1.3 + 0.6 * u - 0.4 * v, 0.7 + 0.3 * u + 0.8 * v, -2.1 + 0.741 * u + 0.447 * v);
        });
    EXPECT_EQ(count_crossings(world), 0U);
}

TYPED_TEST(ClothContacts, WhatTouchesDoesNotCross) {
    using Real = TypeParam;
    const auto stands_on_the_face = [](int i, int k) { return point<Real>(0.3 * i + 0.25, k, 0.2 * i + 0.1); };
    EXPECT_EQ(crossings_of_cells<Real>(stands_on_the_face), 0U);
    const auto lies_in_the_plane = [](int i, int k) { return point<Real>(0.3 * i + 0.25, 0, 0.2 * k + 0.1); };
    EXPECT_EQ(crossings_of_cells<Real>(lies_in_the_plane), 0U);
    const auto meets_the_rim = [](int i, int k) { return point<Real>(1 + i, k - 0.5, 0.5); };
    EXPECT_EQ(crossings_of_cells<Real>(meets_the_rim), 0U);
}

TYPED_TEST(ClothContacts, ACrossingIsCounted) {
    using Real = TypeParam;
    Space<Real> world;
    add_sheet(world, {.size = 2}, [](int i, int k) { return point<Real>(i, 0, k); });
    EXPECT_EQ(count_crossings(world), 0U);
    add_sheet(world, {.size = 2}, [](int i, int k) { return point<Real>(0.3 * i + 0.25, k - 0.5, 0.2 * i + 0.1); });
    EXPECT_GT(count_crossings(world), 0U);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
