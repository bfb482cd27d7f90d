#pragma once

#include "sinew/scene/scene.h"
#include "sinew/session/theme.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sinew {

/// How a part is drawn.
struct Style {
    Color color, fill;
    std::optional<Color> hover;
    std::optional<double> width;
    std::optional<bool> hidden;
    std::span<const double> profile;
    std::string_view face;            ///< one of `expressions`, or empty
    const ImageLook* image = nullptr; ///< of the scene
};

/// The looks of one figure's parts, the general before the particular: theme, part anywhere, figure, all of it, its
/// part.
class Wardrobe {
  public:
    /// All three are kept by reference.
    Wardrobe(const Scene& scene, const Theme& theme, std::size_t figure, const std::string& name);

    /// Good until the next call.
    const Style& of(const std::string& part);

  private:
    Style plain(const std::string& part) const;

    const Scene& scene_;
    const Theme& theme_;
    std::size_t figure_;
    const std::string& name_;
    const FigureSection* section_ = nullptr; ///< of the scene; none of a figure that came in another way
    Style last_;
    std::string last_part_;
    bool dressed_ = false;
};

} // namespace sinew
