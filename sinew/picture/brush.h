#pragma once

#include "sinew/picture/picture.h"
#include "sinew/picture/spine.h"
#include "sinew/picture/wardrobe.h"
#include "sinew/solver/figure.h"

namespace sinew {

/// A piece in pixels.
struct Traced {
    Mark mark = Mark::stroke;
    Pixels points;       ///< where its particles are seen
    float scale = 1;     ///< pixels a unit of length has there
    float width = 1;     ///< pixels
    float end_width = 1; ///< of what tapers
};

/// Whether an image is only put there, not bent or stretched to a shape.
inline bool is_rigid(const Traced& piece) {
    return piece.mark == Mark::dot || piece.mark == Mark::tip || piece.mark == Mark::ring ||
           (piece.mark == Mark::stroke && piece.points.size() == 2);
}

/// Turns traced pieces into shapes of a picture.
class Brush {
  public:
    /// The picture is kept by reference; `unit` is how many pixels a nominal pixel has.
    Brush(Picture& picture, float unit) : picture_(picture), unit_(unit) {}

    /// The piece in one colour, so many pixels thicker than it is.
    void paint(const Traced& piece, const Style& style, float thicker, const Color& color);

    /// An image in place of the piece, so many pixels larger than it is, and a colour over it.
    void paint_image(const Traced& piece, const ImageLook& look, std::span<const double> profile, std::uint32_t number,
                     float larger, const Color& over);

    /// Whether a pixel is on the piece, or as good as.
    bool covers(const Traced& piece, Vec2<float> pixel);

  private:
    void paint_band(const Traced& piece, std::span<const double> profile, float thicker, const Color& color);
    void paint_tapered(const Traced& piece, float thicker, const Color& color);
    void paint_sprite(const Traced& piece, const ImageLook& look, std::uint32_t number, Vec2<float> middle,
                      Vec2<float> along, Vec2<float> usual_size, float larger, const Color& over);
    void paint_strip(const Traced& piece, const ImageLook& look, std::span<const double> profile, std::uint32_t number,
                     float larger, const Color& over);
    void paint_quad(std::span<const Vec2<float>> corners, std::uint32_t number, const Color& over);
    float aspect(std::uint32_t number) const;

    Picture& picture_;
    float unit_;
    Pixels shape_;
    Bends bends_;
    Spine spine_;
};

} // namespace sinew
