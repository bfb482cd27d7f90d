#include "tests/stepped.h"
#include "tests/worlds.h"

#include <cmath>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

/// A mat of threads, too many loops for a block, hung by its upper corners; a rope of ten links from the middle of its
/// lower edge, with a weight on its end.
struct Mat {
    test::Stepped<2, double> world;
    std::vector<ParticleId> mat, rope;
    std::vector<ConstraintId> links;

    explicit Mat(double weight) {
        constexpr int side = 11;
        fall(world, gravity);
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) mat.push_back(add_particle(world, {.position = {{0.1 * i, -0.1 * j}}}));
        const auto at = [&](int i, int j) { return mat[std::size_t(j * side + i)]; };
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) {
                if (i + 1 < side) add<Distance>(world, {at(i, j), at(i + 1, j)}, {});
                if (j + 1 < side) add<Distance>(world, {at(i, j), at(i, j + 1)}, {});
                if (i + 1 < side && j + 1 < side) add<Distance>(world, {at(i, j), at(i + 1, j + 1)}, {});
            }
        for (int i = 0; i < side; ++i) pin(world, at(i, 0));
        auto above = at(side / 2, side - 1);
        for (int k = 1; k <= 10; ++k) {
            const auto next = add_particle(world, {.position = {{0.5, -1 - 0.1 * k}}, .mass = 0.1});
            links.push_back(*add<Distance>(world, {above, next}, {.limits = at_most(0.1)}));
            rope.push_back(above = next);
        }
        set_mass(world, rope.back(), weight);
    }

    double worst_rope_stretch() {
        double worst = 0;
        for (const auto id : links) worst = std::max(worst, constraint_state(world, id)->error / 0.1);
        return worst;
    }
};

TEST(Hanging, ARopeOnAClothDoesNotStretchWhateverHangsOnIt) {
    for (const double weight : {0.1, 10.0, 100.0, 1000.0}) {
        Mat mat(weight);
        const double bound = weight > 100 ? 0.1 : 1e-6; // draws out the mat: measured 0.05
        for (int frame = 0; frame < 120; ++frame) {
            step(mat.world, 1.0 / 60);
            EXPECT_LT(mat.worst_rope_stretch(), bound) << "weight " << weight << ", frame " << frame;
        }
        EXPECT_EQ(mat.world.solver.blocks.list.size(), 0u);
        EXPECT_EQ(mat.world.solver.blocks.attached_trees.size(), 1u);
    }
}

TEST(Hanging, ItsTensionIsTheWeightBelow) {
    Mat mat(10);
    mat.world.settings.damping = 3;
    run(mat.world, 6);
    for (std::size_t k = 0; k < 10; ++k) {
        const double below = (10 + 0.1 * double(9 - k)) * gravity;
        EXPECT_NEAR(constraint_state(mat.world, mat.links[k])->tension / below, 1, 2e-2) << k;
    }
}

TEST(Hanging, ACopyGoesTheSameWay) {
    Mat mat(3);
    run(mat.world, 0.5);
    auto copy = mat.world;
    run(mat.world, 0.5);
    run(copy, 0.5);
    EXPECT_EQ(state_hash(copy), state_hash(mat.world));
}

TEST(Hanging, LooseItKeepsItsMomentum) {
    Mat mat(3);
    while (!mat.world.pins.empty()) unpin(mat.world, mat.world.pin_handles.id_of(0));
    mat.world.forces.clear();
    set_velocity(mat.world, mat.rope.back(), {{5, -2}});
    const auto before = momentum(mat.world);
    run(mat.world, 2);
    EXPECT_LT(norm(momentum(mat.world) - before), 1e-9);
    EXPECT_LT(mat.worst_rope_stretch(), 1e-6);
}

TEST(Hanging, CutWhatStillHangsIsFoundAgain) {
    Mat mat(1);
    prepare(mat.world);
    EXPECT_EQ(mat.world.solver.blocks.attached_trees.size(), 1u);
    remove_constraints(mat.world, std::span<const ConstraintId>(&mat.links[8], 1)); // one link is left of its end
    prepare(mat.world);
    ASSERT_EQ(mat.world.solver.blocks.attached_trees.size(), 1u);
    EXPECT_EQ(mat.world.solver.blocks.attached_trees[0].links - mat.world.solver.blocks.attached_trees[0].load_tethers,
              8u);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
