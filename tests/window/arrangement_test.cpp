#include "sinew/scene/layout.h"
#include "sinew/scene/parameters.h"

#include "apps/window/arrangement.h"
#include "apps/window/sliders.h"
#include "apps/window/statistics.h"
#include "tests/play/game.h"

#include <gtest/gtest.h>

/// Where the parts of the window are, and what the panel calls things.
namespace sinew::window::SINEW_TEST_FILE {
namespace {

bool overlap(const Area& a, const Area& b) {
    return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height &&
           b.top < a.top + a.height;
}

bool within(const Area& part, int width, int height) {
    return part.left >= 0 && part.top >= 0 && part.left + part.width <= width && part.top + part.height <= height;
}

TEST(Arrangement, NothingLiesOnAnythingElseAtAnySizeAndScale) {
    for (const float scale : {0.5F, 1.0F, 1.25F, 2.0F, 3.0F})
        for (int width = 1; width < 4000; width += 97)
            for (int height = 1; height < 2200; height += 53) {
                const auto layout = Arrangement::of(width, height, scale, true, false);
                ASSERT_TRUE(within(layout.scene, width, height)) << width << "x" << height << " at " << scale;
                if (!layout.bars) continue;
                const Area parts[] = {layout.scene, layout.menu, layout.tools, layout.time};
                for (const auto& a : parts)
                    for (const auto& b : parts) ASSERT_TRUE(&a == &b || !overlap(a, b)) << width << "x" << height;
                if (layout.docked) {
                    for (const auto& part : {layout.scene, layout.time, layout.menu, layout.tools})
                        ASSERT_FALSE(overlap(layout.side, part)) << width << "x" << height;
                }
                ASSERT_TRUE(within(layout.tools, width, height));
                ASSERT_GE(layout.scene.width, layout.tools.width) << width << "x" << height;
                const int rows = (Arrangement::tool_buttons + layout.tool_columns - 1) / layout.tool_columns;
                const float last = 10 * scale + float(rows) * (layout.tool_side + 4 * scale);
                ASSERT_LE(last, float(layout.tools.height) + 4 * scale) << width << "x" << height << " at " << scale;
            }
}

TEST(Arrangement, ThePanelIsADrawerWhereItHasNoRoomOfItsOwn) {
    EXPECT_TRUE(Arrangement::of(1280, 800, 1, true, false).docked);
    EXPECT_TRUE(Arrangement::of(3840, 2160, 2, true, false).docked);
    for (const auto& layout : {Arrangement::of(640, 400, 1, true, true), Arrangement::of(760, 480, 1, true, true),
                               Arrangement::of(1280, 800, 2, true, true)}) {
        EXPECT_FALSE(layout.docked);
        EXPECT_TRUE(overlap(layout.side, layout.scene));
        EXPECT_FALSE(overlap(layout.side, layout.time));
    }
    EXPECT_EQ(Arrangement::of(640, 400, 1, true, false).side.width, 0);
    EXPECT_FALSE(Arrangement::of(200, 150, 1, true, false).bars) << "all scene";
    EXPECT_FALSE(Arrangement::of(1280, 800, 1, false, false).bars);
}

// Of the same kinds, some have another number in two dimensions than in three.
TEST(Statistics, KindsAreCalledByTheirOwnNamesInEveryDimension) {
    const auto names_of = [](const std::string& scene) {
        const auto opened = play::games::read(scene, "test");
        EXPECT_TRUE(opened.opened) << opened.problem;
        return opened.opened ? kinds_of(opened.opened->world) : "";
    };
    EXPECT_EQ(names_of(R"({"sinew": 1, "dimension": 3, "figures": [{"name": "x", "particles": {
        "a": {"at": [0, 0, 0]}, "b": {"at": [1, 0, 0]}, "c": {"at": [0, 1, 0]}, "d": {"at": [0, 0, 1]}},
        "constraints": [{"kind": "volume", "between": ["a", "b", "c", "d"]},
                        {"kind": "dihedral", "between": ["a", "b", "c", "d"]},
                        {"kind": "pulley", "between": ["a", "b", "c"]}]}]})"),
              "1 volume, 1 dihedral, 1 pulley");
    EXPECT_EQ(names_of(R"({"sinew": 1, "figures": [{"name": "x", "particles": {
        "a": {"at": [0, 0]}, "b": {"at": [1, 0]}, "c": {"at": [0, 1]}},
        "constraints": [{"kind": "area", "between": ["a", "b", "c"]},
                        {"kind": "rail", "between": ["a", "b", "c"]}]}]})"),
              "1 area, 1 rail");
}

/// Calls visit(path, part) for every field, of lists and alternatives too.
template <class Visit> void each_field(const sinew::Layout& layout, const std::string& path, const Visit& visit) {
    for (const auto& part : layout.parts) {
        const auto name = std::string(part.field.name);
        const bool is_own = part.field.name != layout.field.name; // an element is called as its list
        const auto here = !is_own || name.empty() ? path : path.empty() ? name : path + "." + name;
        if (is_own && !name.empty()) visit(here, part);
        each_field(part, here, visit);
    }
}

TEST(Panel, EveryLabelHasATooltip) {
    std::size_t count = 0;
    each_field(scene_layout(), "", [&](const std::string& path, const sinew::Layout& part) {
        ++count;
        EXPECT_FALSE(part.field.help.empty()) << path;
    });
    EXPECT_GT(count, 100U);
}

// Each mode shows what acts in it: no rule of the originals in physical mode, no substeps in classic mode.
TEST(Panel, ShowsWhatActsInTheMode) {
    std::string only_classic, only_physical;
    const auto ask = [&](const std::string& path) {
        if (!acts_in("physical", path)) only_classic += path + " ";
        if (!acts_in("classic", path)) only_physical += path + " ";
    };
    each_field(scene_layout(), "", [&](const std::string& path, const sinew::Layout&) { ask(path); });
    EXPECT_EQ(only_classic, "solver.passes solver.rules figures.integrator ");
    EXPECT_EQ(only_physical, "solver.substeps solver.iterations solver.direct figures.direct ");
    EXPECT_FALSE(acts_in("physical", "figures.12.integrator"));
    EXPECT_FALSE(acts_in("classic", "figures.12.direct"));
    EXPECT_TRUE(acts_in("classic", "figures.12.direct.more"));
}

} // namespace
} // namespace sinew::window::SINEW_TEST_FILE
