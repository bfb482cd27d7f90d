#include "sinew/world/edit.h"

#include "canvas/png.h"
#include "files/out/frame_name.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/files/export_scenes.h"

#include <bit>
#include <iterator>
#include <sstream>

/// Files for other programs, read back by readers of a few lines each, against the positions of the world.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

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
