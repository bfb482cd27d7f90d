#include "sinew/world/colliders.h"

#include "tests/worlds.h"

/// Polygons that collide in classic mode, the first frame by hand. Lengths in pixels.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;
using Points = std::vector<Vec2<double>>;

struct Polygons : ::testing::Test {
    Stepped<2, double> world;

    Polygons() {
        world.settings.mode = Mode::classic;
        world.settings.frame = 1;
    }
    std::vector<ParticleId> add(const Points& corners, bool collides = true) {
        const auto figure = add_figure(world, "figure" + std::to_string(world.figures.size()));
        set_contact(world, figure, {.figures = collides});
        Piece inside{.mark = Mark::fill};
        std::vector<ParticleId> ids;
        for (const auto& corner : corners) {
            ids.push_back(add_particle(world, {.position = corner, .figure = figure}));
            world.figures[figure].particles.push_back(ids.back());
            inside.particles.push_back(ids.back());
        }
        world.figures[figure].pieces.push_back(inside);
        return ids;
    }
    void expect(const std::vector<ParticleId>& ids, const Points& positions) const {
        for (std::size_t i = 0; i < ids.size(); ++i)
            for (int axis = 0; axis < 2; ++axis)
                EXPECT_NEAR((*position_of(world, ids[i]))[axis], positions[i][axis], 1e-12) << i;
    }
};

const Points box = {{0, 0}, {60, 0}, {60, 60}, {0, 60}};

// The corner is 4 px behind the right edge, a quarter of the way along. It takes half, 2 px; the ends of the edge take
// 0.75 and 0.25 of the other half over 0.75^2 + 0.25^2 = 0.625, so that the point struck moves by 2 px.
TEST_F(Polygons, ACornerAndAnEdgeShareTheOverlap) {
    const auto square = add(box), wedge = add({{56, 15}, {100, -15}, {110, 40}});
    step(world, 1.0);
    expect(square, {{0, 0}, {57.6, 0}, {59.2, 60}, {0, 60}});
    expect(wedge, {{58, 15}, {100, -15}, {110, 40}});
}

TEST_F(Polygons, TheOrderOfTheFiguresDoesNotMatterToAPair) {
    const auto wedge = add({{56, 15}, {100, -15}, {110, 40}}), square = add(box);
    step(world, 1.0);
    expect(square, {{0, 0}, {57.6, 0}, {59.2, 60}, {0, 60}});
    expect(wedge, {{58, 15}, {100, -15}, {110, 40}});
}

TEST_F(Polygons, AnAxisBetweenTwoPolygonsPartsThem) {
    const Points far = {{60.5, 15}, {100, -15}, {110, 40}};
    const auto square = add(box), wedge = add(far);
    step(world, 1.0);
    expect(square, box);
    expect(wedge, far);
}

TEST_F(Polygons, FiguresWithoutContactPassThrough) {
    const Points within = {{56, 15}, {100, -15}, {110, 40}};
    const auto square = add(box), wedge = add(within, false);
    step(world, 1.0);
    expect(square, box);
    expect(wedge, within);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
