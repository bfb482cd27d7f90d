#include "sinew/scene/reader.h"
#include "sinew/scene/text.h"
#include "sinew/session/session.h"
#include "sinew/session/session_snapshot.h"
#include "sinew/world/edit.h"
#include "sinew/world/measure.h"

#include <cmath>
#include <gtest/gtest.h>

/// Bounce and friction of pairs: the section "pairs".
namespace sinew::SINEW_TEST_FILE {
namespace {

std::optional<Opened> opened(const std::string& text) {
    auto document = load(text, "pairs");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics) << text;
    return opened;
}
Session play(const std::string& text) {
    auto scene = opened(text);
    return Session(scene ? std::move(*scene) : Opened{});
}
std::string told(const std::string& rest) {
    auto document = load(R"({"sinew": 1, "colliders": [{"name": "floor", "shape": "half_space"}, {"shape": "sphere"}],
        "figures": [{"prefab": "box", "name": "a"}, {"prefab": "box", "name": "b", "at": [3, 3]}], "pairs": [)" +
                             rest + "]}",
                         "pairs");
    EXPECT_FALSE(open_scene(document)) << rest;
    return to_text(document.diagnostics);
}

/// Mean position and velocity of a figure.
struct Mean {
    Point at, velocity;
};
Mean mean_of(const Session& session, std::string_view name) {
    Mean mean;
    std::visit(
        [&]<class WorldT>(const WorldT& world) {
            const auto figure = find_figure(world, name);
            double mass = 0;
            for (Row row = 0; row < world.particles.size(); ++row) {
                if (world.particles.figure[row] != *figure) continue;
                const double own = 1 / double(world.particles.inverse_mass[row]);
                mass += own;
                for (int i = 0; i < WorldT::dimension; ++i) {
                    mean.at[i] += own * double(world.particles.position[row][i]);
                    mean.velocity[i] += own * double(world.particles.velocity[row][i]);
                }
            }
            for (int i = 0; i < 3; ++i) mean.at[i] /= mass, mean.velocity[i] /= mass;
        },
        session.world());
    return mean;
}

struct Kind {
    int dimension;
    const char* precision;
    const char* figure;
    double height; ///< of its middle above the floor
};
void PrintTo(const Kind& kind, std::ostream* out) {
    *out << kind.dimension << "D, " << kind.precision << ", " << kind.figure;
}
constexpr const char* crate = R"("prefab": "box", "dot": 0)";
constexpr const char* rod =
    R"("particles": {"p": {"at": [-0.3, 0], "radius": 0.25}, "q": {"at": [0.3, 0], "radius": 0.25}},
    "constraints": [{"between": ["p", "q"]}])";
constexpr const char* rod_3d =
    R"("particles": {"p": {"at": [-0.3, 0, 0], "radius": 0.25}, "q": {"at": [0.3, 0, 0], "radius": 0.25}},
    "constraints": [{"between": ["p", "q"]}])";

struct Pairs : ::testing::TestWithParam<Kind> {
    /// Two figures of the kind, "a" and "b", on a collider "floor", under a gravity that leans, with these pairs.
    Session session(double along, double drop, std::string_view floor, std::string_view pairs) const {
        const auto& kind = GetParam();
        const auto* z = kind.dimension == 3 ? ", 0" : "";
        const auto figure = [&](const char* name, double x) {
            return concat(R"({"name": ")", name, R"(", )", kind.figure, R"(, "at": [)", std::to_string(x), ", ",
                          std::to_string(kind.height + drop), z, "]}");
        };
        return play(concat(R"({"sinew": 1, "dimension": )", kind.dimension, R"(, "solver": {"precision": ")",
                           kind.precision, R"("}, "world": {"gravity": [)", std::to_string(along), ", -10", z,
                           R"(]}, "colliders": [{"name": "floor", "shape": "half_space", )", floor,
                           R"(}], "figures": [)", figure("a", 0), ", ", figure("b", 5), R"(], "pairs": [)", pairs,
                           "]}"));
    }
};

// Coulomb: acceleration g (sin - mu cos), here by gravity that leans; nothing moves where mu is larger than the slope.
TEST_P(Pairs, SlideByTheirFriction) {
    constexpr double along = 3, g = 10, mu = 0.05;
    auto session = this->session(along, 0, R"("friction": 0.5)", R"({"between": ["a", "floor"], "friction": 0.05})");
    session.run_until(1);
    EXPECT_NEAR(mean_of(session, "a").velocity[0], along - mu * g, 0.02 * along);
    EXPECT_NEAR(mean_of(session, "b").at[0], 5, 0.01) << "which no pair names";
}

TEST_P(Pairs, HoldByTheirFriction) {
    auto session = this->session(3, 0, R"("friction": 0)", R"({"between": ["floor", "b"], "friction": 0.4})");
    session.run_until(1);
    EXPECT_NEAR(mean_of(session, "a").velocity[0], 3, 0.03);
    EXPECT_NEAR(mean_of(session, "b").at[0], 5, 0.01);
}

// Newton's law of restitution: a drop of h ends e h^2 up.
TEST_P(Pairs, ReboundByTheirBounce) {
    constexpr double drop = 1, e = 0.8;
    auto session = this->session(0, drop, R"("bounce": 0)", R"({"between": ["a", "floor"], "bounce": 0.8})");
    double highest = 0;
    const double fall = std::sqrt(2 * drop / 10);
    session.run_until(fall + 0.05);
    for (int i = 0; i < 60; ++i) {
        session.step();
        highest = std::max(highest, mean_of(session, "a").at[1] - GetParam().height);
    }
    EXPECT_NEAR(highest, e * e * drop, 0.03);
    EXPECT_NEAR(mean_of(session, "b").at[1], GetParam().height, 0.01);
}

TEST_P(Pairs, GoOnAlikeAfterASnapshot) {
    auto session =
        this->session(3, 0.3, R"("friction": 0.5)", R"({"between": ["a", "floor"], "friction": 0.05, "bounce": 0.5})");
    session.run_until(0.4);
    SnapshotError error;
    auto restored = session_of(
        save(session), [](const std::string& text, const std::string&) { return opened(text); }, error);
    ASSERT_TRUE(restored) << error.text();
    for (int i = 0; i < 20; ++i) session.step(), restored->step();
    EXPECT_EQ(session.report().hash, restored->report().hash);
}

INSTANTIATE_TEST_SUITE_P(Everywhere, Pairs,
                         ::testing::Values(Kind{2, "double", crate, 0.25}, Kind{2, "float", crate, 0.25},
                                           Kind{3, "double", crate, 0.25}, Kind{3, "float", crate, 0.25},
                                           Kind{2, "double", rod, 0.25}, Kind{2, "float", rod, 0.25},
                                           Kind{3, "double", rod_3d, 0.25}, Kind{3, "float", rod_3d, 0.25}));

// Balls of one mass: the struck one leaves with (1 + e)/2 of the speed.
TEST(PairOfFigures, BouncesApart) {
    for (const auto* precision : {"float", "double"})
        for (const double e : {0.0, 0.5, 1.0}) {
            const auto ball = [](const char* name, double x, double y, double speed) {
                return concat(R"({"name": ")", name, R"(", "particles": {"p": {"at": [)", std::to_string(x), ", ",
                              std::to_string(y), R"(], "radius": 0.1}}, "velocity": [)", std::to_string(speed),
                              R"(, 0], "contact": {"figures": true, "friction": 0}})");
            };
            auto session = play(concat(R"({"sinew": 1, "solver": {"precision": ")", precision,
                                       R"("}, "world": {"gravity": [0, 0]}, "figures": [)", ball("a", 0, 0, 2), ", ",
                                       ball("b", 1, 0, 0), ", ", ball("c", 0, 5, 2), ", ", ball("d", 1, 5, 0),
                                       R"(], "pairs": [{"between": ["b", "a"], "bounce": )", std::to_string(e), "}]}"));
            session.run_until(1);
            EXPECT_NEAR(mean_of(session, "b").velocity[0], 1 + e, 1e-3);
            EXPECT_NEAR(mean_of(session, "a").velocity[0], 1 - e, 1e-3);
            EXPECT_NEAR(mean_of(session, "d").velocity[0], 1, 1e-3) << "which no pair names";
        }
}

TEST(PairOfFigures, WithTheWallsOfTheWorld) {
    auto session = play(
        R"({"sinew": 1, "world": {"gravity": [3, -10], "bounds": {"box": [[-100, 0], [100, 100]], "friction": 0.5}},
        "figures": [{"prefab": "box", "name": "a", "dot": 0, "at": [0, 0.25]},
        {"prefab": "box", "name": "b", "dot": 0, "at": [5, 0.25]}], "pairs": [{"between": ["a", "bounds"], "friction": 0}]})");
    session.run_until(1);
    EXPECT_NEAR(mean_of(session, "a").velocity[0], 3, 0.03);
    EXPECT_NEAR(mean_of(session, "b").at[0], 5, 0.01);
}

TEST(PairOfFigures, IsCheckedLikeAnyReference) {
    EXPECT_NE(told(R"({"between": ["a", "flor"], "bounce": 1})").find("did you mean \"floor\""), std::string::npos);
    EXPECT_NE(told(R"({"between": ["a", ""], "bounce": 1})").find("no collider or figure \"\""), std::string::npos);
    EXPECT_NE(told(R"({"between": ["floor", "floor"], "bounce": 1})").find("two colliders"), std::string::npos);
    EXPECT_NE(told(R"({"between": ["a", "b"]})").find("a pair without numbers"), std::string::npos);
    EXPECT_NE(told(R"({"between": ["a"], "bounce": 1})").find("an array of 2"), std::string::npos);
    EXPECT_NE(told(R"({"between": ["a", "b"], "bounce": 2})").find("bounce"), std::string::npos);
    EXPECT_NE(told(R"({"between": ["a", "b/top_left"], "bounce": 1})").find("expected a figure or a collider"),
              std::string::npos);
    EXPECT_NE(told(R"({"between": ["a", "b"], "bounce": 1}, {"between": ["b", "a"], "friction": 1})").find("already"),
              std::string::npos);
    EXPECT_NE(told(R"({"between": ["a", "bounds"], "bounce": 1})").find("no collider or figure \"bounds\""),
              std::string::npos);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
