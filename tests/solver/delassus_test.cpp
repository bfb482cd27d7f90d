#include "sinew/prefab/prefabs.h"
#include "sinew/solver/contact/delassus.h"
#include "sinew/world/colliders.h"

#include "tests/dice.h"
#include "tests/prefab/make.h"
#include "tests/worlds.h"

#include <algorithm>
#include <string>

/// The Delassus operator foretells how the contacts of whole figures move.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Delassus : ::testing::Test {};
TYPED_TEST_SUITE(Delassus, Everywhere, Names);

/// A ragdoll, a limb and loose balls in a heap in a bin, once they have fallen; the solver of their rows.
template <int D, class Real> detail::RowSolver<D, Real> drop_heap(Stepped<D, Real>& world) {
    fall(world, 10);
    world.bounds.push_back({Vec<D, Real>::axis(1)});
    for (int k = 0; k < D; k += 2)
        for (const Real side : {Real(1), Real(-1)}) world.bounds.push_back({Vec<D, Real>::axis(k) * side, Real(-0.5)});
    const auto drop = [&](const auto& prefab, const std::string& name, double x, double y) {
        build(world, prefab, name, Placement<D, Real>{.at = at<Vec<D, Real>>(x, y)});
    };
    drop(Ragdoll{}, "doll", 0, 1.2);
    drop(Limb{.pinned = false}, "limb", 0.1, 2.4);
    for (int i = 0; i < 4; ++i)
        drop(Ball{.radius = 0.1, .mass = 3}, "ball_" + std::to_string(i), 0.05 * i, 2.5 + 0.3 * i);
    for (FigureIndex i = 0; i < world.figures.size(); ++i)
        set_contact(world, i, {.figures = true, .friction = 0.4, .bounce = 0.3});
    run(world, 1.2);
    return {world.solver.sweep_state, Real(1e6)};
}

TYPED_TEST(Delassus, ForetellsWhatFiguresDo) {
    constexpr int D = TypeParam::dimension;
    using Real = typename TypeParam::Real;
    using Vector = Vec<D, Real>;
    Stepped<D, Real> world;
    const auto rows = drop_heap(world);
    auto& state = world.solver.sweep_state;
    auto& room = contact_room(world.solver);
    detail::Delassus<D, Real> figures(room, state, rows);
    std::size_t count = 0;
    figures.begin([&](const auto& add) {
        for (auto& part : room.parts.list)
            for (auto& row : part.rows) add(row), ++count;
    });
    ASSERT_GT(count, 4U);

    Dice dice(7);
    std::vector<Vector> pushed(count), before;
    for (std::size_t i = 0; i < count; ++i) before.push_back(figures.moved(i));

    for (std::size_t i = 0; i < count; ++i) {
        for (int k = 0; k < D; ++k) pushed[i][k] = Real(dice.between(-1, 1));
        figures.push(i, pushed[i]);
    }
    std::vector<Vector> foretold;
    double furthest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        foretold.push_back(figures.moved(i));
        furthest = std::max(furthest, double(norm(foretold[i] - before[i])));
    }
    figures.finish();
    const double slight = sizeof(Real) == sizeof(float) ? 1e-4 : 1e-9;
    ASSERT_GT(furthest, 1e-3);
    for (std::size_t i = 0; i < count; ++i)
        EXPECT_LT(double(norm(figures.moved(i) - foretold[i])), slight * furthest)
            << "contact " << i << " of " << count;
}

/// A contact of light bodies moves further, by as much as its own response tells.
TYPED_TEST(Delassus, KnowsTheMassThatAContactFeels) {
    constexpr int D = TypeParam::dimension;
    using Real = typename TypeParam::Real;
    using Vector = Vec<D, Real>;
    Stepped<D, Real> world;
    const auto rows = drop_heap(world);
    auto& state = world.solver.sweep_state;
    auto& room = contact_room(world.solver);
    for (auto& part : room.parts.list)
        for (auto& row : part.rows) {
            detail::Delassus<D, Real> figures(room, state, rows);
            figures.begin([&](const auto& add) { add(row); });
            const Real mass = figures.mass_along(0, row.normal);
            ASSERT_GT(mass, Real(0));
            const Vector before = figures.moved(0);
            figures.push(0, row.normal * mass);
            EXPECT_NEAR(double(dot(row.normal, figures.moved(0) - before)), 1, 1e-3);
            figures.push(0, row.normal * -mass);
            figures.finish();
        }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
