#include "sinew/session/session.h"

#include "tests/files/imported.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

bool moves_and_is_finite(Opened opened) {
    Session session(std::move(opened));
    for (int i = 0; i < 4; ++i) session.step();
    return std::visit(
        [](const auto& world) {
            return std::ranges::all_of(world.particles.position, [](const auto& p) { return is_finite(p); });
        },
        session.world());
}

TEST(Import, EverySampleIsASceneThatOpensAndSteps) {
    for (const auto* const name :
         {"svg/logo.svg",    "svg/level.svg",        "svg/icons.svg",    "png/cat.png",       "png/donut.png",
          "png/leaves.png",  "obj/banner.obj",       "obj/pudding.obj",  "obj/napkin.obj",    "gltf/human.glb",
          "gltf/rigged.glb", "gltf/tablecloth.gltf", "gltf/robot.gltf",  "tiled/level.tmj",   "tiled/cave.tmj",
          "tiled/room.tmj",  "points/box.json",      "points/rope.json", "points/wheel.json", "made/word.svg",
          "made/gear.svg",   "made/room.svg",        "made/table.obj",   "made/drops.obj",    "made/curtain.obj",
          "made/table.glb",  "made/curtain.gltf",    "made/puppet.gltf", "made/slopes.tmj",   "made/endless.tmj",
          "made/house.tmj"}) {
        std::string why;
        auto opened = open_imported(import_sample(name), &why);
        ASSERT_TRUE(opened) << name << "\n" << why;
        EXPECT_TRUE(moves_and_is_finite(std::move(*opened))) << name;
    }
}

TEST(Import, FormatIsThatOfTheContentWhereTheEndingLies) {
    EXPECT_EQ(
        count_at(test::import_text("drawing.obj", "<svg width='10' height='10'><rect width='4' height='4'/></svg>"),
                 "/figures"),
        1U);
    EXPECT_NE(refusal("thing.dat", "abc").find("neither its content nor its ending"), std::string::npos);
    EXPECT_NE(refusal("a.svg", "").find("empty"), std::string::npos);
}

TEST(Import, NothingIsDroppedInSilence) {
    EXPECT_TRUE(has_note(import_sample("svg/logo.svg"), "23:", "<text> is not taken"));
    EXPECT_TRUE(has_note(import_sample("svg/logo.svg"), "22:", "clip-path"));
    EXPECT_TRUE(has_note(import_sample("gltf/robot.gltf"), "", "points and lines"));
    EXPECT_TRUE(has_note(import_sample("tiled/level.tmj"), "", "decoration"));
    EXPECT_TRUE(has_note(import_sample("obj/banner.obj"), "87:", "texture coordinates"));
    EXPECT_TRUE(has_note(import_sample("points/box.json"), "", "\"color\" is not taken"));
}

TEST(Import, LooksThatScenesHaveNotAreTold) {
    const auto svg = import_text("a.svg", R"(<svg width='90' height='90'>
<style>@import url(a.css); @media print { rect {fill:red} } g > rect {fill:red} circle {fill:blue}</style>
<rect id='r' width='9' height='9' style='mix-blend-mode:multiply;transform:rotate(9deg)'>
<animate attributeName='x'/></rect>
<path d='M9 9L20 9L20 30' fill='none' stroke='red' marker-end='url(#m)'/><circle cx='50' cy='50' r='9'/></svg>)");
    for (const char* part : {"@import url(a.css)", "@media print", "g > rect"}) EXPECT_TRUE(has_note(svg, "2:", part));
    for (const char* part : {"mix-blend-mode", "transform"}) EXPECT_TRUE(has_note(svg, "3:", part)) << part;
    EXPECT_TRUE(has_note(svg, "4:", "<animate>"));
    EXPECT_TRUE(has_note(svg, "5:", "marker-end"));
    EXPECT_EQ(json::to_text(at(svg, "/figures/2/looks/inside/fill")), "\"#0000ff\""); // the rule after the others

    const auto bright =
        import_text("a.svg", R"(<svg width='90' height='90'><rect width='9' height='9' fill='hsl(120, 50%, 50%)'/>
<rect x='20' width='9' height='9' fill='hsla(-30deg 100% 25% / 50%)'/><rect x='40' width='9' height='9' fill='hsl(0 0 100)'/></svg>)");
    EXPECT_EQ(json::to_text(at(bright, "/figures/0/looks/inside/fill")), "\"#40bf40\""); // CSS Color 4, 7.1
    EXPECT_EQ(json::to_text(at(bright, "/figures/1/looks/inside/fill")), "\"#80004080\"");
    EXPECT_EQ(json::to_text(at(bright, "/figures/2/looks/inside/fill")), "\"#ffffff\"");

    const auto joined = import_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 \\\n0\nf 1 2 \\\r\n 3\nl 1 2\n# C:\\\nl 1 2\n");
    EXPECT_TRUE(has_note(joined, "7:", "lines are not taken (and 1 more)")); // numbers of lines are those of the file

    const auto obj = import_text("a.obj", "v 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0 1 # weight\nf 1 2 3\n");
    EXPECT_TRUE(has_note(obj, "1:", "colours of points are not taken"));
    EXPECT_FALSE(has_note(obj, "1:", "and"));

    const auto tiled = import_text("a.tmj", R"({"tilewidth":8,"tileheight":8,"width":9,"height":9,"layers":[
{"type":"objectgroup","opacity":0.5,"tintcolor":"#ff0000","objects":[{"template":"a.tj","x":1,"y":1},
{"x":8,"y":8,"width":8,"height":8,"properties":[{"name":"worth","value":7},{"name":"sensor","value":true}]}]}]})");
    for (const char* part : {"opacity", "tintcolor", "templates"}) EXPECT_TRUE(has_note(tiled, "2:", part)) << part;
    EXPECT_TRUE(has_note(tiled, "3:", "properties of one's own"));
    EXPECT_FALSE(has_note(tiled, "3:", "more"));

    auto robot = text_of(std::filesystem::path(source_dir()) / "tests/files/gltf/robot.gltf");
    robot.insert(robot.find('{') + 1, R"("extensionsUsed": ["KHR_lights_punctual"],)");
    const files::ImportFile lit{"a.gltf", "it", robot, std::filesystem::path(source_dir()) / "tests/files/gltf"};
    EXPECT_TRUE(has_note(files::import_file(lit), "1:", "KHR_lights_punctual"));
}

std::string glb_of(const std::string& json, const std::string& binary = "") {
    const auto word = [](std::size_t n) {
        return std::string{char(n & 255U), char(n >> 8U & 255U), char(n >> 16U & 255U), char(n >> 24U)};
    };
    const auto chunks = word(json.size()) + "JSON" + json + word(binary.size()) + std::string("BIN\0", 4) + binary;
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

/// A refused file: its name, its content, and what the message has.
struct Hostile {
    const char* name;
    std::string bytes;
    const char* place;
    const char* part;
};

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

TEST(Import, HostileFilesAreRefusedWithTheirPlace) {
    std::string bomb = "<svg width='9' height='9'><rect id='a0' fill='none' width='1' height='1'/>";
    for (int i = 1; i < 30; ++i) {
        const auto one = "<use href='#a" + std::to_string(i - 1) + "'/>";
        bomb += "<g id='a" + std::to_string(i) + "'>" + one + one + "</g>";
    }
    const std::string mesh =
        R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)";
    const std::vector<Hostile> all = {
        {"a.svg", "<svg width='9' height='9'>\n<g><rect", "2:", "breaks off"},
        {"a.svg", "<svg width='9' height='9'>\n <path d='M0 0L5 q'/></svg>", "2:3", "character 8 of the path"},
        {"a.svg", "<svg width='9' height='9'><rect width='nan' height='1'/></svg>", "1:28", "width is a length"},
        {"a.svg", "<svg width='9' height='9'><g transform='rotate(1,2)'/></svg>", "1:28", "transform"},
        {"a.svg", "<svg width='9' height='9'><rect width='1e8' height='1'/></svg>", "1:28", "beyond"},
        {"a.svg", "<svg width='1e7' height='9'/>", "1:2", "pixels"},
        {"a.svg", "<svg width='9' height='9'>" + repeated("<g>", 500) + repeated("</g>", 500) + "</svg>", "1:", "deep"},
        {"a.svg", "<svg width='9' height='9'><g id='a'><use href='#a'/></g></svg>", "1:", "refer to themselves"},
        {"a.svg", bomb + "</svg>", "1:", "elements are drawn"},
        {"a.svg", "<svg/>", "", "no shape"},
        {"a.obj", "v 0 0 0\nf 1 2 3\n", "2:1", "point"},
        {"a.obj", "v 0 0 nan\n", "1:1", "coordinate"},
        {"a.json", R"({"points":[{"x":1,"y":2}],"sticks":[[0,7]]})", "1:", "from 0 to 0"},
        {"a.json", "{\"points\":[{\"x\":1e99,\"y\":2}],\n\"sticks\":[]}", "1:17", "a million"},
        {"a.json", "{\"points\":[{\"x\":1,\n\"sticks\":", "2:", ""},
        {"a.tmj",
         R"({"tilewidth":8,"tileheight":8,"width":2,"height":1,"layers":[{"type":"tilelayer","width":2,"height":1,"data":[1]}]})",
         "1:", "expected 2 cells"},
        {"a.tmj",
         R"({"tilewidth":8,"tileheight":8,"width":2,"height":1,"layers":[{"type":"tilelayer","width":2,"height":1,"data":"AAA"}]})",
         "1:", "damaged"},
        {"a.tmj",
         R"({"tilewidth":8,"tileheight":8,"width":2,"height":1,"tilesets":[{"firstgid":1,"source":"../../etc/passwd"}],"layers":[]})",
         "1:", "its own folder"},
        {"a.tmj", R"({"tilewidth":8,"tileheight":8,"width":100001,"height":1,"layers":[]})", "1:", "whole number"},
        {"a.tmj", R"({"orientation":"isometric","tilewidth":8,"tileheight":8,"layers":[]})", "1:16", "orthogonal"},
        {"a.glb", glb_of("{}").substr(0, 20), "", "longer"},
        {"a.glb", glb_of("{}").substr(0, 12), "byte 12", "no JSON chunk"},
        {"a.glb", std::string("glTF\2\0\0\0\xff\0\0\0\xff\xff\xff\x7fJSON{}", 22), "byte 12", "longer than the rest"},
        {"a.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"data:,"}]})", "1:", "base64"},
        {"a.gltf", R"({"asset":{"version":"2.0"},"buffers":[],"scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}]})",
         "1:", "below itself"},
        {"a.glb",
         glb_of(
             mesh +
                 R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":12}],"buffers":[{"byteLength":12}]})",
             std::string(12, '\0')),
         "1:", "do not fit"},
        {"a.glb", glb_of(mesh + R"("accessors":[{"componentType":5126,"count":4000000000,"type":"VEC3"}]})"),
         "1:", "whole number"},
        {"a.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\1\0\0\0\1\0\0\x08\6\0\0\0\x6c\x84\x30\xe3", 33),
         "byte 8", "65536x65536"},
    };
    for (const auto& hostile : all) {
        const auto message = refusal(hostile.name, hostile.bytes);
        EXPECT_TRUE(message.starts_with(hostile.place)) << hostile.bytes.substr(0, 80) << "\n" << message;
        EXPECT_NE(message.find(hostile.part), std::string::npos) << hostile.bytes.substr(0, 80) << "\n" << message;
        EXPECT_NE(message, "accepted") << hostile.bytes.substr(0, 80);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
