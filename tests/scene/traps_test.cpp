#include "sinew/scene/scene.h"
#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>

/// Mistakes that would be accepted without a word, and run otherwise than meant.
namespace sinew::SINEW_TEST_FILE {
namespace {

struct Said {
    std::string errors, warnings;
    bool opened = false;
};

Said said_of(const std::string& scene, const std::string& model = "") {
    auto document = load(scene, "a.json");
    const auto opened = open_scene(
        document, {}, [&](const std::string& name, const Limits& limits) { return read_model(model, name, limits); });
    return {to_text(document.diagnostics), warnings_text(document.diagnostics), opened.has_value()};
}

testing::AssertionResult says(const std::string& text, std::string_view part) {
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "not said: " << part << "\nin: " << text;
}

std::string three(const std::string& constraints, const std::string& more = "") {
    return R"({"sinew": 1, "figures": [{"name": "f", "particles": {"a": {"at": [-1, 0]}, "b": {"at": [0, 0]},
        "c": {"at": [1, 0]}}, "constraints": [)" +
           constraints + "]}]" + more + "}";
}

// A rope that begins in the ground is lifted out of it, with what hangs on its end; no step finds no way at all.
TEST(Ground, LetsOutTheFigureThatBeginsInIt) {
    for (const char* part : {"right_foot", "head"})
        for (const double height : {0.2, 0.8, 1.1}) {
            const auto text = fmt::format(R"({{"sinew": 1, "world": {{"gravity": [0, -9.81]}},
                "colliders": [{{"shape": "half_space", "friction": 0.6}}],
                "figures": [{{"prefab": "rope", "name": "c", "segments": 8, "at": [-0.75, {}]}},
                            {{"prefab": "ragdoll", "name": "r", "at": [1.2, 1.5]}}],
                "constraints": [{{"between": ["c/end", "r/{}"]}}]}})",
                                          height, part);
            auto document = load(text, "a.json");
            auto scene = open_scene(document);
            ASSERT_TRUE(scene) << to_text(document.diagnostics);
            Session session(std::move(*scene));
            for (int i = 0; i < 90; ++i) session.step();
            const auto& world = std::get<World<2, double>>(session.world());
            for (Row row = 0; row < world.particles.size(); ++row) {
                if (world.particles.mobility[row] == 0) continue;
                EXPECT_GE(world.particles.position[row][1], world.particles.radius[row] - 1e-3) << part << height;
            }
        }
}

TEST(Pins, OfASceneThatHoldOneParticleTwiceAreToldBoth) {
    const auto said = said_of(R"({"sinew": 1, "figures": [{"prefab": "rope", "name": "r"}], "pins": [
        {"particle": "r/start"}, {"particle": "r/start", "driver": "bob", "by": [1, 0]}]})");
    EXPECT_TRUE(says(said.errors, "\"r/start\" is held by /pins/0 already, as \"r/start\" at /pins/1/particle"));
    EXPECT_TRUE(said_of(R"({"sinew": 1, "figures": [{"prefab": "rope", "name": "r"}], "pins": [
        {"particle": "r/start", "driver": "bob", "by": [1, 0]}, {"particle": "r/end"}]})")
                    .opened)
        << "a pin of the figure's own is taken over";
    EXPECT_TRUE(said_of(R"({"sinew": 1, "figures": [{"prefab": "rope", "name": "r"}], "pins": [
        {"particle": "r/end", "compliance": 0.1}, {"particle": "r/end", "compliance": 0.1, "to": [1, 0]}]})")
                    .opened)
        << "springs act side by side";
}

TEST(Drive, ThatNeverMovesTellsWhatIsMissing) {
    const auto drive = [](const std::string& text) {
        return said_of(three(R"({"between": ["a", "b"], "high": 2, "drive": )" + text + "}"));
    };
    EXPECT_TRUE(says(drive("{}").errors, "neither a speed nor keys"));
    EXPECT_TRUE(says(drive(R"({"speed": 0})").errors, "neither a speed nor keys"));
    EXPECT_TRUE(says(drive(R"({"speed": 0, "keys": [{"at": 1, "to": 1}]})").errors, "never reached"));
    EXPECT_TRUE(says(drive(R"({"keys": [{"at": 0, "to": 1}]})").errors, "needs a \"speed\""));
    EXPECT_TRUE(says(drive(R"({"keys": [{"at": 1}]})").errors, "its keys have neither \"to\" nor \"strength\""));
    EXPECT_TRUE(says(drive(R"({"speed": 0, "keys": [{"at": 1}]})").errors, "neither \"to\" nor \"strength\""));
    for (const auto* good : {R"({"speed": 1})", R"({"keys": [{"at": 1, "to": 1}]})",
                             R"({"keys": [{"at": 0, "to": 2}]})", R"({"speed": 1, "keys": [{"at": 0, "to": 1}]})"})
        EXPECT_TRUE(drive(good).opened) << good << drive(good).errors;
    const auto join = said_of(three("", R"(, "events": [{"at": 1, "join": ["f/a", "f/c"], "drive": {"speed": 1}}])"));
    EXPECT_TRUE(says(join.errors, "a joined constraint has no drive"));
}

TEST(Drive, OfStrengthsAloneNeedsTheForceThatTheyShare) {
    const auto held = [](const std::string& more) {
        return said_of(
            three(R"({"kind": "angle", "between": ["a", "b", "c"], "drive": {"keys": [{"at": 1, "strength": 0.5}])" +
                  more + "}"));
    };
    const auto said = held("}");
    EXPECT_TRUE(says(said.warnings, "this drive does nothing")) << said.errors;
    EXPECT_TRUE(says(said.warnings, "give the constraint a \"max_force\""));
    EXPECT_TRUE(says(said.warnings, "at /figures/0/constraints/0/drive/keys"));
    EXPECT_TRUE(said.opened);
    EXPECT_EQ(held(R"(}, "max_force": 5)").warnings, "") << "a hinge held at half of its force";
}

TEST(Motor, OfUnlimitedForceAgainstARigidLimitIsRefused) {
    const auto motor = [](const std::string& drive, const std::string& order = R"(["a", "b", "c"])") {
        return said_of(three(R"({"kind": "angle", "between": ["a", "b", "c"], )" + drive +
                             R"(}, {"kind": "angle", "low": -45, "high": 45, "between": )" + order + "}"));
    };
    EXPECT_TRUE(
        says(motor(R"("drive": {"speed": 90})").errors, "against the rigid limits of /figures/0/constraints/1"));
    EXPECT_FALSE(motor(R"("drive": {"speed": 90})", R"(["c", "b", "a"])").opened);
    EXPECT_FALSE(motor(R"("drive": {"keys": [{"at": 1, "to": 50}]})").opened);
    EXPECT_FALSE(motor(R"("drive": {"keys": [{"at": 1, "to": 40}]})").opened) << "one of two rigid rows would win";
    EXPECT_TRUE(motor(R"("max_force": 5, "drive": {"speed": 90})").opened);
    EXPECT_TRUE(motor(R"("compliance": 0.1, "drive": {"speed": 90})").opened);
}

TEST(Angle, InSpaceHasNoSign) {
    const auto angle = [](const std::string& limits) {
        return said_of(R"({"sinew": 1, "dimension": 3, "figures": [{"name": "f", "particles": {"a": {"at": [0, 0, 0]},
            "b": {"at": [1, 0, 0]}, "c": {"at": [2, 0, 0]}}, "constraints": [{"kind": "angle",
            "between": ["a", "b", "c"], )" +
                       limits + "}]}]}");
    };
    EXPECT_TRUE(
        says(angle(R"("low": -10, "high": 90)").errors, "has no sign, found -10 at /figures/0/constraints/0/low"));
    EXPECT_FALSE(angle(R"("rest": -1)").opened);
    EXPECT_FALSE(angle(R"("rest": 0, "max_force": 1, "drive": {"keys": [{"at": 1, "to": -5}]})").opened);
    EXPECT_TRUE(angle(R"("low": 0, "high": 90)").opened);
    EXPECT_TRUE(says(angle(R"("high": 200)").errors, "reaches 180, found 200"));
    EXPECT_TRUE(says(said_of(three(R"({"between": ["a", "b"], "rest": -1})")).errors, "a distance is never negative"));
}

TEST(Adjust, IsCheckedLikeTheConstraintThatItChanges) {
    const auto adjust = [](const std::string& values) {
        return said_of(three(R"({"name": "k", "between": ["a", "b"]})",
                             R"(, "events": [{"at": 1, "adjust": ["f/k"])" + values + "}]"))
            .errors;
    };
    EXPECT_TRUE(says(adjust(R"(, "rest": -1)"), "a distance is never negative, found -1 at /events/0/rest"));
    EXPECT_TRUE(says(adjust(R"(, "high": -1)"), "at /events/0/high"));
    EXPECT_TRUE(says(adjust(""), "an adjust without new values"));
    EXPECT_EQ(adjust(R"(, "rest": 2)"), "");
    EXPECT_EQ(adjust(R"(, "low": -1, "high": 2)"), "") << "no lower limit";
    const auto angle = [](const std::string& values) {
        return said_of(R"({"sinew": 1, "dimension": 3, "figures": [{"name": "f", "particles": {"a": {"at": [0, 0, 0]},
            "b": {"at": [1, 0, 0]}, "c": {"at": [2, 0, 0]}}, "constraints": [{"kind": "angle", "name": "k",
            "between": ["a", "b", "c"]}]}], "events": [{"at": 1, "adjust": ["f/k"], )" +
                       values + "}]}")
            .errors;
    };
    EXPECT_TRUE(says(angle(R"("low": -30)"), "has no sign, found -30 at /events/0/low"));
    EXPECT_TRUE(says(angle(R"("rest": 200)"), "reaches 180, found 200"));
    EXPECT_EQ(angle(R"("low": 0, "high": 180)"), "");
}

TEST(Names, OfCollidersAndOfWhatIsStruckAreTold) {
    EXPECT_TRUE(says(said_of(R"({"sinew": 1, "colliders": [{"name": "wall", "shape": "sphere"},
        {"name": "wall", "shape": "sphere"}]})")
                         .errors,
                     "there is already a collider called \"wall\" at /colliders/1/name"));
    EXPECT_TRUE(says(said_of(R"({"sinew": 1, "figures": [{"prefab": "rope", "name": "line"}],
        "events": [{"at": 1, "impulse": "lien", "by": [1, 0]}]})")
                         .errors,
                     "did you mean \"line\"?"));
}

TEST(Motor, ThatCarriesARangeAlongIsWarnedOf) {
    const auto motor = [](const std::string& limits) {
        return said_of(three(R"({"kind": "angle", "between": ["a", "b", "c"], "max_force": 5, "drive": {"speed": 60})" +
                             limits + "}"))
            .warnings;
    };
    EXPECT_TRUE(
        says(motor(R"(, "low": -35, "high": 35)"), "they never stop it at /figures/0/constraints/0/drive/speed"));
    EXPECT_EQ(motor(""), "");
    EXPECT_EQ(motor(R"(, "low": -35)"), "");
}

TEST(BreakingStrain, OfARigidLinkIsWarnedOf) {
    const auto rope = [](const std::string& more) {
        return said_of(R"({"sinew": 1, "figures": [{"prefab": "rope", "breaking_strain": 0.01)" + more + "}]}");
    };
    EXPECT_TRUE(says(rope("").warnings, "a.json:1:64: warning: a rigid distance is never strained")) << rope("").errors;
    EXPECT_TRUE(rope("").opened);
    const std::string soft_and_rigid = R"({"between": ["a", "b"], "compliance": 1, "breaking_strain": 0.1},
        {"between": ["b", "c"], "breaking_strain": 0.1})";
    EXPECT_TRUE(says(said_of(three(soft_and_rigid)).warnings, "at /figures/0/constraints/1/breaking_strain"));
    EXPECT_EQ(rope(R"(, "compliance": 0.001)").warnings, "");
    EXPECT_EQ(rope(R"(, "break_force": 100)").warnings, "");
    EXPECT_EQ(said_of(R"({"sinew": 1, "figures": [{"prefab": "cloth", "columns": 6, "rows": 6,
        "breaking_strain": 0.1}]})")
                  .warnings,
              "")
        << "cloth tears by what the sweep leaves of its strain";
}

TEST(Path, ThatBeginsElsewhereAtTimeZeroIsAJump) {
    const auto path = [](const std::string& keys) {
        return said_of(R"({"sinew": 1, "figures": [{"prefab": "rope", "at": [1, 2], "pinned": "none"}],
            "pins": [{"particle": "rope/start", "driver": "path", "keys": [)" +
                       keys + "]}]}");
    };
    const auto far = path(R"({"at": 0, "to": [3, 2]}, {"at": 1, "to": [4, 2]})");
    EXPECT_TRUE(says(far.warnings, "a key at time 0 is a jump")) << far.errors;
    EXPECT_TRUE(says(far.warnings, "/pins/0/keys/0"));
    EXPECT_TRUE(far.opened);
    EXPECT_EQ(path(R"({"at": 0, "to": [1, 2]}, {"at": 1, "to": [4, 2]})").warnings, "");
    EXPECT_EQ(path(R"({"at": 0.5, "to": [3, 2]})").warnings, "");
}

constexpr const char* two_triangles = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";

TEST(MeshFile, IsWeldedAndTheNumberTold) {
    const std::string scene = R"({"sinew": 1, "dimension": 3, "figures": [{"prefab": "mesh", "file": "x.obj"}]})";
    const auto welded = said_of(scene, two_triangles);
    EXPECT_TRUE(says(welded.warnings, "2 of the 6 points of \"x.obj\" coincide with others"));
    EXPECT_EQ(welded.warnings.find("parts"), std::string::npos) << "it holds together now";
    const auto apart = said_of(scene, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 3 1 0\nv 2 1 0\nf 1 2 3\nf 4 5 6\n");
    EXPECT_TRUE(says(apart.warnings, "\"x.obj\" falls into 2 parts that nothing joins"));
    EXPECT_EQ(said_of(scene, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").warnings, "");
}

TEST(MeshFile, IsWeldedWherePointsCoincideToRounding) {
    const std::string scene = R"({"sinew": 1, "dimension": 3, "figures": [{"prefab": "mesh", "file": "x.obj"}]})";
    const auto at = [&](const std::string& x) {
        return said_of(scene,
                       "v 100 0 0\nv 101 0 0\nv 100 1 0\nv " + x + " 0 0\nv 101 1 0\nv 100 1 0\nf 1 2 3\nf 4 5 6\n");
    };
    EXPECT_TRUE(says(at("101.0000001").warnings, "2 of the 6 points"));
    EXPECT_TRUE(says(at("100.9999999").warnings, "2 of the 6 points"));
    EXPECT_TRUE(says(at("101.000001").warnings, "1 of the 6 points")) << "further than 1e-7 of the size, 1.4";
}

TEST(Bend, AtALinkThatMayGoSlackHoldsNothing) {
    const auto bend = [](const std::string& link, const std::string& angle) {
        return said_of(three(R"({"between": ["a", "b"]}, {"between": ["b", "c"])" + link + R"(}, {"kind": "angle",
            "between": ["a", "b", "c"])" +
                             angle + "}"));
    };
    for (const char* angle : {"", R"(, "low": -20, "high": 20)"}) {
        const auto slack = bend(R"(, "high": 1)", angle);
        EXPECT_TRUE(says(slack.warnings, "an angle at a link that may go slack")) << angle;
        EXPECT_TRUE(says(slack.warnings, "/figures/0/constraints/2"));
        EXPECT_TRUE(slack.opened);
        EXPECT_EQ(bend("", angle).warnings, "");
        EXPECT_EQ(bend(R"(, "low": 0.5, "high": 1)", angle).warnings, "");
        EXPECT_EQ(bend(R"(, "rest": 1, "compliance": 0.01)", angle).warnings, "");
    }
    EXPECT_EQ(bend(R"(, "high": 1)", R"(, "rest": 0, "compliance": 0.1)").warnings, "") << "a spring, which fades";
    const auto rope = said_of(R"({"sinew": 1, "figures": [{"prefab": "rope"}], "constraints": [
        {"kind": "angle", "between": ["rope/particle_1", "rope/particle_2", "rope/particle_3"], "rest": 0}]})");
    EXPECT_TRUE(says(rope.warnings, "at /constraints/0")) << rope.errors;
}

TEST(Version, ThatIsMissingHidesNothingElse) {
    const auto said = said_of(R"({"figures": [{"prefab": "rope"}], "pins": [{"particle": "rope/nobody"}]})");
    EXPECT_TRUE(says(said.errors, "{\"sinew\": 1, ..."));
    EXPECT_TRUE(says(said.errors, "there is no particle in \"rope\" called \"nobody\""));
    EXPECT_FALSE(said.opened);
}

TEST(Check, TellsTheRestBehindAFigureNamedTwice) {
    const auto said = said_of(R"({"sinew": 1, "figures": [{"prefab": "rope"}, {"prefab": "rope"}],
        "pins": [{"particle": "rope/nobody"}]})");
    EXPECT_TRUE(says(said.errors, "there is already a figure called \"rope\""));
    EXPECT_TRUE(says(said.errors, "called \"nobody\""));
}

TEST(Check, TellsAFigureNamedTwiceBesideAnotherMistakeOfIt) {
    const auto twice = [](const std::string& more) {
        return said_of(R"({"sinew": 1, "figures": [{"name": "b", "prefab": "rope"}, {"name": "b", )" + more + "}]}")
            .errors;
    };
    for (const char* more : {R"("prefab": "rope", "lenght": 3)", R"("prefab": "rpoe")",
                             R"("prefab": "rope", "mass": -3)", R"("prefab": "rope", "at": 3)"})
        EXPECT_TRUE(says(twice(more), "there is already a figure called \"b\" at /figures/1/name")) << more;
    const auto said =
        said_of(R"({"sinew": 1, "figures": [{"prefab": "rope", "nmae": "a"}, {"prefab": "rope", "name": "rope"}]})");
    EXPECT_EQ(said.errors.find("already"), std::string::npos) << "the first may have another name: " << said.errors;
}

TEST(Check, TellsTheNamesInAWorldWithMistakes) {
    const auto world = [](const std::string& text) {
        return said_of(R"({"sinew": 1, "world": {)" + text + R"(}, "figures": [{"prefab": "rope", "name": "r"}],
            "pairs": [{"between": ["bounds", "r"], "friction": 1}]})")
            .errors;
    };
    const std::string forces =
        R"("bounds": {"planes": [{"normal": [0, 1]}]}, "forces": [{"force": "drag", "strength": -1},
        {"force": "attractor", "center": [0, 0], "figure": "nobody"}])";
    EXPECT_TRUE(says(world(forces), "there is no figure \"nobody\" at /world/forces/1/figure"));
    EXPECT_TRUE(says(world(forces), "found the number -1"));
    for (const auto& more : {forces, std::string(R"("bounds": {"bounce": -3})")})
        EXPECT_EQ(world(more).find("no collider or figure"), std::string::npos) << "there are bounds: " << world(more);
}

TEST(ParticleName, WithoutItsFigureIsCompleted) {
    const std::string begin = R"({"sinew": 1, "figures": [{"name": "f", "particles": {"a": {"at": [0, 0]},
        "b": {"at": [1, 0]}}}], "constraints": [{"between": [)";
    EXPECT_TRUE(says(said_of(begin + R"("a", "f/b"]}]})").errors, "did you mean \"f/a\"?"));
    EXPECT_TRUE(says(said_of(begin + R"("x", "f/b"]}]})").errors, "allowed here: f/a, f/b"));
    EXPECT_TRUE(says(said_of(begin + R"("f/aa", "f/b"]}]})").errors, "did you mean \"a\"? (allowed here: a, b)"));
}

TEST(Words, OfOtherEnginesLeadToOurs) {
    const auto in = [](const std::string& text) { return said_of(R"({"sinew": 1, )" + text + "}").errors; };
    EXPECT_TRUE(says(in(R"("colliders": [{"shape": "sphere", "restitution": 1}])"), "did you mean \"bounce\"?"));
    EXPECT_TRUE(says(in(R"("colliders": [{"shape": "circle"}])"), "did you mean \"sphere\"?"));
    EXPECT_TRUE(says(in(R"("colliders": [{"shape": "sphere", "center": [0, 0]}])"), "did you mean \"at\"?"));
    EXPECT_TRUE(says(in(R"("pins": [{"particle": "a", "center": [0, 0]}])"), "did you mean \"to\"?"));
    EXPECT_TRUE(says(in(R"("colliders": [{"circle": 1}])"), "did you mean \"shape: sphere\"?"));
    EXPECT_TRUE(says(in(R"("figures": [{"wheel": 1}])"), "did you mean \"prefab: wheel\"?"));
    EXPECT_TRUE(says(in(R"("figures": [{"prefab": "rope", "position": [0, 1]}])"), "did you mean \"at\"?"));
    EXPECT_TRUE(says(in(R"("figures": [{"prefab": "rope", "density": 1}])"), "did you mean \"mass\"?"));
    EXPECT_TRUE(says(in(R"("figures": [{"prefab": "rope", "pins": "start"}])"), "did you mean \"pinned\"?"));
    EXPECT_TRUE(says(in(R"("figures": [{"constraints": [{"particles": []}]}])"), "did you mean \"between\"?"));
    EXPECT_TRUE(says(in(R"("pins": [{"driver": "orbit", "period": 2}])"), "did you mean \"rate\"?"));
    EXPECT_TRUE(says(in(R"("drivers": [])"), "did you mean \"pins\"?"));
    EXPECT_TRUE(says(in(R"("pins": [{"particle": "a", "speed": 2}])"), "did you mean \"driver\"?"));
    EXPECT_TRUE(says(in(R"("constraints": [{"between": [], "motor": 1}])"), "did you mean \"drive\"?"));
    EXPECT_TRUE(says(in(R"("world": {"dimensions": 3})"), "did you mean \"dimension\" at the top of the file?"));
    EXPECT_TRUE(says(in(R"("colliders": [{"figures": []}])"), "did you mean \"figures\" at the top of the file?"));
    EXPECT_TRUE(says(in(R"("figures": [{"prefab": "rope", "color": "red"}])"), "did you mean \"looks\"?"));
}

TEST(Words, ThatBelongToTheFigureAroundLeadThere) {
    const auto particle = [](const std::string& text) {
        return said_of(
                   R"({"sinew": 1, "figures": [{"prefab": "rope"}, {"name": "b", "particles": {"a": {"at": [0, 0], )" +
                   text + "}}}]}")
            .errors;
    };
    EXPECT_TRUE(says(particle(R"("restitution": 0.4)"), "did you mean \"figures.b.contact.bounce\"?"));
    EXPECT_TRUE(says(particle(R"("friction": 0.4)"), "did you mean \"figures.b.contact.friction\"?"));
    EXPECT_TRUE(says(particle(R"("color": "red")"), "did you mean \"figures.b.looks\"?"));
    EXPECT_TRUE(says(particle(R"("contact": {})"), "did you mean \"figures.b.contact\"?"));
    EXPECT_EQ(particle(R"("wheel": 1)").find("did you mean"), std::string::npos) << "no prefab for a particle";
    const auto constraint =
        said_of(R"({"sinew": 1, "figures": [{"particles": {"a": {"at": [0, 0]}, "b": {"at": [1, 0]}},
        "constraints": [{"between": ["a", "b"], "restitution": 1}]}]})");
    EXPECT_TRUE(says(constraint.errors, "did you mean \"figures.0.contact.bounce\"?"));
}

// All mistakes at once: misspelt keys hide no unknown names, and what follows from a mistake is not told beside it.
TEST(Errors, OfShapeDoNotHideThoseOfNames) {
    const auto said = said_of(R"({"sinew": 1, "figures": [
        {"name": "f", "particles": {"a": {"position": [0, 0]}, "b": {"at": [1, 0]}}, "constraints": [
            {"between": ["a", "nobody"]}, {"between": ["a", "b"], "complience": 1},
            {"between": ["a", "b"], "low": 3, "high": 2}]},
        {"prefab": "rope", "name": "r", "segmnets": 9}, {"prefab": "rope", "name": "s", "segments": 3},
        {"prefab": "rop", "name": "t"}, {"prefab": "box", "name": "s"}],
        "constraints": [{"between": ["f/a", "f/none"]}, {"between": ["r/particle_9", "s/particle_9"]},
                        {"between": ["t/end", "u/end"]}],
        "pins": [{"particle": "s/ned"}, {"particle": "s/start", "driver": "path", "keys": []}],
        "events": [{"at": "soon", "kick": "s/foo", "by": [1, 1]}]})")
                          .errors;
    for (const char* part :
         {"missing property \"at\"", "called \"nobody\"", "\"complience\"", "low (3) is above high", "\"segmnets\"",
          "unknown prefab \"rop\"", "already a figure called \"s\"", "in \"f\" called \"none\"",
          "in \"s\" called \"particle_9\"", "no figure \"u\"", "in \"s\" called \"ned\"", "at least one key",
          "found the string \"soon\"", "in \"s\" called \"foo\""})
        EXPECT_TRUE(says(said, part));
    EXPECT_EQ(said.find("in \"r\""), std::string::npos) << "may be there once segments are spelt: " << said;
    EXPECT_EQ(said.find("figure \"t\""), std::string::npos) << said;
    EXPECT_EQ(said.find("found \"\""), std::string::npos) << said;
}

TEST(Override, ThatIsBrokenIsNoWord) {
    const auto said = [](const std::string& pair) {
        const Override overrides[] = {{pair}};
        auto document = load(R"({"sinew": 1, "figures": [{"prefab": "rope"}]})", "a.json", overrides);
        open_scene(document);
        return to_text(document.diagnostics);
    };
    EXPECT_TRUE(says(said("world.gravity=[0,-9.81"), "the value ends too early"));
    EXPECT_TRUE(says(said("world.gravity=[0,-9.81"), "is not closed"));
    EXPECT_TRUE(says(said("figures.rope.mass=1e400"), "the number 1e400 is too large at /figures/rope/mass"));
    EXPECT_TRUE(says(said("precision=[1"), "at /solver/precision"));
    EXPECT_TRUE(says(said("figures.rope.pinned=nobody"), "expected \"start\", \"end\", \"both\" or \"none\""));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
