#include "tests/canvas/scratch_folder.h"
#include "tests/files/export_scenes.h"
#include "tests/files/imported.h"

#include <cmath>

/// A figure that is exported and imported again is the same.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

/// First positions of the particles of an imported scene, in 3D, metres.
Positions imported_positions(const files::Imported& imported) {
    std::string why;
    auto opened = open_imported(imported, &why);
    EXPECT_TRUE(opened) << why;
    Positions all;
    if (opened)
        std::visit(
            [&]<int D, class Real>(const World<D, Real>& world) {
                for (const auto& p : world.particles.position) {
                    Vec3<float> place{};
                    for (int i = 0; i < D; ++i) place[i] = float(p[i]);
                    all.push_back(place);
                }
            },
            opened->world);
    return all;
}

/// Largest distance of a position from the nearest of others, which are as many.
float distance_between(const Positions& from, const Positions& to) {
    float worst = 0;
    for (const auto& p : from) {
        float nearest = 1e30F;
        for (const auto& q : to) nearest = std::min(nearest, norm(p - q));
        worst = std::max(worst, nearest);
    }
    return worst;
}

/// A sheet in a slanted and wavy pose.
std::vector<Positions> exported_sheet(const std::filesystem::path& path) {
    auto session = sheet(
        R"(, {"prefab": "cloth", "name": "second", "columns": 4, "rows": 4, "drawn": "fill", "at": [3, 1, 0]})", 5);
    for (int i = 0; i < 20; ++i) session.step();
    return export_frames<3>(std::move(session), {.path = path, .fps = 60}, 1);
}

TEST(RoundTrip, ClothOfAGlbAndAnObjIsWhereItWas) {
    const ScratchFolder folder;
    for (const char* name : {"s.glb", "s.obj"}) {
        const auto seen = exported_sheet(folder / name).at(0);
        const auto imported = files::import_file({name, "it", text_of(folder / name), folder.path}, {.role = "cloth"});
        const auto again = imported_positions(imported);
        ASSERT_EQ(again.size(), seen.size()) << name;
        EXPECT_LE(distance_between(seen, again), 1e-5F) << name; // a model has six digits
        EXPECT_LE(distance_between(again, seen), 1e-5F) << name;
    }
}

/// A rope's line in pixels: its ends stay, and the rope hangs from the first.
TEST(RoundTrip, RopeOfAnSvgBeginsAndEndsWhereItWas) {
    const ScratchFolder folder;
    const auto session = falling();
    export_frames<2>(falling(),
                     {.path = folder / "f.svg", .fps = 60, .size = {64, 48}, .background = Color{0, 0, 0, 0}}, 1);
    const auto imported = files::import_file({"f.svg", "it", text_of(folder / "f.svg"), folder.path}, {});
    const auto view = session.view(64, 48);
    const auto seen = positions<2>(session);
    const auto again = imported_positions(imported);
    for (const auto i : {1, 3}) { // the rope's ends, after the ball
        const auto pixel = view.see(cast<double>(seen.at(std::size_t(i))))->pixel;
        const Positions end{{{pixel[0], pixel[1], 0}}};
        EXPECT_LE(distance_between(end, again), 0.02F); // an SVG has hundredths
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
