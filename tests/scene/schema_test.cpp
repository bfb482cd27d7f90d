#include "sinew/scene/document.h"
#include "sinew/scene/reader.h"

#include "tests/scene/sample.h"
#include "tests/scene/schema_check.h"

#include <gtest/gtest.h>
#include <string>

namespace sinew::SINEW_TEST_FILE {
namespace {

bool reader_accepts(const std::string& text, std::string& errors) {
    auto document = load(text, "a.json");
    sample::Scene scene;
    read(document.root, scene, Reading{document.diagnostics});
    errors = to_text(document.diagnostics);
    return document.diagnostics.ok();
}

json::Value value_of(const std::string& text) {
    Diagnostics diagnostics;
    return *json::parse(diagnostics.add_source("a.json", text), diagnostics);
}

const char* const good_documents[] = {
    R"({"sinew": 1})",
    R"({"sinew": 1.0, "$schema": "x", "about": ""})",
    R"({"sinew": 1, "figures": [], "forces": [], "masses": {}, "solver": {}})",
    R"({"sinew": 1, "figures": [{}, {"name": "a"}, {"prefab": "rope"}, {"prefab": "ragdoll", "bend": 180}]})",
    R"({"sinew": 1, "figures": [{"prefab": "rope", "segments": 1e2, "length": 5, "mass": 0}]})",
    R"({"sinew": 1, "forces": [{"force": "drag"}, {"force": "wind", "velocity": [0, 1]}]})",
    R"({"sinew": 1, "events": [{"grab": "a", "to": [1, 2]}, {"release": "a", "at": 0}]})",
    R"({"sinew": 1, "box": [[0, 0], [1, 1]], "size": [1, 1.5]})",
    R"({"sinew": 1, "solver": {"mode": "classic", "precision": "float", "tethers": true, "seed": -5}})",
    R"({"sinew": 1, "extra": null})",
    R"({"sinew": 1, "modes": {"classic": {"anything": 1}}})",
};

const char* const bad_documents[] = {
    R"([])",
    R"({})",
    R"({"sinew": 2})",
    R"({"sinew": "1"})",
    R"({"sinew": 1.5})",
    R"({"sinew": 1, "abuot": "x"})",
    R"({"sinew": 1, "about": 1})",
    R"({"sinew": 1, "figures": {}})",
    R"({"sinew": 1, "figures": [1]})",
    R"({"sinew": 1, "figures": [{"mass": -1}]})",
    R"({"sinew": 1, "figures": [{"mass": null}]})",
    R"({"sinew": 1, "figures": [{"prefab": "roap"}]})",
    R"({"sinew": 1, "figures": [{"prefab": 3}]})",
    R"({"sinew": 1, "figures": [{"prefab": "rope", "height": 2}]})",
    R"({"sinew": 1, "figures": [{"prefab": "rope", "segments": 0}]})",
    R"({"sinew": 1, "figures": [{"prefab": "rope", "segments": 1.5}]})",
    R"({"sinew": 1, "figures": [{"segments": 2}]})",
    R"({"sinew": 1, "figures": [{"prefab": "ragdoll", "bend": 181}]})",
    R"({"sinew": 1, "figures": [{"at": [1]}]})",
    R"({"sinew": 1, "figures": [{"at": [1, 2, 3, 4]}]})",
    R"({"sinew": 1, "figures": [{"at": ["1", 2]}]})",
    R"({"sinew": 1, "forces": [{}]})",
    R"({"sinew": 1, "forces": [{"force": "wind"}]})",
    R"({"sinew": 1, "forces": [{"force": "drag", "velocity": [0, 1]}]})",
    R"({"sinew": 1, "forces": [{"force": "drag", "strength": -1}]})",
    R"({"sinew": 1, "events": [{"at": 1}]})",
    R"({"sinew": 1, "events": [{"at": -1, "release": "a"}]})",
    R"({"sinew": 1, "events": [{"grab": "a"}]})",
    R"({"sinew": 1, "events": [{"grab": "a", "to": [1, 2], "release": "a"}]})",
    R"({"sinew": 1, "events": [{"release": "a", "to": [1, 2]}]})",
    R"({"sinew": 1, "box": [[0, 0]]})",
    R"({"sinew": 1, "size": [0, 1]})",
    R"({"sinew": 1, "size": [1, 2, 3]})",
    R"({"sinew": 1, "solver": {"mode": "clasic"}})",
    R"({"sinew": 1, "solver": {"substeps": 2000}})",
    R"({"sinew": 1, "solver": {"tethers": 1}})",
    R"({"sinew": 1, "masses": {"a": -1}})",
    R"({"sinew": 1, "masses": {"a": "1"}})",
    R"({"sinew": 1, "masses": []})",
    R"({"sinew": 1, "modes": {"clasic": {}}})",
    R"({"sinew": 1, "modes": {"classic": 1}})",
};

TEST(Schema, AcceptsWhatTheReaderAccepts) {
    const SchemaCheck schema(schema_of(layout_of<sample::Scene>(), "Scene", true));
    for (const std::string text : good_documents) {
        std::string errors;
        EXPECT_TRUE(reader_accepts(text, errors)) << text << "\n" << errors;
        EXPECT_TRUE(schema.accepts(value_of(text))) << text;
    }
    EXPECT_TRUE(schema.accepts(value_of(std::string(sample::good_scene))));
}

TEST(Schema, RefusesWhatTheReaderRefuses) {
    const SchemaCheck schema(schema_of(layout_of<sample::Scene>(), "Scene", true));
    for (const std::string text : bad_documents) {
        std::string errors;
        EXPECT_FALSE(reader_accepts(text, errors)) << text;
        EXPECT_FALSE(schema.accepts(value_of(text))) << text << "\n" << errors;
    }
}

TEST(Schema, LeavesOutRangesThatDependOnTheUnitsOfAScene) {
    const auto schema = schema_of(layout_of<sample::Rope>(), "Rope", false);
    EXPECT_EQ(json::find(schema, "/properties/length/minimum"), nullptr);
    EXPECT_EQ(*json::find(schema, "/properties/segments/minimum"), json::Value(1));
    EXPECT_EQ(*json::find(schema, "/properties/segments/default"), json::Value(20));
    EXPECT_EQ(*json::find(schema, "/properties/segments/description"), json::Value("How many pieces"));
}

TEST(Schema, AllowsModesOnlyInADocument) {
    EXPECT_TRUE(json::find(schema_of(layout_of<sample::Scene>(), "Scene", true), "/properties/modes"));
    EXPECT_FALSE(json::find(schema_of(layout_of<sample::Scene>(), "Scene", false), "/properties/modes"));
}

TEST(Describe, IsATableOfNameTypeDefaultRangeMeaning) {
    EXPECT_EQ(describe(layout_of<sample::Rope>()), "rope: Pieces in a row.\n"
                                                   "  name      type       default  range        meaning\n"
                                                   "  segments  integer    20       1 to 1000    How many pieces\n"
                                                   "  length    number, m  1        0.02 to 100  Of the whole\n");
}

TEST(Describe, IsInTheUnitsOfAScene) {
    const Units pixels{.length = "px", .mass = "kg", .time = "frame", .per_metre = 100, .per_second = 60};
    const auto text = describe(layout_of<sample::Rope>(), pixels);
    EXPECT_NE(text.find("length    number, px  100      2 to 10000"), std::string::npos) << text;
}

TEST(Describe, HasASectionForEachAlternative) {
    const auto text = describe(layout_of<sample::Scene>());
    EXPECT_NE(text.find("solver.substeps"), std::string::npos) << text;
    EXPECT_NE(text.find("figures[].at"), std::string::npos) << text;
    EXPECT_NE(text.find("\nfigures[].prefab = rope: Pieces in a row.\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\nevents[].grab\n"), std::string::npos) << text;
}

TEST(Describe, MarkdownIsATable) {
    EXPECT_EQ(describe_markdown(layout_of<sample::Rope>()),
              "### `rope`\n\nPieces in a row.\n\n"
              "| name | type | default | range | meaning |\n"
              "|---|---|---|---|---|\n"
              "| `segments` | integer | 20 | 1 to 1000 | How many pieces |\n"
              "| `length` | number, m | 1 | 0.02 to 100 | Of the whole |\n");
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
