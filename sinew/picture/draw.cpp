#include "sinew/picture/draw.h"

#include "sinew/picture/backdrop.h"
#include "sinew/picture/cloth_painter.h"
#include "sinew/picture/collider_painter.h"
#include "sinew/picture/face.h"
#include "sinew/picture/order.h"
#include "sinew/picture/piece_projector.h"
#include "sinew/picture/piece_renderer.h"
#include "sinew/picture/shadow_painter.h"
#include "sinew/picture/style_resolver.h"
#include "sinew/picture/traces.h"
#include "sinew/world/edit.h"

#include <algorithm>

/// Drawing of a session: the pieces of all figures, styled by the scene's looks, as a display list. Back to front:
/// background, floors, shadows, walls, traces, figures.
namespace sinew {
namespace {

/// Sizes at the nominal height of a picture, nominal pixels; proportional to the height.
constexpr float wall_thickness = 3, rim = 2.5F;

/// Context of drawing beyond the world.
struct DrawContext {
    const Images& images;
    std::optional<Point> pointer;
    std::vector<ParticleId> held; ///< by the pointer or a grab event
    const History& history;
    std::span<const std::string> figures; ///< names of those that are drawn alone; empty: everything
};

bool is_tube(const Piece& piece) {
    return piece.mark == Mark::stroke || piece.mark == Mark::limb;
}

/// Shading of a line at least 8 nominal pixels thick, in space, as a cylinder: dark below, bright towards the light.
void shade_tube(const ProjectedPiece& tube, const Style& style, const Color& color, const Color& ink, float unit,
                PieceRenderer& brush) {
    constexpr float min_width = 8;
    struct Tile {
        float width, shift; ///< fractions of the tube's width
        Color color;
    };
    if (min(tube.width, tube.end_width) < min_width * unit) return;
    const Color pale{1, 1, 1, 1};
    auto strip = tube;
    for (const auto& band :
         {Tile{1, 0, mix(color, ink, 0.3F)}, Tile{0.78F, 0.09F, color}, Tile{0.34F, 0.19F, mix(color, pale, 0.16F)}}) {
        strip.width = tube.width * band.width;
        strip.end_width = tube.end_width * band.width;
        for (std::size_t i = 0; i < tube.points.size(); ++i)
            strip.points[i] = tube.points[i] - Vec2<float>{{0.6F, 0.8F}} * (band.shift * tube.end_width);
        brush.paint(strip, style, 0, band.color);
    }
}

/// Highlight on discs at least 18 nominal pixels wide.
void add_gloss(const ProjectedPiece& disc, const Color& color, float unit, Picture& picture) {
    constexpr float min = 18, size = 0.3F;
    constexpr Vec2<float> position{{-0.19F, -0.21F}};
    const float width = disc.width;
    if (width < min * unit) return;
    const auto first = disc.mark == Mark::tip ? disc.points.end() - 1 : disc.points.begin();
    for (auto point = first; point != disc.points.end(); ++point) {
        const auto lit = *point + position * width;
        const Color pale{1, 1, 1, color.alpha};
        picture.add(Shape::disc, std::span(&lit, 1), size * width, mix(color, pale, 0.22F));
    }
}

template <class WorldT> class Drawer {
  public:
    Drawer(const Scene& scene, const WorldT& world, const View& view, const DrawContext& context, Picture& picture)
        : scene_(scene), world_(world), view_(view), context_(context), picture_(picture),
          theme_(theme_called(scene.view.theme)), light_(view, theme_.ink),
          unit_(float(picture.height / Picture::nominal_height)), projector_(scene, world, view),
          brush_(picture, unit_), order_(world), cloth_(world, view, light_, unit_, picture) {}

    void draw() {
        picture_.clear();
        picture_.background = theme_.background;
        picture_.images.clear();
        for (const auto& [name, image] : context_.images) picture_.images.push_back(image);
        const bool has_all = context_.figures.empty();
        if (D == 3 && has_all) draw_floors(scene_, view_, theme_, picture_);
        if (!scene_.view.plain && (D == 2 || has_all)) {
            ShadowPainter shadows(scene_, world_, view_, context_.images, light_, unit_, cloth_, picture_);
            shadows.paint([&](const Figure& figure) { return is_shown(figure); });
        }
        if (has_all) draw_surroundings();
        for (std::size_t i = 0; i < world_.figures.size(); ++i)
            if (is_shown(world_.figures[i])) figure(world_.figures[i], i);
    }

  private:
    static constexpr int D = WorldT::dimension;
    const Scene& scene_;
    const WorldT& world_;
    const View& view_;
    const DrawContext& context_;
    Picture& picture_;
    const Theme& theme_;
    const Light light_;
    const float unit_; // pixels per nominal pixel
    PieceProjector<WorldT> projector_;
    PieceRenderer brush_;
    DrawOrder<WorldT> order_;
    ProjectedPiece traced_;
    ClothPainter<WorldT> cloth_;

    bool is_shown(const Figure& figure) const {
        return context_.figures.empty() || std::ranges::find(context_.figures, figure.name) != context_.figures.end();
    }

    void draw_surroundings() {
        if (D == 2) draw_walls(scene_, view_, theme_, wall_thickness * unit_, picture_);
        draw_colliders(scene_, world_, view_, theme_, wall_thickness * unit_, picture_);
        draw_traces(scene_, context_.history, view_, picture_);
    }

    /// Projects a piece into traced_. False if a particle has been removed or lies behind the eye.
    bool trace(const Piece& piece, const Style& style) { return projector_.project(piece, style, traced_); }

    void figure(const Figure& figure, std::size_t index) {
        StyleResolver wardrobe(scene_, theme_, index, figure.name);
        const auto& order = order_.of(
            figure, [&](const Piece& piece) { return wardrobe.of(piece.part).hidden.value_or(piece.hidden); },
            [&](const Piece& piece) { return projector_.depth_of(piece); });
        cloth_.find_normals(figure, order);
        for (std::size_t i = 0; i < order.size();) {
            std::size_t end = i + 1;
            while (end < order.size() && order[end].group == order[i].group) ++end;
            for (std::size_t k = i; k < end; ++k) draw_outline(*order[k].piece, wardrobe.of(order[k].piece->part));
            for (std::size_t k = i; k < end; ++k)
                draw_piece(figure, *order[k].piece, wardrobe.of(order[k].piece->part));
            i = end;
        }
    }

    void draw_outline(const Piece& piece, const Style& style) {
        if (scene_.view.plain || is_area(piece) || style.color.alpha < 1 || image_of(piece, style, context_.images) ||
            !trace(piece, style))
            return;
        if (traced_.width >= thinnest_line)
            brush_.paint(traced_, style, rim * unit_, mix(style.color, theme_.ink, theme_.outline_shade));
    }

    void draw_piece(const Figure& figure, const Piece& piece, const Style& style) {
        if (is_cloth(piece.mark)) return cloth_.paint(figure, piece, style);
        if (!trace(piece, style)) return;
        if (piece.mark == Mark::face) return draw_face(piece, style.face.empty() ? "awake" : style.face, style.color);
        const Color tint = is_hovered(piece, style) ? *style.hover : Color{0, 0, 0, 0};
        if (const auto number = image_of(piece, style, context_.images))
            return brush_.paint_image(traced_, *style.image, style.profile, *number, 0, tint);
        const Color& own = piece.mark == Mark::fill ? style.fill : style.color;
        const Color shown = mix(own, {tint.red, tint.green, tint.blue, own.alpha}, tint.alpha);
        brush_.paint(traced_, style, 0, shown);
        if (D == 3 && is_tube(piece) && shown.alpha == 1 && !scene_.view.plain)
            shade_tube(traced_, style, shown, theme_.ink, unit_, brush_);
        if (!is_round(piece)) return;
        if (!scene_.view.plain) add_gloss(traced_, shown, unit_, picture_);
        if (piece.mark == Mark::dot) draw_turns(piece, mix(shown, theme_.ink, 0.45F));
        if (!style.face.empty()) draw_face(piece, style.face, theme_.ink);
    }

    /// Marks on particles that have rolled, which turn with them: one beside the centre of a disc, six around a ball.
    void draw_turns(const Piece& piece, const Color& color) {
        const auto& p = world_.particles;
        using Rotation = collide::Rotation<D, typename WorldT::Real>;
        for (const auto id : piece.particles) {
            const auto row = row_of(world_, id);
            if (!row || (p.turn[*row] == Rotation{} && p.rolls[*row] != Rolls::always)) continue;
            for (int axis = 0; axis < (D == 2 ? 1 : D); ++axis)
                for (const double side : {1.0, -1.0})
                    if (D == 3 || side > 0) draw_turn(*row, p.turn[*row].number, axis, side, color);
        }
    }
    template <class Number> void draw_turn(Row row, const Number& number, int axis, double side, const Color& color) {
        constexpr double away = D == 2 ? 0.55 : 1, size = 0.36; // shares of the radius
        const double radius = double(traced_.width / traced_.scale) / 2;
        const auto center = cast<double>(world_.particles.position[row]);
        const collide::Rotation<D, double> rotation{cast<double>(number)};
        const auto at = center + rotation * (Vec<D, double>::axis(axis) * (side * away * radius));
        const auto seen = view_.see(wide(at)), middle = view_.see(wide(center));
        if (!seen || !middle || (D == 3 && seen->depth >= middle->depth)) return;
        picture_.add(Shape::disc, std::span(&seen->pixel, 1), float(size * radius) * seen->scale, color);
    }
    static Vec3<double> wide(const Vec<D, double>& position) {
        Vec3<double> all{};
        for (int i = 0; i < D; ++i) all[i] = position[i];
        return all;
    }

    /// A face on the disc in traced_, or one on every dot of a piece with several.
    void draw_face(const Piece& piece, std::string_view expression, const Color& color) {
        std::vector<Vec3<double>> positions;
        for (const auto id : piece.particles) {
            positions.push_back(*projector_.position_of(id));
            const bool several = piece.mark == Mark::dot;
            if (!several && positions.size() < piece.particles.size()) continue;
            const double radius = double(traced_.width / traced_.scale) / 2;
            paint_face(head_at(positions, D == 2, view_, radius), expression, view_, color, picture_);
            if (several) positions.clear();
        }
    }

    /// True if the pointer is over the piece in traced_ or holds one of the particles.
    bool is_hovered(const Piece& piece, const Style& style) {
        if (!style.hover) return false;
        const auto is_held = [&](ParticleId id) {
            return std::find(context_.held.begin(), context_.held.end(), id) != context_.held.end();
        };
        if (std::any_of(piece.particles.begin(), piece.particles.end(), is_held)) return true;
        if (!context_.pointer) return false;
        const auto seen = view_.see(context_.pointer->template as<3, double>());
        return seen && brush_.covers(traced_, seen->pixel);
    }
};

} // namespace

void draw(const Session& session, const View& view, Picture& picture, OverlaySet overlay,
          std::span<const std::string> figures) {
    const DrawContext context{session.images(), session.pointer(), session.held_particles(), session.history(),
                              figures};
    std::visit([&](const auto& world) { Drawer(session.scene(), world, view, context, picture).draw(); },
               session.world());
    draw_overlays(overlay, session.scene(), session.world(), view, picture);
}

void draw(const Session& session, Picture& picture, OverlaySet overlay) {
    draw(session, session.view(picture.width, picture.height), picture, overlay);
}

} // namespace sinew
