#include "sinew/picture/draw.h"
#include "sinew/session/session.h"

#include "canvas/png.h"
#include "canvas/raster.h"
#include "tests/canvas/golden_picture.h"
#include "tests/paths.h"
#include "tests/scene/models.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

/// Every scene in every mode looks as it did: images/README.md says how to renew what is meant to look different.
namespace sinew::SINEW_TEST_FILE {
namespace {

namespace fs = std::filesystem;

const fs::path folder = test::source_dir() + "/tests/golden/images";
constexpr int width = 160, height = 120;
constexpr double min_ssim = 0.995;

struct Shot {
    std::string scene, mode;
    std::string name() const { return scene + "_" + mode; }
    fs::path golden() const { return folder / (name() + ".png"); }
    friend void PrintTo(const Shot& shot, std::ostream* out) { *out << shot.name(); }
};

std::vector<Shot> shots() {
    std::vector<Shot> all;
    for (const auto& entry : fs::directory_iterator(test::scenes_dir()))
        if (entry.path().extension() == ".json")
            for (const auto mode : modes) all.push_back({entry.path().stem().string(), std::string(mode)});
    std::ranges::sort(all, {}, &Shot::name);
    return all;
}

std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A fifth into its time; 32 shades a channel, which makes small files.
Image taken(const Shot& shot) {
    const auto path = fs::path(test::scenes_dir()) / (shot.scene + ".json");
    const std::vector<Override> overrides = {{"mode=" + shot.mode}};
    auto document = load(bytes_of(path), path.string(), overrides);
    const auto image_at = [&](const std::string& name, const Limits& limits) {
        return canvas::read_png(path.parent_path() / name, name, limits);
    };
    auto opened = open_scene(document, image_at, models_beside(path));
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    Image image{width, height, std::vector<std::uint32_t>(width * height)};
    if (!opened) return image;
    Session session(std::move(*opened));
    session.run_until(session.scene().seconds / 5);
    Picture picture;
    picture.width = width;
    picture.height = height;
    draw(session, picture);
    std::erase_if(picture.items, [](const auto& item) { return item.shape == Shape::text; }); // fonts differ
    canvas::Raster raster(width, height);
    EXPECT_EQ(raster.paint(picture), canvas::Failure());
    std::memcpy(image.pixels.data(), raster.bytes().data(), raster.bytes().size());
    take_few_shades(image);
    return image;
}

class GoldenImage : public testing::TestWithParam<Shot> {};

TEST_P(GoldenImage, LooksAsItDid) {
    const auto& shot = GetParam();
    expect_looks_like(shot.golden(), taken(shot), min_ssim);
}

INSTANTIATE_TEST_SUITE_P(Scenes, GoldenImage, testing::ValuesIn(shots()),
                         [](const auto& shot) { return shot.param.name(); });

TEST(GoldenImages, AreOfScenesThatExistAndSmall) {
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".png") continue;
        bytes += entry.file_size();
        const auto all = shots();
        EXPECT_TRUE(std::ranges::any_of(all, [&](const Shot& shot) { return shot.golden() == entry.path(); }))
            << entry.path() << " is of no scene";
    }
    EXPECT_LT(bytes, 500'000U);
}

// The measure sees what the eye sees.
TEST(Ssim, IsOneForEqualAndLowForWhatIsMissing) {
    Image flat{64, 48, std::vector<std::uint32_t>(64 * 48, 0xfff6f1e7)}, lined = flat, moved = flat;
    for (std::size_t y = 0; y < 48; ++y) {
        lined.pixels[y * 64 + 30] = 0xff2b2d42;
        moved.pixels[y * 64 + 32] = 0xff2b2d42;
    }
    EXPECT_EQ(ssim(lined, lined), 1);
    EXPECT_LT(ssim(lined, flat), 0.95);
    EXPECT_LT(ssim(lined, moved), 0.95);
    auto paler = lined;
    for (auto& pixel : paler.pixels) pixel -= 0x010101; // one shade: nobody sees it
    EXPECT_GT(ssim(lined, paler), 0.999);
    EXPECT_EQ(ssim(flat, Image{32, 96, flat.pixels}), 0);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
