#include "sinew/scene/scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

/// Scenes that run, and hardly as their authors mean: each is told why, and none that is meant.
namespace sinew::SINEW_TEST_FILE {
namespace {

struct Said {
    std::string errors, warnings;
};

Said said_of(const std::string& scene, const std::vector<Override>& overrides = {}) {
    auto document = load(scene, "a.json", overrides);
    open_scene(document);
    return {to_text(document.diagnostics), warnings_text(document.diagnostics)};
}

/// A scene of the members given.
Said of(const std::string& members) {
    return said_of(R"({"sinew": 1, )" + members + "}");
}

testing::AssertionResult says(const std::string& text, std::string_view part) {
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "not said: " << part << "\nin: " << text;
}

testing::AssertionResult is_silent(const Said& said) {
    if (said.errors.empty() && said.warnings.empty()) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "said: " << said.errors << said.warnings;
}

/// A figure of three particles in a row, with constraints.
std::string three(const std::string& constraints) {
    return R"("figures": [{"name": "f", "particles": {"a": {"at": [-1, 0]}, "b": {"at": [0, 0]}, "c": {"at": [1, 0]}},
        "constraints": [)" +
           constraints + "]}]";
}

TEST(Strength, AboveTheLargestForceIsNeverReached) {
    const auto link = [](const std::string& more) { return of(three(R"({"between": ["a", "b"], )" + more + "}")); };
    EXPECT_TRUE(says(link(R"("max_force": 5, "break_force": 9)").warnings,
                     "a break_force of 9 is never reached: the force is 5 at most, the max_force at "
                     "/figures/0/constraints/0/break_force"));
    EXPECT_TRUE(says(link(R"("max_force": 5, "break_force": 5, "compliance": 0.1)").warnings, "never reached"));
    EXPECT_TRUE(is_silent(link(R"("max_force": 5, "break_force": 4)")));
    EXPECT_TRUE(is_silent(link(R"("break_force": 9)")));
    EXPECT_TRUE(is_silent(link(R"("max_force": 5, "break_force": 9, "drive": {"speed": 1, "keys": [
        {"at": 1, "strength": 2}]})")))
        << "the keys give it 10 N";
    const auto named = R"({"name": "k", "between": ["a", "b"], "max_force": 5, "break_force": 9})";
    for (const char* name : {"f/k", "f/*"})
        EXPECT_TRUE(
            is_silent(of(three(named) + R"(, "events": [{"at": 1, "adjust": [")" + name + R"("], "max_force": 20}])")))
            << name;
    EXPECT_TRUE(says(of(three("") + R"(, "events": [{"at": 1, "join": ["f/a", "f/b"], "max_force": 5,
        "break_force": 9}])")
                         .warnings,
                     "at /events/0/break_force"));
}

TEST(Strength, OfALengthThatSlipsBeforeItIsStrainedSoFar) {
    const auto link = [](const std::string& more) { return of(three(R"({"between": ["a", "b"], )" + more + "}")); };
    // 5 N at 0.01 m/N are 0.05 m of a length of 1 m.
    const std::string slips = R"("compliance": 0.01, "max_force": 5, "breaking_strain": )";
    for (const char* rest : {"", R"(, "rest": 1)", R"(, "high": 1)"}) {
        EXPECT_TRUE(says(link(slips + "0.06" + rest).warnings,
                         "a breaking_strain of 0.06 is never reached: beyond a strain of 0.05"))
            << rest;
        EXPECT_TRUE(is_silent(link(slips + "0.04" + rest))) << rest;
    }
    EXPECT_TRUE(is_silent(of(three(R"({"kind": "angle", "between": ["a", "b", "c"], "compliance": 0.01, "max_force": 5,
        "breaking_strain": 0.5})"))))
        << "an angle gives way, and is strained the more";
}

TEST(Damage, NeedsTheStrainBeyondWhichItAddsUp) {
    const std::string message = "a damage_limit does nothing without a breaking_strain";
    EXPECT_TRUE(says(of(three(R"({"between": ["a", "b"], "damage_limit": 0.3})")).warnings, message));
    for (const char* prefab : {"rope", "chain", "cloth"}) {
        const auto figure = fmt::format(R"("figures": [{{"prefab": "{}", "damage_limit": 1)", prefab);
        EXPECT_TRUE(
            says(of(figure + "}]").warnings, message + ", beyond which damage adds up at /figures/0/damage_limit"))
            << prefab << of(figure + "}]").errors;
        EXPECT_EQ(of(figure + R"(, "breaking_strain": 0.1}])").warnings.find(message), std::string::npos) << prefab;
    }
    EXPECT_TRUE(is_silent(of(R"("figures": [{"prefab": "curtain"}])"))) << "with a strain of its own";
}

TEST(RandomPush, FromHighToLowIsAnError) {
    const auto push = [](const std::string& range) {
        return of(R"("world": {"forces": [{"force": "random_push", )" + range +
                  R"(}]}, "figures": [{"prefab": "rope"}])");
    };
    EXPECT_TRUE(
        says(push(R"("low": [5, 0], "high": [0, 0])").errors, "low (5) is above high (0) at /world/forces/0/low/0"));
    EXPECT_TRUE(says(push(R"("low": [0, 2], "high": [0, 1])").errors, "at /world/forces/0/low/1"));
    EXPECT_TRUE(is_silent(push(R"("low": [-1, 0], "high": [1, 0])")));
}

TEST(Wind, WithADragCoefficientNeedsADensity) {
    for (const auto& [wind, place] :
         {std::pair(R"("world": {"forces": [{"force": "wind", "velocity": [3, 0]%}]})",
                    "/world/forces/0/drag_coefficient"),
          std::pair(R"("events": [{"at": 1, "gust": [3, 0]%}])", "/events/0/drag_coefficient")}) {
        const auto with = [&](const std::string& more) {
            auto text = std::string(wind);
            return of(text.replace(text.find('%'), 1, more) + R"(, "figures": [{"prefab": "rope"}])");
        };
        EXPECT_TRUE(says(with(R"(, "drag_coefficient": 2)").warnings,
                         "a drag_coefficient does nothing without a density of the air at " + std::string(place)));
        EXPECT_TRUE(is_silent(with(R"(, "drag_coefficient": 2, "density": 1.2)")));
        EXPECT_TRUE(is_silent(with(R"(, "strength": 1)")));
    }
}

TEST(Blow, ToWhatIsPinnedDoesNothing) {
    const auto blow = [](const std::string& more, const std::string& events = "") {
        return of(R"("figures": [{"prefab": "rope", "name": "r"}], "events": [{"at": 1, )" + more +
                  R"(, "by": [1, 0]})" + events + "]");
    };
    EXPECT_TRUE(says(blow(R"("impulse": "r/start")").warnings,
                     "\"r/start\" is pinned: this impulse does nothing at /events/0/impulse"));
    EXPECT_TRUE(says(blow(R"("kick": "r/start")").warnings, "this kick does nothing"));
    for (const char* free : {R"("impulse": "r/end")", R"("impulse": "r")", R"("kick": "r/particle_*")"})
        EXPECT_TRUE(is_silent(blow(free))) << free;
    const auto release = [&](const std::string& when) {
        return blow(R"("impulse": "r/start")", ", {" + when + R"(, "release": "r/start"})").warnings;
    };
    EXPECT_EQ(release(R"("at": 0.5)"), "");
    EXPECT_EQ(release(R"("at": 1)"), "");
    EXPECT_TRUE(says(release(R"("at": 2)"), "does nothing"));
    EXPECT_EQ(blow(R"("every": 1, "impulse": "r/start")", R"(, {"at": 2, "release": "r/start"})").warnings, "")
        << "it moves from then on";
    const auto pinned = of(R"("figures": [{"prefab": "box", "name": "b"}], "pins": [{"particle": "b/*"}],
        "events": [{"at": 1, "impulse": "b", "by": [1, 0]}])");
    EXPECT_TRUE(says(pinned.warnings, "\"b\" is pinned"));
}

/// Two balls over a floor, with contact of each and an event.
Said balls(const std::string& one, const std::string& other, const std::string& on, const std::string& more = "") {
    const auto ball = [](const char* name, int height, const std::string& contact) {
        return fmt::format(R"({{"prefab": "ball", "name": "{}", "at": [0, {}], "contact": {{{}}}}})", name, height,
                           contact);
    };
    return of(fmt::format(R"("figures": [{}, {}], "colliders": [{{"shape": "half_space", "name": "floor"}},
        {{"shape": "sphere", "name": "ghost", "layers": [9], "at": [9, 9]}}],
        "events": [{{"on": {{{}}}, "note": "n"}}]{})",
                          ball("r", 2, one), ball("s", 4, other), on, more));
}

TEST(Contact, ThatCannotBeIsTold) {
    const std::string figures = R"("figures": true)", of_both = R"("of": "r", "with": "s")";
    EXPECT_TRUE(is_silent(balls(figures, figures, of_both)));
    const auto neither = balls("", "", of_both);
    EXPECT_TRUE(says(neither.warnings, "this event never happens: \"r\" and \"s\" cannot touch at /events/0/on/with"));
    EXPECT_TRUE(says(neither.warnings, "give \"r\" and \"s\" \"contact\": {\"figures\": true}"));
    EXPECT_TRUE(says(balls(figures, "", of_both).warnings, "give \"s\" \"contact\""));
    EXPECT_TRUE(says(balls("", figures, of_both).warnings, "give \"r\" \"contact\""));
    EXPECT_TRUE(
        says(balls(figures, figures, of_both, R"(, "solver": {"mode": "classic"})").warnings, "in classic mode"));
    EXPECT_TRUE(says(balls(figures, figures + R"(, "layers": [3], "touches": [3])", of_both).warnings,
                     "the layers of \"r\" and \"s\" do not touch"));

    EXPECT_TRUE(is_silent(balls("", "", R"("of": "r", "with": "floor")")));
    EXPECT_TRUE(says(balls(R"("touches": [0])", "", R"("of": "r", "with": "ghost")").warnings,
                     "the layers of \"r\" and \"ghost\" do not touch"));
    EXPECT_TRUE(is_silent(balls("", "", R"("of": "r")"))) << "the floor is there";
    EXPECT_TRUE(says(balls(R"("touches": [])", "", R"("of": "r")").warnings, "nothing in the scene touches \"r\""));
    EXPECT_TRUE(says(balls("", "", R"("of": "r", "with": "r")").warnings, "\"r\" has no contact with itself"));
    EXPECT_TRUE(is_silent(balls(R"("itself": true)", "", R"("of": "r", "with": "r")")));
}

TEST(Layers, ThatNothingIsInAreTold) {
    const auto touches = [](const std::string& layers) {
        return of(R"("figures": [{"prefab": "ball", "name": "r", "contact": {"figures": true, "touches": )" + layers +
                  R"(}}, {"prefab": "ball", "name": "s", "at": [0, 4], "contact": {"figures": true, "layers": [1]}}])");
    };
    EXPECT_TRUE(says(touches("[2]").warnings, "\"r\" touches nothing: no figure and no collider is in these layers"));
    for (const char* meant : {"[1]", "[]", "[1, 2]", "[0]"}) EXPECT_TRUE(is_silent(touches(meant))) << meant;
}

TEST(Pin, ThatBeginsFarAwayIsToldWithTheSpeed) {
    const auto pin = [](const std::string& more) {
        return of(R"("figures": [{"prefab": "box", "name": "b", "mass": 8}], "pins": [{"particle": "b/top_left")" +
                  more + "}]");
    };
    // From (-0.25, 0.25) 10 m up with 2 / 3200 m/N: 80 kJ, which is 141 m/s of 8 kg. With four times the compliance
    // half of it.
    const auto far = pin(R"(, "to": [-0.25, 10.25], "compliance": 6.25e-4)");
    EXPECT_TRUE(says(far.warnings, "at /pins/0/to"));
    EXPECT_TRUE(says(far.warnings, "m/s: more than 100 m/s"));
    EXPECT_TRUE(is_silent(pin(R"(, "to": [-0.25, 10.25], "compliance": 25e-4)")));
    EXPECT_TRUE(is_silent(pin(R"(, "to": [-0.25, 10.25], "compliance": 1e-5, "max_force": 500)")));
    EXPECT_TRUE(says(pin(R"(, "to": [-0.25, 10.25])").warnings, "m/s: more than")) << "in one step";
    EXPECT_TRUE(is_silent(pin(R"(, "to": [-0.25, 0.75])")));
    EXPECT_TRUE(is_silent(pin(R"(, "compliance": 1e-9)")));
}

TEST(Grab, OfWhatIsFarAwayNeedsADuration) {
    const auto grab = [](const std::string& more, const std::string& rest = "") {
        return of(R"("world": {"gravity": [0, -9.81]}, "figures": [{"prefab": "ragdoll", "name": "b"}],
            "events": [{"grab": "b/head", )" +
                  more + "}]" + rest);
    };
    const auto far = grab(R"("at": 0.5, "to": [9, 0])");
    EXPECT_TRUE(says(far.warnings, "this grab takes \"b/head\" at least")) << far.errors;
    EXPECT_TRUE(says(far.warnings, "more than 100 m/s at /events/0/grab"));
    EXPECT_TRUE(is_silent(grab(R"("at": 0.5, "to": [9, 0], "duration": 1)")));
    EXPECT_TRUE(is_silent(grab(R"("at": 0.5, "to": [9, 0], "compliance": 0.1)")));
    EXPECT_TRUE(is_silent(grab(R"("at": 3, "to": [9, 0])"))) << "it may have fallen there";
    EXPECT_TRUE(is_silent(grab(R"("at": 0.5)")));
    EXPECT_TRUE(is_silent(grab(R"("at": 0.5, "to": [9, 0])", R"(, "pins": [{"particle": "b/left_foot", "driver": "bob",
        "by": [1, 0]}])")))
        << "it may be driven there";
}

TEST(Join, OfWhatIsFarApartIsToldWithTheSpeed) {
    const auto join = [](const std::string& more) {
        return of(R"("figures": [{"prefab": "box", "name": "b"}, {"prefab": "box", "name": "d", "at": [4, 0]}],
            "events": [{"at": 0.5, "join": ["b/top_left", "d/top_left"])" +
                  more + "}]");
    };
    EXPECT_TRUE(says(join(R"(, "rest": 0.1)").warnings,
                     "\"b/top_left\" and \"d/top_left\" are at least 3.9 m too far apart for this join"));
    EXPECT_TRUE(says(join(R"(, "high": 1, "compliance": 1e-6)").warnings, "more than 100 m/s at /events/0/join"));
    for (const char* meant : {"", R"(, "rest": 4)", R"(, "high": 5)", R"(, "rest": 0.1, "within": 1)",
                              R"(, "rest": 0.1, "max_force": 50)", R"(, "rest": 0.1, "compliance": 1)"})
        EXPECT_TRUE(is_silent(join(meant))) << meant;
}

TEST(Speed, OfAHoldIsInTheUnitsOfTheScene) {
    const auto pin = [](const std::string& to) {
        return of(R"("units": {"length": "px"}, "figures": [{"prefab": "ball", "name": "b"}], "pins": [
            {"particle": "b/*", "to": )" +
                  to + "}]");
    };
    EXPECT_TRUE(says(pin("[0, 200]").warnings, "more than 10000 px/s"));
    EXPECT_TRUE(is_silent(pin("[0, 100]")));
}

TEST(ClassicMode, HasNoForces) {
    const auto figure = [](const std::string& more, const std::string& mode = "classic") {
        return of(R"("solver": {"mode": ")" + mode + R"("}, "figures": [{)" + more + "}]");
    };
    EXPECT_TRUE(says(figure(R"("prefab": "rope", "break_force": 3)").warnings,
                     "classic mode has no break_force: constraints are corrected in passes, not by forces at "
                     "/figures/0/break_force"));
    EXPECT_TRUE(
        says(figure(R"("prefab": "rope", "bend_stiffness": 3)").warnings, "classic mode has no bend_stiffness"));
    EXPECT_TRUE(says(figure(R"("prefab": "chain", "bend_limit": 20)").warnings, "classic mode has no bend_limit"));
    EXPECT_TRUE(is_silent(figure(R"("prefab": "chain", "bend_limit": 20)", "physical")));
    EXPECT_TRUE(is_silent(figure(R"("prefab": "rope", "break_force": 0)")));
    const auto springs =
        of(R"("solver": {"mode": "classic"}, )" +
           three(R"({"between": ["a", "b"], "compliance": 1}, {"between": ["b", "c"], "compliance": 2})"));
    EXPECT_TRUE(says(springs.warnings, "(and 1 more) at /figures/0/constraints/0/compliance"));
    const std::string rope = R"({"sinew": 1, "figures": [{"prefab": "rope", "break_force": 3}]})";
    EXPECT_TRUE(is_silent(said_of(rope, {{"mode=classic"}}))) << "a scene of physical mode, looked at in the other";
}

TEST(ConstraintName, OfSeveralIsNoneForAnEvent) {
    const std::string twice = three(R"({"name": "x", "between": ["a", "b"]}, {"name": "x", "between": ["b", "c"]},
        {"name": "y", "between": ["a", "c"]})");
    const auto event = [&](const std::string& event) { return of(twice + R"(, "events": [{)" + event + "}]"); };
    EXPECT_TRUE(is_silent(of(twice))) << "a name is a part of the looks, too";
    for (const char* what : {R"("at": 1, "remove": ["f/x"])", R"("at": 1, "adjust": ["f/x"], "compliance": 1)"}) {
        EXPECT_TRUE(says(event(what).errors, "there are 2 constraints \"f/x\", of which the event would reach one"));
        EXPECT_TRUE(says(event(what).errors, "write \"f/x*\" for all"));
    }
    for (const char* what : {R"("at": 1, "remove": ["f/x*"])", R"("at": 1, "remove": ["f/y"])",
                             R"("at": 1, "every": 1, "remove": ["f/x"])"})
        EXPECT_TRUE(is_silent(event(what))) << what;
}

TEST(Name, ThatNoReferenceCanSayIsAnError) {
    const auto particle = [](const std::string& name) {
        return of(R"("figures": [{"name": "f", "particles": {")" + name + R"(": {"at": [0, 0]}}}])");
    };
    EXPECT_TRUE(says(particle("p/q").errors, "a particle's name cannot contain a slash, found \"p/q\" at "
                                             "/figures/0/particles/p~1q"));
    EXPECT_TRUE(says(particle("s*").errors, "a particle's name cannot end in a star, found \"s*\""));
    EXPECT_TRUE(says(particle("").errors, "a particle's name cannot be empty"));
    for (const char* good : {"p", "p_1", "mixamorig:Hips", "a*b", "größe", "a b"})
        EXPECT_TRUE(is_silent(particle(good))) << good;
    const auto figure = [](const std::string& name) {
        return of(R"("figures": [{"prefab": "rope", "name": ")" + name + "\"}]");
    };
    EXPECT_TRUE(says(figure("").errors, "a figure's name cannot be empty at /figures/0/name"));
    EXPECT_TRUE(says(figure("x*").errors, "a figure's name cannot end in a star"));
    EXPECT_TRUE(says(figure("a/b").errors, "a figure's name cannot contain a slash"));
    EXPECT_TRUE(is_silent(figure("rope")));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
