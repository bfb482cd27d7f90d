#pragma once

#include "canvas/cairo_handle.h"
#include "canvas/png.h"
#include "tests/canvas/ssim.h"

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

/// Pictures that are kept, and what looks like them.
namespace sinew {

inline void write_png(const Image& image, const std::filesystem::path& path) {
    auto pixels = image.pixels;
    const canvas::CairoSurface surface(
        cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_RGB24,
                                            image.width, image.height, 4 * image.width));
    EXPECT_EQ(cairo_surface_write_to_png(surface.get(), path.c_str()), CAIRO_STATUS_SUCCESS);
}

/// 32 shades a channel, which makes small files.
inline void take_few_shades(Image& image) {
    for (auto& pixel : image.pixels) pixel = (pixel & 0xf8f8f8U) | 0xff000000U;
}

/// With SINEW_RENEW_GOLDEN in the environment a file that looks otherwise is written anew.
inline void expect_looks_like(const std::filesystem::path& file, const Image& now, double min_ssim) {
    const auto name = file.stem().string();
    if (std::getenv("SINEW_RENEW_GOLDEN")) {
        // What looks the same keeps its file, whatever cairo rounds otherwise.
        const auto old = canvas::read_png(file, name, {});
        if (!old.image || ssim(*old.image, now) < min_ssim) write_png(now, file);
    }
    const auto golden = canvas::read_png(file, name, {});
    ASSERT_TRUE(golden.image) << golden.problem << "\nSee " << file.parent_path() / "README.md";
    const double found = ssim(*golden.image, now);
    const auto seen = std::filesystem::temp_directory_path() / ("sinew_" + name + ".png");
    if (found < min_ssim) write_png(now, seen);
    EXPECT_GE(found, min_ssim) << seen << " is what it looks like now, " << file
                               << " what it did.\nIf it is meant to, see README.md beside it";
}

} // namespace sinew
