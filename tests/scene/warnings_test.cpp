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
