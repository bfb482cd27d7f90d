#include "tests/canvas/scratch_folder.h"
#include "tests/files/export_scenes.h"
#include "tests/files/moving_nodes.h"

/// Cloth skinned to joints, as an engine moves it, against the positions of the world.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

constexpr float fps = 60;
constexpr std::size_t influences = 4;

template <class Number> std::vector<Number> numbers_of(const GlbFile& file, const GlbFile::Json& accessor) {
    const auto& view =
        file.json["bufferViews"][file.json["accessors"][accessor.get<std::size_t>()]["bufferView"].get<std::size_t>()];
    std::vector<Number> all(view["byteLength"].get<std::size_t>() / sizeof(Number));
    std::memcpy(all.data(), file.binary.data() + view["byteOffset"].get<std::size_t>(), sizeof(Number) * all.size());
    return all;
}

/// Largest distance of the cloth from where its vertices were, by the formula of skins in glTF 2.0.
double skin_error(const GlbFile& file, const std::vector<Positions>& seen) {
    const auto& attributes = file.mesh_of("silk/cloth")["primitives"][0]["attributes"];
    const auto rest = file.numbers(attributes["POSITION"]), weights = file.numbers(attributes["WEIGHTS_0"]);
    const auto joints = numbers_of<std::uint16_t>(file, attributes["JOINTS_0"]);
    const auto& skin = file.json["skins"][0];
    const auto inverses = file.numbers(skin["inverseBindMatrices"]);
    double worst = 0;
    for (std::size_t frame = 0; frame < seen.size(); frame += 13) {
        std::vector<NodePose> poses;
        for (const auto& joint : skin["joints"])
            poses.push_back(world_pose(file, joint.get<std::size_t>(), float(frame) / fps));
        for (std::size_t i = 0; i < seen[frame].size(); ++i) {
            Vec3<double> sum{};
            double whole = 0;
            for (std::size_t k = influences * i; k < influences * (i + 1); ++k) {
                Vec3<double> bound{};
                for (std::size_t c = 0; c < 3; ++c)
                    bound[int(c)] = double(rest[3 * i + c]) + double(inverses[16u * joints[k] + 12 + c]);
                sum += poses.at(joints[k])(bound) * double(weights[k]);
                whole += double(weights[k]);
            }
            EXPECT_NEAR(whole, 1, 1e-6);
            worst = max(worst, norm(sum - cast<double>(seen[frame][i])));
        }
    }
    return worst;
}

TEST(GltfSkin, CarriesClothNearToWhereItWas) {
    const ScratchFolder folder;
    constexpr double near = 0.05; // metres; 0.028 was measured
    for (const std::size_t joints : {4u, 16u}) {
        const auto path = folder / "s.glb";
        const auto seen = export_frames<3>(sheet("", 9), {.path = path, .fps = double(fps), .joints = joints}, 40);
        const GlbFile file(text_of(path));
        EXPECT_EQ(file.json["skins"][0]["joints"].size(), joints);
        EXPECT_FALSE(file.mesh_of("silk/cloth")["primitives"][0].contains("targets"));
        EXPECT_LT(skin_error(file, seen), near);
    }
}

TEST(GltfSkin, TakesLessRoomThanTargetsWhereItHasManyFrames) {
    const ScratchFolder folder;
    std::vector<std::size_t> bytes;
    for (const std::size_t joints : {0u, 4u}) {
        export_frames<3>(sheet("", 20), {.path = folder / "s.glb", .fps = double(fps), .joints = joints}, 60);
        bytes.push_back(text_of(folder / "s.glb").size());
    }
    EXPECT_LT(3 * bytes[1], bytes[0]);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
