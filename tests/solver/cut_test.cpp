#include "sinew/topology/cut.h"

#include "tests/prefab/make.h"
#include "tests/stepped.h"
#include "tests/worlds.h"

/// Cutting: which links go, what goes with them, what is left of the drawing.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

using Plane = test::Stepped<2, double>;
using Position = Vec2<double>;

std::size_t links(const Plane& world) {
    return std::get<kind_number<Distance, 2>>(world.constraints).size();
}

template <class Type> struct Cutting : ::testing::Test {};
TYPED_TEST_SUITE(Cutting, Everywhere, Names);

// Seven particles a unit apart along x.
TYPED_TEST(Cutting, TakesTheLinksThatCrossTheBladeAndNoOther) {
    typename TypeParam::World world;
    const auto ids = chain(world, 7, {}, at<typename TypeParam::Vector>(1, 0));
    EXPECT_EQ(cut(world, Blade{{{2.5, -1}}, {{2.5, 1}}}).links, 1U);
    EXPECT_EQ(cut(world, Blade{{{2.5, -1}}, {{2.5, 1}}}).links, 0U);
    EXPECT_EQ(cut(world, Blade{{{3.5, 0.1}}, {{3.5, 1}}}).links, 0U); // ends before it
    EXPECT_EQ(cut(world, Blade{{{3.9, 0.1}}, {{5.1, 0.1}}, 0.1}).links, 3U);
    const auto& distances = std::get<kind_number<Distance, TypeParam::dimension>>(world.constraints);
    ASSERT_EQ(distances.size(), 2U);
    EXPECT_EQ(distances.members.rows[0], (std::array<Row, 2>{0, 1}));
    EXPECT_EQ(distances.members.rows[1], (std::array<Row, 2>{1, 2}));
}

TEST(Cut, IsWhereTheBladeIsSeenAndNotOutOfSight) {
    test::Stepped<3, double> world;
    chain(world, 4, {{0, 0, -5}}, {{1, 0, 0}});
    const Projection<3> see = [](const Vec3<double>& position) {
        return Position{{position[0] < 0.5 ? std::numeric_limits<double>::infinity() : position[0] + 100, position[1]}};
    };
    EXPECT_EQ(cut(world, Blade{{{100.5, 1}}, {{100.5, -1}}, 0.3}, see).links, 0U);
    EXPECT_EQ(cut(world, Blade{{{101.5, 1}}, {{101.5, -1}}}, see).links, 1U);
    EXPECT_EQ(std::get<0>(world.constraints).members.rows[0], (std::array<Row, 2>{0, 1}));
}

// A square with both diagonals, its area, and an angle at the corner that is left whole.
TEST(Cut, TakesWhatHangsOnALinkAndTellsWhose) {
    Plane world;
    const auto figure = add_figure(world, "square");
    std::vector<ParticleId> p;
    for (const auto& position : {Position{{0, 0}}, Position{{1, 0}}, Position{{1, 1}}, Position{{0, 1}}})
        p.push_back(add_particle(world, {.position = position, .figure = figure}));
    for (std::size_t i = 0; i < 4; ++i) add<Distance>(world, {p[i], p[(i + 1) % 4]}, {.figure = figure});
    add<Area>(world, {p[0], p[1], p[2], p[3]}, {.figure = figure});
    const auto bent = add<Angle>(world, {p[3], p[0], p[1]}, {.figure = figure});
    const auto cut_off = add<Angle>(world, {p[1], p[2], p[3]}, {.figure = figure});
    const auto done = cut(world, Blade{{{0.5, 0.9}}, {{0.5, 1.1}}}); // from 2 to 3
    EXPECT_EQ(done.links, 1U);
    EXPECT_EQ(done.figures, std::vector<FigureIndex>{figure});
    EXPECT_EQ(links(world), 3U);
    EXPECT_EQ((std::get<kind_number<Area, 2>>(world.constraints).size()), 0U);
    EXPECT_TRUE(constraint_state(world, *bent));
    EXPECT_FALSE(constraint_state(world, *cut_off));
}

TEST(Cut, LeavesWhatOnlyKeepsApart) {
    Plane world;
    const auto a = add_particle(world, {}), b = add_particle(world, {.position = {{1, 0}}});
    add<Distance>(world, {a, b}, {.limits = at_least(0.5)});
    const Blade across{{{0.5, -1}}, {{0.5, 1}}};
    EXPECT_EQ(cut(world, across).links, 0U);
    add<Distance>(world, {a, b}, {.limits = at_most(2.0)});
    EXPECT_EQ(cut(world, across).links, 1U);
}

TEST(Cut, TakesTimeInProportionToTheLinks) {
    auto made = make(Cloth{.columns = 400, .rows = 400, .diagonals = "none"});
    const auto before = links(made.world);
    const Blade across{{{-100, -20.03}}, {{100, -20.03}}}; // below row 200
    EXPECT_EQ(cut(made.world, across).links, 400U);        // in a test that would not end if every link met every other
    EXPECT_EQ(links(made.world), before - 400);
}

/// A figure with one piece through all of its particles, which stand on a circle, one linked to the next and the last
/// to the first.
struct DrawnRing {
    Plane world;
    std::vector<ParticleId> p;

    explicit DrawnRing(Mark mark, std::size_t particles = 6) {
        add_figure(world, "it");
        for (std::size_t i = 0; i < particles; ++i) {
            const double turn = 2 * pi<double> * double(i) / double(particles);
            p.push_back(add_particle(world, {.position = {{cosine(turn), sine(turn)}}, .figure = 0}));
        }
        for (std::size_t i = 0; i < particles; ++i) add<Distance>(world, {p[i], p[(i + 1) % particles]}, {.figure = 0});
        world.figures[0].pieces.push_back({.mark = mark, .particles = p, .width = 6, .end_width = 1});
    }

    /// Cuts links by number, the one after each particle.
    void cut_after(std::initializer_list<Row> numbers) {
        std::vector<ConstraintId> ids;
        for (const Row number : numbers)
            ids.push_back({kind_number<Distance, 2>, std::get<0>(world.constraints).handles.id_of(number)});
        cut(world, std::span<const ConstraintId>(ids));
    }

    std::vector<std::vector<int>> pieces() const {
        std::vector<std::vector<int>> numbers;
        for (const auto& piece : world.figures[0].pieces) {
            numbers.emplace_back();
            for (const auto id : piece.particles)
                numbers.back().push_back(int(std::find(p.begin(), p.end(), id) - p.begin()));
        }
        return numbers;
    }
    Mark mark() const { return world.figures[0].pieces.at(0).mark; }
};

using Numbers = std::vector<std::vector<int>>;

TEST(Cut, ALineBecomesShorterLinesAsThickAsTheyWere) {
    for (const Mark mark : {Mark::stroke, Mark::curve, Mark::limb}) {
        DrawnRing drawn(mark);
        drawn.cut_after({1, 4});
        EXPECT_EQ(drawn.pieces(), (Numbers{{0, 1}, {2, 3, 4}, {5}}));
        EXPECT_EQ(drawn.mark(), mark);
        EXPECT_EQ(drawn.world.figures[0].pieces[1].width, 4);
        EXPECT_EQ(drawn.world.figures[0].pieces[1].end_width, 2);
        EXPECT_EQ(drawn.world.figures[0].pieces[2].mark, Mark::dot) << "a stump";
        EXPECT_EQ(drawn.world.figures[0].pieces[2].width, 1);
    }
}

TEST(Cut, ALimbOfOneBoneLeavesAStumpAtEitherEnd) {
    DrawnRing bone(Mark::stroke, 2);
    bone.cut_after({0});
    EXPECT_EQ(bone.pieces(), (Numbers{{0}, {1}}));
    for (const auto& piece : bone.world.figures[0].pieces) EXPECT_EQ(piece.mark, Mark::dot);
}

TEST(Cut, ClosedLinesOpenAndFilledOnesFallApart) {
    DrawnRing loop(Mark::loop);
    loop.cut_after({2});
    EXPECT_EQ(loop.pieces(), (Numbers{{3, 4, 5, 0, 1, 2}}));
    EXPECT_EQ(loop.mark(), Mark::stroke);
    loop.cut_after({4}); // the sixth link is the fifth now
    EXPECT_EQ(loop.pieces(), (Numbers{{3, 4, 5}, {0, 1, 2}}));

    DrawnRing fill(Mark::fill);
    fill.cut_after({2});
    EXPECT_EQ(fill.pieces(), (Numbers{{0, 1, 2, 3, 4, 5}}));
    DrawnRing halves(Mark::fill);
    halves.cut_after({2, 5});
    EXPECT_EQ(halves.pieces(), (Numbers{{3, 4, 5}, {0, 1, 2}}));
}

TEST(Cut, APatchAndARingGoAndATipStaysAtItsEnd) {
    DrawnRing patch(Mark::surface, 4);
    patch.cut_after({3});
    EXPECT_EQ(patch.pieces(), Numbers{});
    DrawnRing tip(Mark::tip, 3);
    tip.cut_after({1});
    EXPECT_EQ(tip.pieces(), Numbers{{2}});
    EXPECT_EQ(tip.mark(), Mark::dot);
    DrawnRing dots(Mark::dot);
    dots.cut_after({0, 1, 2});
    EXPECT_EQ(dots.pieces(), (Numbers{{0, 1, 2, 3, 4, 5}}));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
