#pragma once

#include "sinew/picture/theme.h"
#include "sinew/scene/image.h"
#include "sinew/scene/scene.h"
#include "sinew/world/figure.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sinew {

/// Resolved look of a part.
struct Style {
    Color color, fill;
    std::optional<Color> hover;
    std::optional<double> width;
    std::optional<bool> hidden;
    std::span<const double> profile;
    std::string_view face;            ///< an element of `expressions`, or empty
    const ImageLook* image = nullptr; ///< owned by the scene
};

/// Resolves the looks of one figure's parts. Later ones override: the theme; the scene's looks of the part, then of the
/// figure; the figure's own look "all", then of the part; the scene's look "figure/part". Copies that an event adds
/// have the looks of the original.
class StyleResolver {
  public:
    /// Keeps references to scene and theme.
    StyleResolver(const Scene& scene, const Theme& theme, std::size_t figure, const std::string& name);

    /// Valid until the next call.
    const Style& of(const std::string& part);

  private:
    Style plain(const std::string& part) const;

    const Scene& scene_;
    const Theme& theme_;
    std::size_t figure_;
    const FigureSection* section_ = nullptr; ///< null if the figure is not of the scene
    std::string name_;                       ///< of the figure, or of its original
    Style last_;
    std::string last_part_;
    bool dressed_ = false;
};

/// Index of the image painted in place of a piece; empty if none.
std::optional<std::uint32_t> image_of(const Piece& piece, const Style& style, const Images& images);

} // namespace sinew
