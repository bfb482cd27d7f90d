#include "files/out/linear_keys.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/files/export_scenes.h"
#include "tests/files/glb_file.h"

#include <cmath>

/// Binary glTF, read back, against the positions of the world.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

constexpr float fps = 60;

/// Largest distance of the cloth of a file from where its vertices were.
float cloth_error(const GlbFile& file, const std::vector<Positions>& seen) {
    const auto& primitive = file.mesh_of("silk/cloth")["primitives"][0];
    const auto base = file.numbers(primitive["attributes"]["POSITION"]);
    const auto weights = file.curve("silk/cloth", "weights");
    std::vector<std::vector<float>> targets;
    for (const auto& target : primitive["targets"]) targets.push_back(file.numbers(target["POSITION"]));
    float worst = 0;
    for (std::size_t frame = 0; frame < seen.size(); ++frame) {
        const auto now = weights.at(float(frame) / fps);
        auto sum = base;
        for (std::size_t target = 0; target < targets.size(); ++target)
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += now[target] * targets[target][i];
        for (std::size_t i = 0; i < sum.size(); i += 3)
            worst = std::max(worst, norm(Vec3<float>{{sum[i], sum[i + 1], sum[i + 2]}} - seen[frame][i / 3]));
    }
    return worst;
}

TEST(GltfCloth, IsWhereItWasToTheStatedError) {
    const ScratchFolder folder;
    std::size_t before = 1000;
    for (const double millimetres : {0.01, 5.0, 50.0}) {
        const auto seen = export_frames<3>(
            sheet("", 5), {.path = folder / "s.glb", .fps = double(fps), .tolerance = millimetres}, 60);
        const GlbFile file(text_of(folder / "s.glb"));
        EXPECT_LE(cloth_error(file, seen), 1e-3 * millimetres + 1e-6); // floats of about 3 m
        const auto keys = file.curve("silk/cloth", "weights").seconds.size();
        EXPECT_EQ(file.mesh_of("silk/cloth")["primitives"][0]["targets"].size(), keys - 1);
        EXPECT_LE(keys, before);
        before = keys;
    }
    EXPECT_LT(before, 30u);
}

TEST(GltfCloth, TakesRoomAsItsFrames) {
    const ScratchFolder folder;
    std::vector<std::size_t> bytes;
    for (const int frames : {40, 80, 160}) {
        export_frames<3>(sheet("", 5), {.path = folder / "s.glb", .fps = double(fps), .tolerance = 0}, frames);
        bytes.push_back(text_of(folder / "s.glb").size());
    }
    // Twice the frames, twice the room that they take: 5 % for longer numbers in the text.
    EXPECT_LT(double(bytes[2] - bytes[1]), 2.1 * double(bytes[1] - bytes[0]));
}

TEST(GltfNodes, AreInMetresWithYUpwards) {
    const ScratchFolder folder;
    export_frames<2>(falling(), {.path = folder / "f.glb", .fps = double(fps)}, 30);
    auto session = falling();
    const GlbFile file(text_of(folder / "f.glb"));
    const auto ball = file.curve("ball/ball_0", "translation");
    for (std::size_t frame = 0; frame < 30; ++frame) {
        const auto at = positions<2>(session, true, 100)[0];
        const auto read = ball.at(float(frame) / fps);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(read[std::size_t(i)], at[i], 1e-5F); // a hundredth of a millimetre
        session.step();
    }
}

TEST(GltfRods, BeginAndEndAtTheirParticles) {
    const ScratchFolder folder;
    const auto seen = export_frames<2>(
        started(R"({"sinew": 1, "solver": {"precision": "double"}, "world": {"gravity": [0, -9.81]}, "figures": [
        {"prefab": "rope", "name": "rope", "at": [0, 0], "turn": 60, "length": 2, "segments": 2}]})"),
        {.path = folder / "r.glb", .fps = double(fps)}, 60);
    const GlbFile file(text_of(folder / "r.glb"));
    const auto turns = file.curve("rope/rope_1", "rotation"), places = file.curve("rope/rope_1", "translation");
    const double length = double(norm(seen[0][2] - seen[0][1]));
    for (std::size_t frame = 0; frame < seen.size(); ++frame) {
        const auto q = turns.at(float(frame) / fps), p = places.at(float(frame) / fps);
        // The y axis of a quaternion (x, y, z, w).
        const Vec3<double> along{{2.0 * double(q[0] * q[1] - q[2] * q[3]), 1 - 2.0 * double(q[0] * q[0] + q[2] * q[2]),
                                  2.0 * double(q[1] * q[2] + q[0] * q[3])}};
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(p[std::size_t(i)], seen[frame][1][i], 1e-5F);
            EXPECT_NEAR(double(p[std::size_t(i)]) + length * along[i], double(seen[frame][2][i]), 2e-5);
        }
    }
}

TEST(GltfCrate, IsOneNodeThatMoves) {
    const ScratchFolder folder;
    export_frames<2>(started(R"({"sinew": 1, "solver": {"precision": "double"},
        "world": {"gravity": [0, -9.81], "bounds": {"planes": [{"normal": [0, 1]}]}},
        "figures": [{"prefab": "box", "name": "crate", "at": [0, 1], "turn": 30, "velocity": [1, -5]}]})"),
                     {.path = folder / "c.glb", .fps = double(fps)}, 30);
    const GlbFile file(text_of(folder / "c.glb"));
    for (const auto& channel : file.json["animations"][0]["channels"])
        EXPECT_EQ(channel["target"]["node"], file.node("crate"));
    EXPECT_FALSE(file.curve("crate", "rotation").numbers.empty());
}

TEST(LinearKeys, AreOfOrdinaryFramesWhereNumbersAreNot) {
    const float none = std::nanf("");
    const std::vector<float> numbers{0, none, none, none, 4, 5, 6, 7}, tolerance{0.1F};
    EXPECT_EQ(files::linear_keys(numbers, tolerance).back(), 7u);
    EXPECT_EQ(files::linear_keys(std::vector<float>{3}, tolerance), (std::vector<std::size_t>{0}));
    EXPECT_EQ(files::linear_keys({}, tolerance), (std::vector<std::size_t>{0}));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
