#pragma once

#include "sinew/picture/picture.h"
#include "sinew/picture/theme.h"

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Ends of the scale of colours in overlays.
inline constexpr Color stretched{0.85F, 0.15F, 0.12F, 1}, squeezed{0.12F, 0.35F, 0.85F, 1};

/// Colour of a share in [-1, 1]: -1 compressed, 0 neutral, 1 stretched.
Color color_of_share(double share);

/// Paints legends, names and arrows over a picture. All sizes are nominal pixels, proportional to the picture's height.
class Annotator {
  public:
    static constexpr float line = 3, letters = 11, longest_arrow = 70;

    /// Keeps references to both arguments.
    Annotator(Picture& picture, const Theme& theme);

    /// Colour bar with its range, in the lower left corner; further legends stack above.
    void add_bar(std::string_view what, double scale, std::string_view unit);
    /// Arrow of full scale and the label beside it, stacked likewise. `scale`: newtons, 0 if there are no arrows.
    void add_arrow(std::string_view what, double scale);
    /// Words alone, stacked likewise.
    void add_words(std::string words);

    /// Name at a place, within the picture; left out if it overlaps an earlier one.
    void write(const std::string& text, Vec2<float> middle, float height);
    void draw_arrow(Vec2<float> from, Vec2<float> to, const Color& color);

  private:
    struct Box {
        Vec2<float> middle, size;
    };

    float next_row();
    void label(std::string text, float x, float y);

    Picture& picture_;
    const Theme& theme_;
    const float unit_; ///< pixels per nominal pixel
    int rows_ = 0;
    std::vector<Box> taken_; ///< by names
};

} // namespace sinew
