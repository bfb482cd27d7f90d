#include "sinew/scene/reader.h"
#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include "canvas/png.h"
#include "files/out/export_formats.h"
#include "files/out/frame_name.h"
#include "files/out/tracks.h"
#include "tests/canvas/scratch_folder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

/// Files for other programs, read back by readers of a few lines each, against the positions of the world.
namespace sinew::SINEW_TEST_FILE {
namespace {

using Json = nlohmann::json;
using Positions = std::vector<Vec3<float>>;

Session play(const std::string& text) {
    auto document = load(text, "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}

/// A sheet of 3 x `rows` particles that falls off its two pins' line.
Session sheet(const std::string& more = {}, int rows = 2) {
    return play(R"({"sinew": 1, "dimension": 3, "solver": {"precision": "double"}, "world": {"gravity": [1, -9.81, 2]},
                    "figures": [{"prefab": "cloth", "name": "silk", "columns": 3, "rows": )" +
                std::to_string(rows) + R"(, "plane": "horizontal",
                                 "pins": "corners", "drawn": "fill"})" +
                more + "]}");
}

/// A scene in px with y downwards: a ball that falls, and a rope.
Session falling() {
    return play(R"({"sinew": 1, "units": {"length": "px", "time": "frame", "up": "-y"},
                    "world": {"gravity": [0, 0.1]}, "solver": {"precision": "double"}, "view": {"size": [64, 48], "plain": true},
                    "figures": [{"prefab": "ball", "name": "ball", "at": [32, 10], "radius": 5},
                                {"prefab": "rope", "name": "rope", "at": [10, 10], "turn": 60, "length": 20, "segments": 2}]})");
}

template <int D> Positions positions(const Session& session, bool y_down = false, double per_metre = 1) {
    Positions all;
    const auto& world = std::get<World<D, double>>(session.world());
    for (Row row = 0; row < world.particles.size(); ++row) {
        Vec3<float> p{};
        for (int i = 0; i < D; ++i)
            p[i] = float(world.particles.position[row][i] / per_metre * (i > 0 && y_down ? -1 : 1));
        all.push_back(p);
    }
    return all;
}

/// Exports so many frames, a step each, and returns what the particles' positions were.
template <int D>
std::vector<Positions> export_frames(Session session, const files::ExportRequest& request, int frames) {
    const auto* const format = files::export_format_of(request.path);
    EXPECT_NE(format, nullptr);
    const auto exporter = format->open(request);
    std::vector<Positions> seen;
    for (int i = 0; i < frames; ++i) {
        EXPECT_EQ(exporter->frame(session), std::nullopt);
        seen.push_back(positions<D>(session));
        session.step();
    }
    EXPECT_EQ(exporter->finish(), std::nullopt);
    return seen;
}

std::uint32_t number_at(const std::string& bytes, std::size_t at, bool highest_first = false) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
        number |= std::uint32_t(std::uint8_t(bytes.at(at + i))) << (8 * (highest_first ? 3 - i : i));
    return number;
}
Vec3<float> vector_at(const std::string& bytes, std::size_t at, bool highest_first = false) {
    Vec3<float> v{};
    for (int i = 0; i < 3; ++i) v[i] = std::bit_cast<float>(number_at(bytes, at + 4 * std::size_t(i), highest_first));
    return v;
}

/// A .glb: its JSON, and numbers of its accessors.
struct Glb {
    explicit Glb(const std::string& bytes) {
        EXPECT_EQ(bytes.substr(0, 4), "glTF");
        EXPECT_EQ(number_at(bytes, 4), 2u);
        EXPECT_EQ(number_at(bytes, 8), bytes.size());
        const std::size_t length = number_at(bytes, 12);
        json = Json::parse(bytes.substr(20, length));
        binary = bytes.substr(28 + length);
        EXPECT_EQ(json["buffers"][0]["byteLength"], binary.size());
    }

    std::vector<float> numbers(const Json& accessor) const {
        const auto& a = json["accessors"][accessor.get<std::size_t>()];
        const auto& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
        std::vector<float> all(view["byteLength"].get<std::size_t>() / 4);
        std::memcpy(all.data(), binary.data() + view["byteOffset"].get<std::size_t>(), 4 * all.size());
        return all;
    }

    std::size_t node(const std::string& name) const {
        for (std::size_t i = 0; i < json["nodes"].size(); ++i)
            if (json["nodes"][i]["name"] == name) return i;
        ADD_FAILURE() << "no node " << name;
        return 0;
    }

    /// Values of a node's animated path; empty if it is not animated.
    std::vector<float> animation(const std::string& name, const std::string& path) const {
        const auto& animation = json["animations"][0];
        for (const auto& channel : animation["channels"])
            if (channel["target"]["node"] == node(name) && channel["target"]["path"] == path)
                return numbers(animation["samplers"][channel["sampler"].get<std::size_t>()]["output"]);
        return {};
    }

    Json json;
    std::string binary;
};

TEST(PointCaches, HoldThePositionsOfEveryFrame) {
    const ScratchFolder folder;
    for (const bool is_mdd : {false, true}) {
        const auto seen = export_frames<3>(sheet(), {.path = folder / (is_mdd ? "s.mdd" : "s.pc2"), .fps = 60}, 4);
        const auto bytes = text_of(folder / (is_mdd ? "s.mdd" : "s.pc2"));
        const std::size_t header = is_mdd ? 8 + 4 * 4 : 32;
        ASSERT_EQ(bytes.size(), header + 4 * 6 * 12);
        EXPECT_EQ(number_at(bytes, is_mdd ? 0 : 28, is_mdd), 4u); // frames
        EXPECT_EQ(number_at(bytes, is_mdd ? 4 : 16, is_mdd), 6u); // vertices
        for (std::size_t frame = 0; frame < 4; ++frame)
            for (std::size_t i = 0; i < 6; ++i)
                EXPECT_EQ(vector_at(bytes, header + 12 * (6 * frame + i), is_mdd), seen[frame][i]);
    }
}

TEST(ObjFrames, HaveAVertexAParticleAndAFaceACell) {
    const ScratchFolder folder;
    const auto seen = export_frames<3>(sheet(), {.path = folder / "s-%02d.obj"}, 2);
    std::istringstream text(text_of(folder / "s-02.obj"));
    Positions vertices;
    std::vector<std::vector<int>> faces;
    for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            auto& v = vertices.emplace_back();
            words >> v[0] >> v[1] >> v[2];
        } else if (kind == "f") {
            faces.emplace_back(std::istream_iterator<int>(words), std::istream_iterator<int>());
        }
    }
    EXPECT_EQ(vertices, seen[1]);
    EXPECT_EQ(faces, (std::vector<std::vector<int>>{{1, 2, 5, 4}, {2, 3, 6, 5}}));
    EXPECT_NE(text_of(folder / "s.mtl").find("newmtl silk_cloth"), std::string::npos);
}

TEST(Ply, HoldsColouredVertices) {
    const ScratchFolder folder;
    const auto seen = export_frames<3>(sheet(R"(, {"prefab": "ball", "name": "ball", "at": [0, 5, 0]})"),
                                       {.path = folder / "s.ply"}, 1);
    const auto bytes = text_of(folder / "s.ply");
    EXPECT_NE(bytes.find("element vertex 7\n"), std::string::npos);
    const auto data = bytes.find("end_header\n") + 11;
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(vector_at(bytes, data + 16 * i), seen[0][i]);
    EXPECT_EQ(bytes.size(), data + 7 * 16 + 2 * (4 + 4 * 4)); // two cells
}

TEST(GltfCloth, HasAMorphTargetAFrame) {
    const ScratchFolder folder;
    const auto seen = export_frames<3>(sheet("", 5), {.path = folder / "s.glb", .fps = 60}, 30);
    const Glb file(text_of(folder / "s.glb"));
    const auto& mesh = file.json["meshes"][file.json["nodes"][file.node("silk/cloth")]["mesh"].get<std::size_t>()];
    const auto& primitive = mesh["primitives"][0];
    const auto base = file.numbers(primitive["attributes"]["POSITION"]);
    const auto weights = file.animation("silk/cloth", "weights");
    ASSERT_EQ(weights.size(), 30u * 29u);
    for (std::size_t frame = 0; frame < 30; ++frame) {
        auto sum = base;
        for (std::size_t target = 0; target < 29; ++target) {
            const auto moved = file.numbers(primitive["targets"][target]["POSITION"]);
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weights[29 * frame + target] * moved[i];
        }
        // Differences of numbers below 1: a rounding each.
        for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_NEAR(sum[i], seen[frame][i / 3][int(i % 3)], 2e-7F);
    }
}

TEST(GltfNodes, AreInMetresWithYUpwards) {
    const ScratchFolder folder;
    export_frames<2>(falling(), {.path = folder / "f.glb", .fps = 60}, 3);
    auto session = falling();
    const Glb file(text_of(folder / "f.glb"));
    const auto ball = file.animation("ball/ball_0", "translation");
    ASSERT_EQ(ball.size(), 9u);
    for (std::size_t frame = 0; frame < 3; ++frame) {
        const auto at = positions<2>(session, true, 100)[0];
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(ball[3 * frame + std::size_t(i)], at[i], 1e-7F);
        session.step();
    }
}

TEST(GltfRods, BeginAndEndAtTheirParticles) {
    const ScratchFolder folder;
    const auto seen = export_frames<2>(
        play(R"({"sinew": 1, "solver": {"precision": "double"}, "world": {"gravity": [0, -9.81]}, "figures": [
        {"prefab": "rope", "name": "rope", "at": [0, 0], "turn": 60, "length": 2, "segments": 2}]})"),
        {.path = folder / "r.glb", .fps = 60}, 20);
    const Glb file(text_of(folder / "r.glb"));
    const auto turns = file.animation("rope/rope_1", "rotation");
    const auto places = file.animation("rope/rope_1", "translation");
    const double length = double(norm(seen[0][2] - seen[0][1]));
    ASSERT_EQ(turns.size(), 20u * 4u);
    for (std::size_t frame = 0; frame < 20; ++frame) {
        const float *const q = &turns[4 * frame], *const p = &places[3 * frame];
        // The y axis of a quaternion (x, y, z, w).
        const Vec3<double> along{{2.0 * double(q[0] * q[1] - q[2] * q[3]), 1 - 2.0 * double(q[0] * q[0] + q[2] * q[2]),
                                  2.0 * double(q[1] * q[2] + q[0] * q[3])}};
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(p[i], seen[frame][1][i], 1e-6F);
            EXPECT_NEAR(double(p[i]) + length * along[i], double(seen[frame][2][i]), 1e-5);
        }
    }
}

TEST(GltfCrate, IsOneNodeThatMoves) {
    const ScratchFolder folder;
    export_frames<2>(play(R"({"sinew": 1, "solver": {"precision": "double"},
        "world": {"gravity": [0, -9.81], "bounds": {"planes": [{"normal": [0, 1]}]}},
        "figures": [{"prefab": "box", "name": "crate", "at": [0, 1], "turn": 30, "velocity": [1, -5]}]})"),
                     {.path = folder / "c.glb", .fps = 60}, 30);
    const Glb file(text_of(folder / "c.glb"));
    for (const auto& channel : file.json["animations"][0]["channels"])
        EXPECT_EQ(channel["target"]["node"], file.node("crate"));
    EXPECT_FALSE(file.animation("crate", "rotation").empty());
}

TEST(MeshFilms, RefuseAFigureThatIsCut) {
    const ScratchFolder folder;
    for (const auto* name : {"s.pc2", "s.glb"}) {
        auto session = sheet();
        const auto exporter = files::export_format_of(name)->open({.path = folder / name});
        ASSERT_EQ(exporter->frame(session), std::nullopt);
        std::visit([](auto& world) { remove_figure(world, FigureIndex(0)); }, session.world());
        const auto failure = exporter->frame(session);
        ASSERT_TRUE(failure);
        EXPECT_NE(failure->find("one mesh for all frames"), std::string::npos) << *failure;
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(FrameNames, CountFromOne) {
    EXPECT_EQ(files::frame_path("a/b-%04d.obj", 7), "a/b-0007.obj");
    EXPECT_EQ(files::frame_path("b%d.png", 12345), "b12345.png");
    EXPECT_EQ(files::frame_path("100%%-%2d.png", 3), "100%- 3.png");
    EXPECT_EQ(files::frame_path("plain.png", 3), "plain.png");
    EXPECT_FALSE(files::has_frame_number("50%.png"));
    EXPECT_TRUE(files::frame_number_problem("%d-%d.png"));
    EXPECT_FALSE(files::frame_number_problem("%%d-%d.png"));
}

/// A track of one point along given numbers.
files::Track track_of(const std::vector<float>& xs) {
    files::Track track;
    track.shape = Shape::disc, track.points = 1;
    for (const float x : xs)
        for (const float number : {x, 0.0F, 3.0F, 1.0F, 0.0F, 0.0F, 1.0F}) track.numbers.push_back(number);
    return track;
}

TEST(Keys, OfAStraightMotionAreItsEnds) {
    std::vector<float> xs;
    for (int i = 0; i < 50; ++i) xs.push_back(float(3 * i));
    EXPECT_EQ(files::keys_of(track_of(xs), 0.01, false), (std::vector<std::size_t>{0, 49}));
    EXPECT_EQ(files::keys_of(track_of(std::vector<float>(50, 4)), 0.01, false), (std::vector<std::size_t>{0}));
}

TEST(Keys, KeepTheStatedError) {
    std::vector<float> xs;
    for (int i = 0; i < 200; ++i) xs.push_back(100 * std::sin(0.05F * float(i)) + (i % 37 == 0 ? 9.0F : 0.0F));
    for (const double tolerance : {0.1, 1.0, 5.0}) {
        const auto keys = files::keys_of(track_of(xs), tolerance, false);
        EXPECT_LT(keys.size(), xs.size());
        ASSERT_EQ(keys.back(), xs.size() - 1);
        for (std::size_t k = 0; k + 1 < keys.size(); ++k)
            for (auto i = keys[k]; i <= keys[k + 1]; ++i) {
                const float share = float(i - keys[k]) / float(keys[k + 1] - keys[k]);
                const float between = xs[keys[k]] + (xs[keys[k + 1]] - xs[keys[k]]) * share;
                EXPECT_NEAR(between, xs[i], tolerance + 1e-4);
            }
    }
}

TEST(Lottie, HasTheDiscWhereTheBallIs) {
    const ScratchFolder folder;
    const int frames = 12;
    auto session = falling();
    export_frames<2>(session, {.path = folder / "f.json", .fps = 60, .size = {64, 48}, .tolerance = 0}, frames);
    const auto json = Json::parse(text_of(folder / "f.json"));
    EXPECT_EQ(json["op"], frames);
    Json keys;
    for (const auto& layer : json["layers"])
        for (const auto& group : layer["shapes"])
            if (group["it"][0]["ty"] == "el") keys = group["it"][0]["p"]["k"];
    ASSERT_EQ(keys.size(), std::size_t(frames)); // an accelerated motion keeps every frame where no error is allowed
    for (int frame = 0; frame < frames; ++frame) {
        const auto pixel = session.view(64, 48).see({{32, double(positions<2>(session)[0][1]), 0}})->pixel;
        EXPECT_NEAR(keys[std::size_t(frame)]["s"][1].get<double>(), double(pixel[1]), 0.006); // hundredths
        session.step();
    }
}

TEST(AnimatedSvg, MovesTheBallInALoop) {
    const ScratchFolder folder;
    export_frames<2>(falling(), {.path = folder / "f.svg", .fps = 60, .size = {64, 48}}, 60);
    const auto text = text_of(folder / "f.svg");
    EXPECT_NE(text.find("<animate attributeName=\"cy\" dur=\"1s\" repeatCount=\"indefinite\" keyTimes=\"0;"),
              std::string::npos);
    EXPECT_EQ(text.find("attributeName=\"cx\""), std::string::npos); // it falls straight down
    EXPECT_TRUE(text.ends_with("</svg>\n"));
}

TEST(PngFrames, AreTransparentOnRequest) {
    const ScratchFolder folder;
    files::ExportRequest request{.path = folder / "f-%d.png", .size = {64, 48}, .background = Color{0, 0, 0, 0}};
    export_frames<2>(falling(), request, 1);
    const auto read = canvas::read_png(folder / "f-1.png", "f-1.png", {});
    ASSERT_TRUE(read.image);
    EXPECT_EQ(read.image->pixels[0], 0u);                    // the corner
    EXPECT_EQ(read.image->pixels[10 * 64 + 32] >> 24, 255u); // the ball
}

TEST(Exports, LeaveNothingUnlessFinished) {
    const ScratchFolder folder;
    for (const auto& format : files::export_formats()) {
        if (format.frames == files::FramesPerFile::one) continue;
        const auto exporter = format.open({.path = folder / ("f" + std::string(format.ending)), .size = {64, 48}});
        EXPECT_EQ(exporter->frame(falling()), std::nullopt) << format.name;
    }
    EXPECT_TRUE(folder.names().empty());
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
