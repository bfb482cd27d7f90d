#pragma once

#include "sinew/picture/picture.h"
#include "sinew/picture/spine.h"
#include "sinew/picture/style_resolver.h"
#include "sinew/world/figure.h"

namespace sinew {

/// A piece projected to pixels.
struct ProjectedPiece {
    Mark mark = Mark::stroke;
    Pixels points;       ///< projected positions of the particles
    float scale = 1;     ///< pixels per unit of length
    float width = 1;     ///< pixels
    float end_width = 1; ///< pixels, of tapered strokes and limbs
};

/// True if an image on this piece is only moved, turned and scaled, never bent along a curve.
inline bool is_rigid(const ProjectedPiece& piece) {
    return piece.mark == Mark::dot || piece.mark == Mark::tip || piece.mark == Mark::ring ||
           (piece.mark == Mark::stroke && piece.points.size() == 2);
}

/// Converts projected pieces to shapes of a picture.
class PieceRenderer {
  public:
    /// Keeps a reference to the picture. `unit`: pixels per nominal pixel.
    PieceRenderer(Picture& picture, float unit) : picture_(picture), unit_(unit) {}

    /// Paints the piece in one colour, widened by `thicker` pixels.
    void paint(const ProjectedPiece& piece, const Style& style, float thicker, const Color& color);

    /// Paints an image in place of the piece, enlarged by `larger` pixels, and blends `over` onto the image's opaque
    /// pixels.
    void paint_image(const ProjectedPiece& piece, const ImageLook& look, std::span<const double> profile,
                     std::uint32_t number, float larger, const Color& over);

    /// True if the pixel lies on the piece, or within 4 nominal pixels of a piece thinner than 8.
    bool covers(const ProjectedPiece& piece, Vec2<float> pixel);

  private:
    void paint_band(const ProjectedPiece& piece, std::span<const double> profile, float thicker, const Color& color);
    void paint_tapered(const ProjectedPiece& piece, float thicker, const Color& color);
    void paint_sprite(const ProjectedPiece& piece, const ImageLook& look, std::uint32_t number, Vec2<float> middle,
                      Vec2<float> along, Vec2<float> usual_size, float larger, const Color& over);
    void paint_strip(const ProjectedPiece& piece, const ImageLook& look, std::span<const double> profile,
                     std::uint32_t number, float larger, const Color& over);
    void paint_quad(std::span<const Vec2<float>> corners, std::uint32_t number, const Color& over);
    float aspect(std::uint32_t number) const;

    Picture& picture_;
    float unit_;
    Pixels shape_;
    Bends bends_;
    Spine spine_;
};

} // namespace sinew
