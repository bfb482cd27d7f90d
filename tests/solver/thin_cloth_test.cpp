#include "tests/sheets.h"
#include "tests/worlds.h"

/// Cloth whose faces and edges collide at their own thickness.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class RealT> struct ThinCloth : ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ThinCloth, Precisions);

FigureContactSpec thin() {
    return {.figures = true, .itself = true, .cloth = ClothContactKind::thin, .friction = 0.3};
}

/// Steps a show, and looks for crossings after every step.
template <class Show> void expect_no_crossing_ever(Show& show, double seconds) {
    for (int i = 0; i < int(seconds * 60); ++i) {
        show.advance();
        ASSERT_EQ(count_crossings(show.world), 0U) << Show::name << ' ' << i;
    }
}

// Cloth that begins without crossings never has one; without contact there are hundreds (cloth_contact_test.cpp).
TYPED_TEST(ThinCloth, NeverCrossesWhileItIsDraped) {
    Drape<TypeParam> show({.size = 24, .contact = thin()});
    expect_no_crossing_ever(show, 2);
}
TYPED_TEST(ThinCloth, NeverCrossesWhileItFolds) {
    Fold<TypeParam> show({.size = 24, .contact = thin()});
    expect_no_crossing_ever(show, 2);
}
TYPED_TEST(ThinCloth, NeverCrossesWhileItIsWrung) {
    Twist<TypeParam> show({.size = 24, .contact = thin()});
    expect_no_crossing_ever(show, 3.5);
}
TYPED_TEST(ThinCloth, NeverCrossesWhenItIsThrownOntoTheFloor) {
    using Real = TypeParam;
    Fold<Real> show({.size = 24, .contact = thin()});
    for (const auto id : show.sheet.particles) set_velocity(show.world, id, point<Real>(2, -15, 0));
    expect_no_crossing_ever(show, 1);
}

/// A sheet falls onto another one; its own contact is `upper`.
template <class Real> struct TwoSheets {
    static constexpr const char* name = "two sheets";
    Space<Real> world;
    std::vector<Sheet> sheets;
    explicit TwoSheets(const FigureContactSpec& upper) {
        add_floor(world);
        for (int n = 0; n < 2; ++n)
            sheets.push_back(add_sheet(world, {.size = 16, .contact = n ? upper : thin()}, [n](int i, int k) {
                return point<Real>(0.01 * i + 0.003 * n, 0.02 + 0.03 * n, 0.01 * k + 0.002 * n);
            }));
    }
    void advance() { step(world, Real(1.0 / 60)); }
    double mean_gap() const {
        std::array<double, 2> height{};
        for (std::size_t n = 0; n < 2; ++n)
            for (const auto id : sheets[n].particles) height[n] += double((*position_of(world, id))[1]);
        return (height[1] - height[0]) / double(sheets[0].particles.size());
    }
};

// Layers lie half a cell apart, a third of what spheres need, and rest.
TYPED_TEST(ThinCloth, LiesOnOtherClothHalfACellApart) {
    for (const auto kind : {ClothContactKind::thin, ClothContactKind::spheres}) {
        TwoSheets<TypeParam> show({.figures = true, .cloth = kind, .friction = 0.3});
        expect_no_crossing_ever(show, 3);
        EXPECT_NEAR(show.mean_gap(), 0.005, 0.0005);
        double sum = 0;
        for (const auto& velocity : show.world.particles.velocity) sum += double(norm(velocity));
        EXPECT_LT(sum / double(show.world.particles.size()), 5e-3);
    }
}

// Neighbours in a sheet have their links alone.
TYPED_TEST(ThinCloth, AFlatSheetPushesNothing) {
    using Real = TypeParam;
    Space<Real> world;
    const auto sheet = add_sheet(world, {.size = 16, .contact = thin()},
                                 [](int i, int k) { return point<Real>(0.01 * i, 0, 0.01 * k); });
    run(world, 0.5);
    for (int i = 0; i < sheet.size; ++i)
        for (int k = 0; k < sheet.size; ++k) {
            const auto off = *position_of(world, sheet.at(i, k)) - point<Real>(0.01 * i, 0, 0.01 * k);
            EXPECT_LT(double(norm(off)), 1e-6);
        }
}

// Contacts that come and go by turns would make vertices in creases tremble.
TYPED_TEST(ThinCloth, AHeapRests) {
    Fold<TypeParam> show({.size = 24, .contact = thin()});
    for (int i = 0; i < 600; ++i) show.advance();
    double sum = 0, fastest = 0;
    for (const auto& velocity : show.world.particles.velocity) {
        sum += double(norm(velocity));
        fastest = std::max(fastest, double(norm(velocity)));
    }
    EXPECT_LT(sum / double(show.world.particles.size()), 2e-3);
    EXPECT_LT(fastest, 0.015);
    EXPECT_EQ(count_crossings(show.world), 0U);
}

TYPED_TEST(ThinCloth, CopiesHaveTheSameFuture) {
    using Real = TypeParam;
    Fold<Real> show({.size = 16, .contact = thin()});
    expect_copies_to_go_alike(show);
}

TYPED_TEST(ThinCloth, IsPartOfTheState) {
    using Real = TypeParam;
    Space<Real> world;
    const auto sheet = add_sheet(world, {.size = 3}, [](int i, int k) { return point<Real>(i, 0, k); });
    const auto before = state_hash(world);
    set_contact(world, sheet.figure, {.itself = true, .cloth = ClothContactKind::thin, .friction = 0.3});
    EXPECT_NE(state_hash(world), before);
    set_contact(world, sheet.figure, {.itself = true, .friction = 0.3});
    EXPECT_EQ(state_hash(world), before);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
