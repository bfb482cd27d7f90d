#include "sinew/math/random.h"

#include "tests/prefab/make.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>

/// OBJ files: what is a mesh is read, what is none is refused with the line.
namespace sinew::SINEW_TEST_FILE {
namespace {

MeshModel good(std::string_view text) {
    auto read = read_obj(text);
    if (const auto* problem = std::get_if<ObjProblem>(&read)) {
        ADD_FAILURE() << problem->line << ": " << problem->message;
        return {};
    }
    return std::get<MeshModel>(std::move(read));
}

void refused(std::string_view text, std::size_t line, std::string_view message, const ObjLimits& limits = {}) {
    const auto read = read_obj(text, limits);
    const auto* problem = std::get_if<ObjProblem>(&read);
    ASSERT_TRUE(problem) << text;
    EXPECT_EQ(problem->line, line) << text;
    EXPECT_NE(problem->message.find(message), std::string::npos) << problem->message;
}

TEST(Obj, ReadsPointsAndFacesInAllTheirWays) {
    const auto model =
        good("# a comment\r\nmtllib x.mtl\r\no sail\n\nv 0 0 0\nv 1 0 0 1.0\n v +1 1.5e0 -2 # here\n\tv\t0 1 0\n"
             "vt 0 0\nvn 0 0 1\ng a b\ns off\nusemtl red\nf 1 2/1 3//1 4/1/1\nf -4 -3 -1\nl 1 2");
    ASSERT_EQ(model.points.size(), 4U);
    EXPECT_EQ(model.points[2], (Vec3<double>{{1, 1.5, -2}}));
    ASSERT_EQ(model.faces(), 2U);
    EXPECT_EQ(std::vector(model.face(0).begin(), model.face(0).end()), (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(std::vector(model.face(1).begin(), model.face(1).end()), (std::vector<std::uint32_t>{0, 1, 3}));
}

TEST(Obj, ABackslashJoinsALineWithTheNext) {
    const auto model = good("v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\nv 1 1 0\nf 1 2\\\r\n4\\\n 3\n# a folder\\\nf 1 2 3\\");
    EXPECT_EQ(model.points.size(), 4U);
    ASSERT_EQ(model.faces(), 2U);
    EXPECT_EQ(std::vector(model.face(0).begin(), model.face(0).end()), (std::vector<std::uint32_t>{0, 1, 3, 2}));
    refused("v 0 0 0\nv 1 \\\n0\nv 0 1 0\n", 2, "found nothing");
    refused("v 0 \\\n0 0\nv 1 0 0\nf 1 2\n", 4, "found 2");
}

TEST(Obj, RefusesWhatIsNoneAndSaysWhere) {
    const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    refused("", 0, "no face");
    refused(three, 0, "no face");
    refused("solid cube\n", 1, "found \"solid\"");
    refused("v 0 0 0\ncurv 1 2\n", 2, "found \"curv\"");
    refused("v 0 0\n", 1, "a coordinate is a number from -1e+06 to 1e+06, found nothing");
    refused("v 0 0 zero\n", 1, "found \"zero\"");
    refused("v 0 nan 0\n", 1, "found \"nan\"");
    refused("v inf 0 0\n", 1, "found \"inf\"");
    refused("v 0 0 1e999\n", 1, "found \"1e999\"");
    refused("v 0 0 2e6\n", 1, "found \"2e6\"");
    refused(three + "f 1 2\n", 4, "three corners or more, found 2");
    refused(three + "f\n", 4, "found 0");
    refused(three + "f 1 2 4\n", 4, "there are 3 points above this line, found a face of point 4");
    refused(three + "f 1 2 0\n", 4, "point 0");
    refused(three + "f 1 2 -4\n", 4, "point -4");
    refused(three + "f 1 2 99999999999999999999\n", 4, "found \"99999999999999999999\"");
    refused(three + "f 1 2 x\n", 4, "found \"x\"");
    refused(three + "f 1 2 /3\n", 4, "found \"/3\"");
    refused(three + "f 1 2 1\n", 4, "found point 1 twice");
    refused(three + "f 1 2 3\nv 0 0 1\n", 5, "more than 3 points", {.points = 3});
    refused(three + "f 1 2 3\nf 1 2 3\n", 5, "more than 5 corners", {.corners = 5});
    refused(std::string("\x7f"
                        "ELF\0\1\2",
                        7),
            1, "found \"?ELF???\"");
    refused(std::string(100'000, 'f'), 1, "...");
    refused(three + std::string(1, '\0') + "\n", 4, "found \"?\"");
}

TEST(Obj, StandsAnythingCutAnywhereAndAnyByteChanged) {
    const std::string whole = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nf -1 -2 -3\n";
    for (std::size_t i = 0; i < whole.size(); ++i) {
        if (const auto cut = read_obj(whole.substr(0, i)); const auto* problem = std::get_if<ObjProblem>(&cut)) {
            EXPECT_FALSE(problem->message.empty());
        }
        for (std::uint64_t n = 0; n < 8; ++n) {
            auto changed = whole;
            changed[i] = char(random::bits(1, i, n));
            const auto read = read_obj(changed);
            const auto* model = std::get_if<MeshModel>(&read);
            if (!model) continue;
            for (const auto corner : model->corners) ASSERT_LT(corner, model->points.size());
        }
    }
}

TEST(Obj, IsWrittenAsItIsRead) {
    MeshModel model{.points = {{{0.1, -1e-7, 1.0 / 3}}, {{1, 2, 3}}, {{5e5, 0, 0}}, {{0, 0, 1}}},
                    .corners = {0, 1, 2, 3, 2, 1, 0},
                    .ends = {3, 7}};
    const auto again = good(to_obj(model));
    EXPECT_EQ(again.points, model.points);
    EXPECT_EQ(again.corners, model.corners);
    EXPECT_EQ(again.ends, model.ends);
}

TEST(MeshPrefab, TiesEachEdgeOnceInTheOrderOfTheFaces) {
    const auto model =
        std::make_shared<const MeshModel>(good("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 3 0\nf 4 3 5\nf 1 2 3 4\n"));
    const auto made = make<3>(Mesh{.size = 0.5, .pin_list = {4}, .mass = 10, .model = model});
    EXPECT_EQ(made.particles(), 5U);
    ASSERT_EQ(made.constraints(), 3U + 3 + 2);
    EXPECT_DOUBLE_EQ(made.mass("vertex_0"), 2);
    EXPECT_DOUBLE_EQ(made.constraint("edge_0").measure, 1); // from the fourth to the third
    EXPECT_DOUBLE_EQ(made.constraint("edge_7").measure, std::sqrt(2.0));
    EXPECT_EQ(made.world.pins.size(), 1U);
    EXPECT_EQ(make<3>(Mesh{.diagonals = false, .model = model}).constraints(), 6U);
    const auto buckles = make<3>(Mesh{.size = 0.5, .buckling = 0.25, .model = model});
    const auto& all = std::get<kind_number<Distance, 3>>(buckles.world.constraints);
    for (Row row = 0; row < all.size(); ++row) EXPECT_DOUBLE_EQ(all.low(row), 0.75 * all.high(row));
    EXPECT_DOUBLE_EQ(all.high(0), 1);
    EXPECT_TRUE(problem_of(Mesh{.pin_list = {5}, .model = model}, 3));
    EXPECT_TRUE(problem_of(Mesh{.pin_list = {0.5}, .model = model}, 3));
}

TEST(MeshPrefab, TiesEachEdgeOnceHoweverManyThereAre) {
    constexpr std::uint32_t side = 100, scatter = 7919; // a prime
    const auto number = [&](std::uint32_t r, std::uint32_t c) { return (r * side + c) * scatter % (side * side); };
    MeshModel model;
    model.points.resize(std::size_t(side) * side);
    for (std::uint32_t r = 0; r < side; ++r)
        for (std::uint32_t c = 0; c < side; ++c) model.points[number(r, c)] = {{double(c), double(r), 0}};
    for (std::uint32_t r = 0; r + 1 < side; ++r)
        for (std::uint32_t c = 0; c + 1 < side; ++c) {
            for (const auto corner : {number(r, c), number(r, c + 1), number(r + 1, c + 1), number(r + 1, c)})
                model.corners.push_back(corner);
            model.ends.push_back(std::uint32_t(model.corners.size()));
        }
    std::set<std::array<Row, 2>> known;
    std::vector<std::array<Row, 2>> edges;
    for (std::size_t apart = 1; apart <= 2; ++apart)
        for (std::size_t i = 0; i < model.corners.size(); ++i) {
            const auto a = model.corners[i], b = model.corners[i / 4 * 4 + (i + apart) % 4];
            const std::array<Row, 2> edge{std::min(a, b), std::max(a, b)};
            if (known.insert(edge).second) edges.push_back(edge);
        }
    const auto made = make<3>(Mesh{.model = std::make_shared<const MeshModel>(std::move(model))});
    const auto& made_edges = std::get<kind_number<Distance, 3>>(made.world.constraints).members.rows;
    EXPECT_EQ(made_edges, edges);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
