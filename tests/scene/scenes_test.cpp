#include "sinew/scene/layout.h"
#include "sinew/scene/scene.h"

#include "tests/scene/laws.h"
#include "tests/scene/schema_check.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <rapidcheck/gtest.h>
#include <string>
#include <vector>

namespace sinew {
namespace {

std::vector<std::filesystem::path> scene_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(SINEW_SCENES_DIR))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

Document opened(const std::string& text, const std::string& name, std::vector<Override> overrides = {}) {
    auto document = load(text, name, overrides);
    open_scene(document);
    return document;
}

TEST(Scenes, EveryOneIsGoodInEveryMode) {
    ASSERT_FALSE(scene_files().empty());
    for (const auto& file : scene_files())
        for (const auto mode : modes) {
            const auto document = opened(text_of(file), file.filename().string(), {{concat("mode=", mode)}});
            EXPECT_TRUE(document.diagnostics.ok()) << to_text(document.diagnostics);
        }
}

TEST(Scenes, EveryOneFollowsTheSchema) {
    const SchemaCheck schema(schema_of(layout_of<Scene>(), "A scene of Sinew", true));
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
} // namespace sinew
