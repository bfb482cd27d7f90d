#include "files/out/worn_image.h"

#include "sinew/picture/spine.h"

#include <algorithm>
#include <limits>

namespace sinew::files {
namespace {

WornImage worn(std::span<const Vec2<float>> grid, std::size_t across) {
    WornImage image{.points = {}, .on_image = {}, .across = across};
    const auto last_row = float(grid.size() / across - 1), last_column = float(across - 1);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        image.points.push_back({{double(grid[i][0]), -double(grid[i][1]), 0}});
        image.on_image.push_back({{float(i % across) / last_column, float(i / across) / last_row}});
    }
    return image;
}

/// A limb's band, whose left side is the image's top.
std::vector<WornImage> worn_band(const ProjectedPiece& piece, const Style& style) {
    constexpr std::size_t least_parts = 12, parts_a_bend = 4;
    Bends bends;
    limb_along(piece.points, bends);
    if (bends.empty()) return {};
    Spine spine;
    lay_out(bends, std::clamp(parts_a_bend * bends.size(), least_parts, max_parts), std::numeric_limits<float>::max(),
            spine);
    if (spine.size() == 0) return {};
    const auto& look = *style.image;
    const float width = look.size ? float(absolute((*look.size)[1])) * piece.scale : piece.width;
    const float end = look.size ? width : piece.end_width;
    Pixels sides, grid;
    sides_of(
        spine, [&](float share) { return (width + (end - width) * share) * thickness_at(style.profile, share); },
        sides);
    for (const std::size_t side : {0U, 1U})
        for (std::size_t i = 0; i < spine.size(); ++i) grid.push_back(sides[2 * i + side]);
    return {worn(grid, spine.size())};
}

} // namespace

std::vector<std::array<std::uint32_t, 3>> WornImage::triangles() const {
    std::vector<std::array<std::uint32_t, 3>> all;
    const auto wide = std::uint32_t(across), rows = std::uint32_t(points.size()) / wide;
    for (std::uint32_t i = 0; i + wide < rows * wide; ++i) {
        if (i % wide == wide - 1) continue;
        all.push_back({i, i + wide, i + 1});
        all.push_back({i + 1, i + wide, i + wide + 1});
    }
    return all;
}

std::vector<WornImage> worn_images(const ProjectedPiece& piece, const Style& style,
                                   const std::shared_ptr<const Image>& image) {
    if (piece.mark == Mark::limb) return worn_band(piece, style);
    constexpr float nominal_pixel = 0.005F; // metres: parts of the limbs that end in a tip are shorter than 2 cm
    Picture picture;
    picture.images = {image};
    PieceRenderer(picture, nominal_pixel).paint_image(piece, *style.image, style.profile, 0, 0, {0, 0, 0, 0});
    std::vector<WornImage> images;
    for (const auto& item : picture.items) images.push_back(worn(picture.points_of(item), item.across));
    return images;
}

WornImage worn_quad(std::span<const Vec3<double>> corners) {
    // Within a part the image is off by a 64th of what the quadrilateral's diagonals' middles are apart.
    constexpr std::size_t parts = 4;
    WornImage image{.points = {}, .on_image = {}, .across = parts + 1};
    for (std::size_t row = 0; row <= parts; ++row)
        for (std::size_t column = 0; column <= parts; ++column) {
            const double u = double(column) / parts, v = double(row) / parts;
            image.points.push_back((corners[0] * (1 - u) + corners[1] * u) * (1 - v) +
                                   (corners[3] * (1 - u) + corners[2] * u) * v);
            image.on_image.push_back({{float(u), float(v)}});
        }
    return image;
}

} // namespace sinew::files
