#pragma once

#include "sinew/picture/cloth_painter.h"
#include "sinew/picture/piece_projector.h"
#include "sinew/picture/piece_renderer.h"
#include "sinew/picture/style_resolver.h"
#include "sinew/picture/surface.h"
#include "sinew/picture/theme.h"
#include "sinew/scene/image.h"
#include "sinew/scene/scene.h"
#include "sinew/session/view.h"

#include <array>
#include <optional>
#include <span>

namespace sinew {

/// Thinner lines have neither outline nor shadow, pixels.
inline constexpr float thinnest_line = 4;

/// Projection of shadows: offset on screen in 2D, onto the first plane along the light in 3D.
template <int D> class ShadowProjection {
  public:
    /// Keeps a reference to the view. 3D: the scene has a plane. `aside`: pixels.
    ShadowProjection(const Scene& scene, const View& view, const Light& light, Vec2<float> aside)
        : view_(view), aside_(aside) {
        if (D == 2) return;
        const auto& plane = scene.world.bounds->planes.front();
        normal_ = direction(plane.normal.template as<3, double>());
        through_ = plane.through.template as<3, double>();
        way_ = direction(normal_ + light.towards_light * 0.5); // a steep light
    }

    std::optional<View::Seen> see(const Vec3<double>& position) const {
        if (D == 3) {
            const double slope = dot(normal_, way_);
            if (slope <= 0) return std::nullopt;
            return view_.see(position - way_ * (dot(position - through_, normal_) / slope));
        }
        auto seen = view_.see(position);
        if (seen) seen->pixel += aside_;
        return seen;
    }

  private:
    const View& view_;
    Vec2<float> aside_;
    Vec3<double> normal_{}, through_{}, way_{};
};

/// Paints the shadows of all figures, layer by layer, the palest first, so that penumbras merge.
template <class WorldT> class ShadowPainter {
  public:
    /// Keeps references to all arguments but `unit`, the pixels per nominal pixel.
    ShadowPainter(const Scene& scene, const WorldT& world, const View& view, const Images& images, const Light& light,
                  float unit, const ClothPainter<WorldT>& cloth, Picture& picture)
        : scene_(scene), world_(world), view_(view), images_(images), theme_(theme_called(scene.view.theme)),
          light_(light), unit_(unit), cloth_(cloth), projector_(scene, world, view), brush_(picture, unit) {}

    /// Casts the shadows of the figures for which `is_shown(figure)`.
    template <class Shown> void paint(Shown&& is_shown) {
        if (D == 3 && (!scene_.world.bounds || scene_.world.bounds->planes.empty())) return;
        for (std::size_t layer = 0; layer < penumbra.size(); ++layer)
            for (std::size_t i = 0; i < world_.figures.size(); ++i) {
                if (!is_shown(world_.figures[i])) continue;
                StyleResolver wardrobe(scene_, theme_, i, world_.figures[i].name);
                const float depth = float(layer + 1) / float(penumbra.size());
                for (const auto& piece : world_.figures[i].pieces) {
                    const auto& style = wardrobe.of(piece.part);
                    if (!style.hidden.value_or(piece.hidden))
                        cast(world_.figures[i], piece, style, penumbra[layer] * unit_, depth);
                }
            }
    }

  private:
    static constexpr int D = WorldT::dimension;
    /// Nominal pixels: place of a shadow in 2D, and added widths from the palest layer to the darkest.
    static constexpr Vec2<float> offset{{7, 9}};
    static constexpr std::array<float, 3> penumbra = {9, 5, 1};

    const Scene& scene_;
    const WorldT& world_;
    const View& view_;
    const Images& images_;
    const Theme& theme_;
    const Light& light_;
    const float unit_;
    const ClothPainter<WorldT>& cloth_;
    PieceProjector<WorldT> projector_;
    PieceRenderer brush_;
    ProjectedPiece shadow_;

    ShadowProjection<D> projection() const { return {scene_, view_, light_, offset * unit_}; }

    void cast(const Figure& figure, const Piece& piece, const Style& style, float wider, float depth) {
        const auto image = image_of(piece, style, images_);
        const Color& own = is_area(piece) ? style.fill : style.color;
        if ((own.alpha < 1 && !image) || piece.mark == Mark::face) return;
        const Color shade =
            D == 3 ? mix(theme_.ground, theme_.floor_shadow, depth) : mix(theme_.background, theme_.shadow, depth);
        if (piece.mark == Mark::fragment) return cast_tiles(figure, piece, style, wider, shade);
        const auto project = [sun = projection()](const Vec3<double>& position) { return sun.see(position); };
        if (!projector_.project(piece, style, shadow_, project)) return;
        if (!is_area(piece) && shadow_.width < thinnest_line) return;
        if (image && is_rigid(shadow_)) // only then does the image's outline differ from the piece's
            brush_.paint_image(shadow_, *style.image, style.profile, *image, wider, shade);
        else
            brush_.paint(shadow_, style, wider, shade);
    }

    /// Shadow of a fragment, tile by tile.
    void cast_tiles(const Figure& figure, const Piece& piece, const Style& style, float wider, const Color& shade) {
        const auto sun = projection();
        cloth_.each_tile(figure, piece, [&](std::span<const Vec3<double>> positions) {
            shadow_.mark = piece.mark;
            shadow_.width = shadow_.end_width = 0;
            shadow_.points.clear();
            for (const auto& position : positions)
                if (const auto seen = sun.see(position)) shadow_.points.push_back(seen->pixel);
            if (shadow_.points.size() == positions.size()) brush_.paint(shadow_, style, wider, shade);
        });
    }
};

} // namespace sinew
