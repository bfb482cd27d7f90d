#pragma once

#include "sinew/math/vec.h"
#include "sinew/picture/piece_renderer.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// Images worn by pieces, as meshes.
namespace sinew::files {

/// Rows of points from the image's top to the bottom, `across` in a row.
struct WornImage {
    std::vector<Vec3<double>> points;  ///< metres, y upwards
    std::vector<Vec2<float>> on_image; ///< of each point: shares from the left and from the top
    std::size_t across = 2;

    /// Corners of its triangles, which are seen from the front, as numbers of points.
    std::vector<std::array<std::uint32_t, 3>> triangles() const;
};

/// Images on a piece of a flat scene, as the picture paints them: one, or one for each dot. How many points they have
/// depends on the piece alone, not on its pose. `piece`: metres, y downwards as in pixels.
std::vector<WornImage> worn_images(const ProjectedPiece& piece, const Style& style,
                                   const std::shared_ptr<const Image>& image);

/// An image from corner to corner: top left, top right, bottom right, bottom left.
WornImage worn_quad(std::span<const Vec3<double>> corners);

} // namespace sinew::files
