#include "sinew/scene/document.h"
#include "sinew/scene/reader.h"

#include "tests/cpu_time.h"
#include "tests/scene/laws.h"
#include "tests/scene/sample.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <string>

namespace sinew::SINEW_TEST_FILE {
namespace {

Document loaded(std::string text, std::vector<std::string> pairs = {}) {
    std::vector<Override> overrides;
    for (auto& pair : pairs) overrides.push_back({std::move(pair)});
    return load(std::move(text), "a.json", overrides);
}

std::string root_of(std::string text, std::vector<std::string> pairs = {}) {
    const auto document = loaded(std::move(text), std::move(pairs));
    EXPECT_TRUE(document.diagnostics.ok()) << to_text(document.diagnostics);
    return json::to_text(document.root);
}

/// Everything that is said about the scene, as a user would see it.
std::string errors_of(std::string text, std::vector<std::string> pairs = {}) {
    auto document = loaded(std::move(text), std::move(pairs));
    sample::Scene scene;
    read(document.root, scene, Reading{document.diagnostics});
    return to_text(document.diagnostics);
}

// --- modes ------------------------------------------------------------------------------------------------------

TEST(Modes, TheFileOrTheOverrideSaysWhich) {
    EXPECT_EQ(loaded("{}").mode, "physical");
    EXPECT_EQ(loaded(R"({"solver": {"mode": "classic"}})").mode, "classic");
    EXPECT_EQ(loaded(R"({"solver": {"mode": "classic"}})", {"mode=physical"}).mode, "physical");
    EXPECT_EQ(loaded("{}", {"solver.mode=classic"}).mode, "classic");
}

TEST(Modes, ThePatchOfTheModeIsMergedIn) {
    const std::string text = R"({"a": {"b": 1, "c": 2}, "d": [1, 2], "modes": {
        "classic": {"a": {"b": 10, "c": null, "e": {"f": null, "g": 3}}, "d": [3], "h": 4},
        "physical": {"a": {"b": 11}}}})";
    EXPECT_EQ(root_of(text, {"mode=classic"}),
              R"({"a": {"b": 10, "e": {"g": 3}}, "d": [3], "h": 4, "solver": {"mode": "classic"}})");
    EXPECT_EQ(root_of(text), R"({"a": {"b": 11, "c": 2}, "d": [1, 2]})");
}

/// The cases of the appendix of RFC 7386, except those where the target is an array and the patch an object.
TEST(Modes, PatchesFollowRfc7386) {
    const std::vector<std::array<std::string, 3>> cases = {
        {R"({"a": "b"})", R"({"a": "c"})", R"({"a": "c"})"},
        {R"({"a": "b"})", R"({"b": "c"})", R"({"a": "b", "b": "c"})"},
        {R"({"a": "b"})", R"({"a": null})", R"({})"},
        {R"({"a": "b", "b": "c"})", R"({"a": null})", R"({"b": "c"})"},
        {R"({"a": ["b"]})", R"({"a": "c"})", R"({"a": "c"})"},
        {R"({"a": "c"})", R"({"a": ["b"]})", R"({"a": ["b"]})"},
        {R"({"a": {"b": "c"}})", R"({"a": {"b": "d", "c": null}})", R"({"a": {"b": "d"}})"},
        {R"({"a": [{"b": "c"}]})", R"({"a": [1]})", R"({"a": [1]})"},
        {R"({"e": null})", R"({"a": 1})", R"({"e": null, "a": 1})"},
        {R"({})", R"({"a": {"bb": {"ccc": null}}})", R"({"a": {"bb": {}}})"},
    };
    for (const auto& [target, patch, result] : cases)
        EXPECT_EQ(root_of(target.substr(0, target.size() - 1) + (target == "{}" ? "" : ", ") +
                          "\"modes\": {\"physical\": " + patch + "}}"),
                  result);
}

TEST(Modes, AnObjectPatchesAnArrayByName) {
    const std::string figures =
        R"("figures": [{"prefab": "rope", "name": "left"}, {"prefab": "ragdoll", "height": 2}])";
    EXPECT_EQ(
        root_of("{" + figures + R"(, "modes": {"physical": {"figures":
                  {"left": {"segments": 3}, "ragdoll": {"height": 1}}}}})"),
        R"({"figures": [{"prefab": "rope", "name": "left", "segments": 3}, {"prefab": "ragdoll", "height": 1}]})");
    EXPECT_EQ(root_of("{" + figures + R"(, "modes": {"physical": {"figures": {"left": null, "1": {"height": 3}}}}})"),
              R"({"figures": [{"prefab": "ragdoll", "height": 3}]})");
}

TEST(Modes, ErrorsPointIntoThePatch) {
    EXPECT_EQ(errors_of("{\"sinew\": 1,\n \"modes\": {\"physical\":\n  {\"solver\": {\"substpes\": 4}}}}"),
              "a.json:3:15: error: unknown property \"substpes\" at /solver\n"
              "    3 |   {\"solver\": {\"substpes\": 4}}}}\n"
              "      |               ^~~~~~~~~~\n"
              "      = help: did you mean \"substeps\"? (allowed here: mode, precision, seed, substeps, tethers)\n");
    EXPECT_EQ(
        errors_of(R"({"sinew": 1, "figures": [{"name": "bob"}], "modes": {"physical": {"figures": {"bbo": {}}}}})"),
        "a.json:1:79: error: nothing here is called \"bbo\" at /figures\n"
        "    1 | {\"sinew\": 1, \"figures\": [{\"name\": \"bob\"}], \"modes\": {\"physical\": {\"figures\": {\"bbo\": "
        "{}}}}}\n"
        "      |                                                                               ^~~~~\n"
        "      = help: did you mean \"bob\"? (allowed here: bob)\n");
}

TEST(Modes, WhatIsNoModeIsAnError) {
    const auto text = errors_of(R"({"sinew": 1, "modes": {"clasic": {}, "physical": 3}})");
    EXPECT_NE(text.find("1:24: error: unknown mode \"clasic\" at /modes"), std::string::npos) << text;
    EXPECT_NE(text.find("did you mean \"classic\"?"), std::string::npos) << text;
    EXPECT_NE(text.find("1:50: error: expected an object, found the number 3 at /modes/physical"), std::string::npos)
        << text;
    EXPECT_NE(errors_of(R"({"sinew": 1, "modes": []})").find("expected an object"), std::string::npos);
    EXPECT_NE(
        errors_of(R"({"sinew": 1, "modes": {"classic": {"solver": {"mode": "physical"}}}})").find("cannot change"),
        std::string::npos);
}

TEST(Modes, EditorsMayNameTheirSchema) {
    EXPECT_EQ(root_of(R"({"$schema": "scene.schema.json", "a": 1})"), R"({"a": 1})");
}

// --- overrides --------------------------------------------------------------------------------------------------

TEST(Overrides, SetAnyValueByItsPath) {
    const std::string text = R"({"solver": {"substeps": 1}, "figures": [{"name": "bob", "height": 1}]})";
    EXPECT_EQ(root_of(text, {"solver.substeps=16", "figures.bob.height=200"}),
              R"({"solver": {"substeps": 16}, "figures": [{"name": "bob", "height": 200}]})");
    EXPECT_EQ(root_of(text, {"figures.0.height=2"}), root_of(text, {"figures.bob.height=2"}));
    EXPECT_EQ(root_of("{}", {"view.size=[640, 480]"}), R"({"view": {"size": [640, 480]}})");
    EXPECT_EQ(root_of("{}", {"precision=double"}), R"({"solver": {"precision": "double"}})");
    EXPECT_EQ(root_of(text, {"solver.substeps=2", "solver.substeps=3"}), root_of(text, {"solver.substeps=3"}));
}

TEST(Overrides, ValuesAreJsonOrElseText) {
    EXPECT_EQ(root_of("{}", {"a=true"}), R"({"a": true})");
    EXPECT_EQ(root_of("{}", {"a=1e3"}), R"({"a": 1000})");
    EXPECT_EQ(root_of("{}", {"a=two words"}), R"({"a": "two words"})");
    EXPECT_EQ(root_of("{}", {"a=\"12\""}), R"({"a": "12"})");
    EXPECT_EQ(root_of("{}", {"a="}), R"({"a": ""})");
    EXPECT_EQ(root_of("{}", {"a=b=c"}), R"({"a": "b=c"})");
    EXPECT_NE(errors_of("{}", {"a=[1, 2"}).find("\"[\" of line 1, column 1 is not closed"), std::string::npos);
}

TEST(Overrides, NullRemoves) {
    EXPECT_EQ(root_of(R"({"a": 1, "b": [{"name": "x"}, 2]})", {"a=null", "b.x=null"}), R"({"b": [2]})");
}

TEST(Overrides, WinOverTheModesPatch) {
    EXPECT_EQ(root_of(R"({"a": 1, "modes": {"physical": {"a": 2}}})", {"a=3"}), R"({"a": 3})");
}

TEST(Overrides, ErrorsShowThePair) {
    EXPECT_EQ(errors_of("{\"sinew\": 1}", {"solver.substpes=16"}),
              "<command line>:1:8: error: unknown property \"substpes\" at /solver\n"
              "    1 | solver.substpes=16\n"
              "      |        ^~~~~~~~\n"
              "      = help: did you mean \"substeps\"? (allowed here: mode, precision, seed, substeps, tethers)\n");
    EXPECT_EQ(
        errors_of("{\"sinew\": 1}", {"solver.substeps=[1, 2]"}),
        "<command line>:1:17: error: expected an integer from 1 to 1024, found an array of 2 at /solver/substeps\n"
        "    1 | solver.substeps=[1, 2]\n"
        "      |                 ^~~~~~\n"
        "      = help: substeps: Per step\n");
    EXPECT_EQ(
        errors_of("{\"sinew\": 1}", {"mode=clasic"}),
        "<command line>:1:6: error: expected \"physical\" or \"classic\", found the string \"clasic\" at /solver/mode\n"
        "    1 | mode=clasic\n"
        "      |      ^~~~~~\n"
        "      = help: did you mean \"classic\"? (allowed here: classic, physical)\n");
}

TEST(Overrides, ErrorsInsideAValueAreShownThere) {
    EXPECT_EQ(errors_of("{\"sinew\": 1}", {"box=[[0, 0], [1, \"x\"]]"}),
              "<command line>:1:18: error: expected a number in m, found the string \"x\" at /box/1/1\n"
              "    1 | box=[[0, 0], [1, \"x\"]]\n"
              "      |                  ^~~\n"
              "      = help: box: Two corners\n");
}

TEST(Overrides, APathThroughNothingIsAnError) {
    const std::string text = R"({"sinew": 1, "figures": [{"name": "bob"}, {"name": "eve"}]})";
    EXPECT_NE(errors_of(text, {"figures.bop.height=2"})
                  .find("<command line>:1:9: error: nothing here is called \"bop\" at /figures"),
              std::string::npos);
    EXPECT_NE(errors_of(text, {"figures.bop.height=2"}).find("did you mean \"bob\"? (allowed here: bob, eve)"),
              std::string::npos);
    EXPECT_NE(errors_of(text, {"sinew.x=2"}).find("1:7: error: the number 1 has no property \"x\" at /sinew"),
              std::string::npos);
    EXPECT_NE(errors_of(text, {"bob"}).find("1:1: error: expected key=value, found \"bob\""), std::string::npos);
    EXPECT_NE(errors_of(text, {"=2"}).find("expected key=value"), std::string::npos);
    EXPECT_NE(errors_of(text, {"a\xFF=2"}).find("1:2: error: not UTF-8"), std::string::npos);
    EXPECT_NE(errors_of(text, {std::string(100000, '.') + "=2"}).find("longer than any"), std::string::npos);
}

TEST(Overrides, RaiseLimits) {
    EXPECT_FALSE(loaded("[[[1]]]", {"limits.depth=2"}).diagnostics.ok());
    EXPECT_EQ(loaded("{}", {"limits.particles=5e6"}).limits.particles, 5000000);
    EXPECT_EQ(errors_of("{\"sinew\": 1}", {"limits.partcles=5"}),
              "<command line>:1:8: error: unknown property \"partcles\" at /limits\n"
              "    1 | limits.partcles=5\n"
              "      |        ^~~~~~~~\n"
              "      = help: did you mean \"particles\"? (allowed here: bytes, constraints, depth, errors, events, "
              "figures, memory, "
              "particles, pixels, string_bytes, values)\n");
}

// --- the whole --------------------------------------------------------------------------------------------------

TEST(Document, ErrorsOfAWholeSceneAreReportedAtAPointer) {
    auto document = loaded(R"({"figures": [{"name": "bob"}]})");
    document.error("/figures/0/name", "a");
    document.error("/figures/0/mass", "b");
    document.error("/links/3", "c");
    document.error("nonsense", "d");
    const auto errors = document.diagnostics.in_order();
    ASSERT_EQ(errors.size(), 4u);
    EXPECT_EQ(document.diagnostics.text(errors[3].span), "\"bob\"");
    EXPECT_EQ(document.diagnostics.text(errors[2].span), R"({"name": "bob"})") << "the object around";
    EXPECT_EQ(errors[2].path, "/figures/0/mass");
    EXPECT_EQ(errors[0].span.begin, 0u);
}

TEST(Document, IsAnObject) {
    EXPECT_NE(to_text(loaded("[1]").diagnostics).find("expected an object, found an array of 1 at /"),
              std::string::npos);
    EXPECT_TRUE(loaded("[1]").root.as<json::Object>());
    EXPECT_TRUE(loaded("[1").root.as<json::Object>());
}

// Four times the names in up to ten times the processor's time; sixteen if every name were looked for in a list.
TEST(Document, APatchOfManyNamesTakesNoLongerThanItsText) {
    const auto seconds = [](int many) {
        std::string figures, patch;
        for (int i = 0; i < many; ++i) {
            figures += concat("{\"name\":\"f", i, "\"},");
            patch += concat("\"f", many - i, "\":{\"x\":1},");
        }
        return test::cpu_seconds([&] {
            const auto document = loaded("{\"figures\":[" + figures + "0],\"modes\":{\"physical\":{\"figures\":{" +
                                         patch + "\"none\":0}}}}");
            EXPECT_EQ(document.diagnostics.count(), 2U);
        });
    };
    const double few = std::min(seconds(7500), seconds(7500));
    EXPECT_LT(seconds(30000), 10 * few);
}

// --- laws -------------------------------------------------------------------------------------------------------

/// A scene is good or its errors have places inside their sources.
void expect_scene_or_places(std::string text, std::vector<std::string> pairs) {
    auto document = loaded(std::move(text), std::move(pairs));
    sample::Scene scene;
    const bool good = read(document.root, scene, Reading{document.diagnostics});
    RC_ASSERT(good || !document.diagnostics.ok());
    for (const auto& diagnostic : document.diagnostics.in_order()) {
        RC_ASSERT(diagnostic.span.begin <= diagnostic.span.end);
        RC_ASSERT(diagnostic.span.end <= document.diagnostics.source(diagnostic.span.source).text.size());
    }
    RC_ASSERT(to_text(document.diagnostics).empty() == document.diagnostics.ok());
}

RC_GTEST_PROP(DocumentLaw, AGoodSceneWithAnyDamageIsReadOrRefusedWithPlaces, ()) {
    std::string text(sample::good_scene);
    const int damages = *rc::gen::inRange(1, 4);
    for (int i = 0; i < damages; ++i) {
        const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
        const auto piece = *rc::gen::element<std::string>("", "{", "}", "]", "null", "-1", "\"x\"", "1e5", "\"bob\"",
                                                          "true", "\n", ",", "[0]", "{\"a\":1}");
        text.replace(at, std::min(*rc::gen::inRange<std::size_t>(0, 12), text.size() - at), piece);
    }
    expect_scene_or_places(text, {});
}

/// Replacing whole values keeps the text JSON, so that it is the reader that has to cope.
RC_GTEST_PROP(DocumentLaw, AGoodSceneWithAnyValueReplacedIsReadOrRefusedWithPlaces, ()) {
    std::string text(sample::good_scene);
    Diagnostics diagnostics;
    const auto root = json::parse(diagnostics.add_source("a.json", text), diagnostics);
    std::vector<Span> spans;
    laws::each_value(*root, [&](const json::Value& value) { spans.push_back(value.span); });
    const auto span = *rc::gen::elementOf(spans);
    text.replace(span.begin, span.end - span.begin,
                 *rc::gen::element<std::string>("null", "true", "0", "-1e9", "2.5", "\"\"", "\"rope\"", "[]",
                                                "[1, 2, 3]", "{}", "{\"name\": 1}", "1e300"));
    expect_scene_or_places(text, {});
}

RC_GTEST_PROP(DocumentLaw, AnyOverridesAreTakenOrRefusedWithPlaces, ()) {
    const auto pairs = *rc::gen::container<std::vector<std::string>>(
        rc::gen::map(rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
                         "figures", "bob", ".", "=", "0", "limits", "depth", "mode", "solver", "substeps", "null", "{}",
                         "[", "modes", "3", "\xFF", "")),
                     [](const std::vector<std::string>& parts) {
                         std::string pair;
                         for (const auto& part : parts) pair += part;
                         return pair;
                     }));
    expect_scene_or_places(std::string(sample::good_scene), pairs);
}

TEST(DocumentLaw, TheSampleIsGoodInBothModes) {
    EXPECT_EQ(errors_of(std::string(sample::good_scene)), "");
    EXPECT_EQ(errors_of(std::string(sample::good_scene), {"mode=classic"}), "");
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
