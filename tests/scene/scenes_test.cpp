#include "sinew/scene/layout.h"
#include "sinew/scene/scene.h"
#include "sinew/session/session.h"
#include "sinew/world/measure.h"

#include "tests/paths.h"
#include "tests/scene/laws.h"
#include "tests/scene/models.h"
#include "tests/scene/schema_check.h"
#include "tests/stepped.h"
#include "tests/text_of.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <iterator>
#include <rapidcheck/gtest.h>
#include <string>
#include <vector>

namespace sinew::SINEW_TEST_FILE {
namespace {

std::vector<std::filesystem::path> scene_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(test::scenes_dir()))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

Document opened(const std::string& text, const std::string& name, std::vector<Override> overrides = {}) {
    auto document = load(text, name, overrides);
    open_scene(document, {}, models_beside(name));
    return document;
}

TEST(Scenes, EveryOneIsGoodInEveryMode) {
    ASSERT_FALSE(scene_files().empty());
    for (const auto& file : scene_files())
        for (const auto mode : modes) {
            const auto document = opened(text_of(file), file.string(), {{concat("mode=", mode)}});
            EXPECT_TRUE(document.diagnostics.ok()) << to_text(document.diagnostics);
        }
}

TEST(Scenes, ContactOfClothIsOneOfTwoWords) {
    const auto scene_of = [](std::string_view word) {
        return concat(R"({"sinew": 1, "dimension": 3, "figures": [{"prefab": "cloth", "contact": {"cloth": ")", word,
                      R"("}}]})");
    };
    for (std::size_t i = 0; i < cloth_contact_names.size(); ++i) {
        auto document = load(scene_of(cloth_contact_names[i]), "cloth.json", {});
        auto scene = open_scene(document, {}, models_beside("cloth.json"));
        ASSERT_TRUE(scene) << to_text(document.diagnostics);
        const Session session(std::move(*scene));
        std::visit([&](const auto& world) { EXPECT_EQ(world.figures[0].cloth, ClothContactKind(i)); }, session.world());
    }
    const auto errors = to_text(opened(scene_of("thick"), "cloth.json").diagnostics);
    EXPECT_NE(errors.find(R"("spheres" or "thin")"), std::string::npos) << errors;
}

TEST(Scenes, EveryOneFollowsTheSchema) {
    const SchemaCheck schema(schema_of(scene_layout(), "A scene of Sinew", true));
    for (const auto& file : scene_files()) {
        Diagnostics diagnostics;
        const auto document = json::parse(diagnostics.add_source(file.filename().string(), text_of(file)), diagnostics);
        ASSERT_TRUE(document) << to_text(diagnostics);
        EXPECT_TRUE(schema.accepts(*document)) << file;
    }
}

TEST(Scenes, NoRecordNamesAKeyTwice) {
    EXPECT_TRUE(laws::each_key_once<Scene>());
    EXPECT_TRUE(laws::each_key_once<FigureSection>());
    EXPECT_TRUE(laws::each_key_once<ForceSection>());
    EXPECT_TRUE(laws::each_key_once<EventSection>());
}

std::string with_a_joint(const std::string& first, const std::string& second) {
    const std::string hook = R"({"name": "hook", "particles": {"p": {"at": [0, 1]}}})";
    const std::string ball = R"({"name": "ball", "particles": {"q": {"at": [0, 0]}}, "constraints":
        [{"name": "thread", "between": ["hook/p", "q"]}], "looks": {"thread": {"color": "red"}}})";
    return R"({"sinew": 1, "figures": [)" + (first == "hook" ? hook : ball) + "," + (second == "hook" ? hook : ball) +
           "]}";
}

// Half a second, in the scene's own unit of time, if nothing else is said.
TEST(Scenes, SleepHasTheSpeedAndTheDelayThatTheSceneNames) {
    const auto rules = [](const std::string& units, const std::string& sleep) {
        auto document = load(R"({"sinew": 1, "units": {)" + units + R"(}, "solver": {"sleep": )" + sleep + "}}", "s");
        const auto opened = open_scene(document, {}, {});
        EXPECT_TRUE(opened) << to_text(document.diagnostics);
        return opened ? std::get<World<2, double>>(opened->world).settings.sleep : SleepRules<double>{};
    };
    EXPECT_EQ(rules("", R"({"speed": 0.02, "delay": 1})").speed, 0.02);
    EXPECT_EQ(rules("", R"({"speed": 0.02, "delay": 1})").delay, 1);
    EXPECT_DOUBLE_EQ(rules("", R"({"speed": 0.02})").delay, 0.5);
    EXPECT_DOUBLE_EQ(rules(R"("time": "frame")", R"({"speed": 0.02})").delay, 30);
}

TEST(Scenes, AFigureJoinsAndDrawsParticlesOfThoseBeforeIt) {
    auto document = load(with_a_joint("hook", "ball"), "a.json");
    const auto open = open_scene(document);
    ASSERT_TRUE(open) << to_text(document.diagnostics);
    const auto& world = std::get<World<2, double>>(open->world);
    const auto joint = find_constraint(world, "ball/thread");
    ASSERT_TRUE(joint);
    EXPECT_EQ(constraint_state(world, *joint)->measure, 1);
    EXPECT_EQ(world.figures[1].pieces[0].particles[0], find_particle(world, "hook/p"));
}

TEST(Scenes, AFigureDoesNotJoinThoseBehindIt) {
    const auto document = opened(with_a_joint("ball", "hook"), "a.json");
    EXPECT_NE(to_text(document.diagnostics)
                  .find("error: \"hook/p\" is of a figure that is made later at "
                        "/figures/0/constraints/0/between/0"),
              std::string::npos)
        << to_text(document.diagnostics);
}

/// A scene with any value replaced is good, or its errors have places inside their sources.
RC_GTEST_PROP(ScenesLaw, DamageIsReadOrRefusedWithPlaces, ()) {
    auto text = text_of(*rc::gen::elementOf(scene_files()));
    Diagnostics diagnostics;
    const auto root = json::parse(diagnostics.add_source("a.json", text), diagnostics);
    std::vector<Span> spans;
    laws::each_value(*root, [&](const json::Value& value) { spans.push_back(value.span); });
    const auto span = *rc::gen::elementOf(spans);
    text.replace(span.begin, span.end - span.begin,
                 *rc::gen::element<std::string>("null", "true", "0", "-1", "1e9", "2.5", "\"\"", "\"rope\"", "[]",
                                                "[1, 2]", "{}", "{\"name\": 1}", "[[1, 2], [3, 4]]"));
    const auto document = opened(text, "a.json", {{"limits.particles=1000"}, {"limits.constraints=1000"}});
    for (const auto& diagnostic : document.diagnostics.in_order()) {
        RC_ASSERT(diagnostic.span.begin <= diagnostic.span.end);
        RC_ASSERT(diagnostic.span.end <= document.diagnostics.source(diagnostic.span.source).text.size());
    }
    RC_ASSERT(to_text(document.diagnostics).empty() == document.diagnostics.ok());
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
