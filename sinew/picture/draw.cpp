#include "sinew/picture/draw.h"

#include "sinew/picture/backdrop.h"
#include "sinew/picture/brush.h"
#include "sinew/picture/cloth_painter.h"
#include "sinew/picture/collider_painter.h"
#include "sinew/picture/face.h"
#include "sinew/picture/order.h"
#include "sinew/picture/traces.h"
#include "sinew/picture/wardrobe.h"
#include "sinew/world/edit.h"

#include <algorithm>

/// Drawing of a session: the pieces of all figures, styled by the scene's looks, as a display list. Back to front:
/// background, floors, shadows, walls, traces, figures.
namespace sinew {
namespace {

/// Sizes at the nominal height of a picture, nominal pixels; proportional to the height.
constexpr float wall_thickness = 3, rim = 2.5F;
constexpr float thinnest = 4; // thinner lines have neither outline nor shadow
constexpr Vec2<float> shadow_offset{{7, 9}};
constexpr std::array<float, 3> penumbra = {9, 5, 1}; // added width, from the palest layer to the darkest

/// Context of drawing beyond the world.
struct DrawContext {
    const Images& images;
    std::optional<Point> pointer;
    std::vector<ParticleId> held; ///< by the pointer or a grab event
    const History& history;
};

template <class WorldT> class Drawer {
  public:
    Drawer(const Scene& scene, const WorldT& world, const View& view, const DrawContext& context, Picture& picture)
        : scene_(scene), world_(world), view_(view), context_(context), picture_(picture),
          theme_(theme_called(scene.view.theme)), light_(view, theme_.ink),
          unit_(float(picture.height / Picture::nominal_height)), brush_(picture, unit_), order_(world),
          cloth_(world, view, light_, unit_, picture) {}

    void draw() {
        picture_.clear();
        picture_.background = theme_.background;
        picture_.images.clear();
        for (const auto& [name, image] : context_.images) picture_.images.push_back(image);
        if (D == 3) draw_floors(scene_, view_, theme_, picture_);
        if (!scene_.view.plain) shadows();
        if (D == 2) draw_walls(scene_, view_, theme_, wall_thickness * unit_, picture_);
        draw_colliders(world_, view_, theme_, wall_thickness * unit_, picture_);
        draw_traces(scene_, context_.history, view_, picture_);
        for (std::size_t i = 0; i < world_.figures.size(); ++i) figure(world_.figures[i], i);
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
    PieceRenderer brush_;
    DrawOrder<WorldT> order_;
    ProjectedPiece traced_;
    ClothPainter<WorldT> cloth_;

    static Vec3<double> in_space(const Vec<D, typename WorldT::Real>& place) {
        Vec3<double> wide{};
        for (int i = 0; i < D; ++i) wide[i] = double(place[i]);
        return wide;
    }

    std::optional<Vec3<double>> place_of(ParticleId id) const {
        const auto row = row_of(world_, id);
        return row ? std::optional(in_space(world_.particles.position[*row])) : std::nullopt;
    }

    /// Projects a piece into traced_. False if a particle has been removed or lies behind the eye.
    bool trace(const Piece& piece, const Style& style) {
        return trace(piece, style, [this](const Vec3<double>& place) { return view_.see(place); });
    }
    template <class See> bool trace(const Piece& piece, const Style& style, See&& see) {
        traced_.mark = piece.mark;
        traced_.points.clear();
        float sum = 0;
        for (const auto id : piece.particles) {
            const auto place = place_of(id);
            const auto seen = place ? see(*place) : std::nullopt;
            if (!seen) return false;
            traced_.points.push_back(seen->pixel);
            sum += seen->scale;
        }
        traced_.scale = sum / float(std::max<std::size_t>(piece.particles.size(), 1));
        traced_.width = width_of(piece, style) * traced_.scale;
        traced_.end_width = piece.end_width > 0 ? float(piece.end_width / piece.width) * traced_.width : traced_.width;
        return !traced_.points.empty();
    }

    /// Mean depth of the particles; a face has the depth of the head.
    float depth_of(const Piece& piece) const {
        float sum = 0;
        if (piece.mark == Mark::face && !piece.particles.empty())
            return depth_of({.mark = Mark::dot, .particles = {piece.particles[piece.particles.size() - 1]}});
        for (const auto id : piece.particles)
            if (const auto place = place_of(id))
                if (const auto seen = view_.see(*place)) sum += seen->depth;
        return sum / float(std::max<std::size_t>(piece.particles.size(), 1));
    }

    /// Line width or diameter, in the scene's units of length.
    float width_of(const Piece& piece, const Style& style) const {
        constexpr double usual_line = 0.04, usual_dot = 0.07; // metres
        const double usual = (is_round(piece) ? usual_dot : usual_line) * scene_.measures().per_metre;
        return float(style.width.value_or(piece.width > 0 ? piece.width : usual));
    }

    static bool is_area(const Piece& piece) { return piece.mark == Mark::fill || is_cloth(piece.mark); }
    static bool is_round(const Piece& piece) {
        return piece.mark == Mark::dot || piece.mark == Mark::tip || piece.mark == Mark::face;
    }

    /// Index of the image painted in place of a piece; empty if none.
    std::optional<std::uint32_t> image_of(const Piece& piece, const Style& style) const {
        if (!style.image || !takes_image(piece)) return std::nullopt;
        for (std::size_t i = 0; i < context_.images.size(); ++i)
            if (context_.images[i].first == style.image->file) return std::uint32_t(i);
        return std::nullopt;
    }

    // --- figures -------------------------------------------------------------------------------------------------

    void figure(const Figure& figure, std::size_t index) {
        StyleResolver wardrobe(scene_, theme_, index, figure.name);
        const auto& order = order_.of(
            figure, [&](const Piece& piece) { return wardrobe.of(piece.part).hidden.value_or(piece.hidden); },
            [&](const Piece& piece) { return depth_of(piece); });
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
        if (scene_.view.plain || is_area(piece) || style.color.alpha < 1 || image_of(piece, style) ||
            !trace(piece, style))
            return;
        if (traced_.width >= thinnest)
            brush_.paint(traced_, style, rim * unit_, mix(style.color, theme_.ink, theme_.outline_shade));
    }

    void draw_piece(const Figure& figure, const Piece& piece, const Style& style) {
        if (is_cloth(piece.mark)) return cloth_.paint(figure, piece, style);
        if (!trace(piece, style)) return;
        if (piece.mark == Mark::face) return draw_face(piece, style.face.empty() ? "awake" : style.face, style.color);
        const Color tint = is_hovered(piece, style) ? *style.hover : Color{0, 0, 0, 0};
        if (const auto number = image_of(piece, style))
            return brush_.paint_image(traced_, *style.image, style.profile, *number, 0, tint);
        const Color& own = piece.mark == Mark::fill ? style.fill : style.color;
        const Color shown = mix(own, {tint.red, tint.green, tint.blue, own.alpha}, tint.alpha);
        brush_.paint(traced_, style, 0, shown);
        if (D == 3 && is_tube(piece) && shown.alpha == 1 && !scene_.view.plain) shade_tube(style, shown);
        if (!is_round(piece)) return;
        if (!scene_.view.plain) add_gloss(shown);
        if (!style.face.empty()) draw_face(piece, style.face, theme_.ink);
    }

    /// A face on the disc in traced_, or one on every dot of a piece with several.
    void draw_face(const Piece& piece, std::string_view expression, const Color& color) {
        std::vector<Vec3<double>> places;
        for (const auto id : piece.particles) {
            places.push_back(*place_of(id));
            const bool several = piece.mark == Mark::dot;
            if (!several && places.size() < piece.particles.size()) continue;
            const double radius = double(traced_.width / traced_.scale) / 2;
            paint_face(head_at(places, D == 2, view_, radius), expression, view_, color, picture_);
            if (several) places.clear();
        }
    }

    static bool is_tube(const Piece& piece) { return piece.mark == Mark::stroke || piece.mark == Mark::limb; }

    /// Shading of a thick line in space as a cylinder: dark below, bright towards the light.
    void shade_tube(const Style& style, const Color& color) {
        constexpr float least = 8;
        struct Tile {
            float width, shift; ///< fractions of the tube's width
            Color color;
        };
        const ProjectedPiece tube = traced_;
        if (minimum(tube.width, tube.end_width) < least * unit_) return;
        const Color pale{1, 1, 1, 1};
        for (const auto& band : {Tile{1, 0, mix(color, theme_.ink, 0.3F)}, Tile{0.78F, 0.09F, color},
                                 Tile{0.34F, 0.19F, mix(color, pale, 0.16F)}}) {
            traced_.width = tube.width * band.width;
            traced_.end_width = tube.end_width * band.width;
            for (std::size_t i = 0; i < tube.points.size(); ++i)
                traced_.points[i] = tube.points[i] - Vec2<float>{{0.6F, 0.8F}} * (band.shift * tube.end_width);
            brush_.paint(traced_, style, 0, band.color);
        }
        traced_ = tube;
    }

    /// Highlight on discs at least 18 nominal pixels wide.
    void add_gloss(const Color& color) {
        constexpr float least = 18, size = 0.3F;
        constexpr Vec2<float> place{{-0.19F, -0.21F}};
        const float width = traced_.width;
        if (width < least * unit_) return;
        const auto first = traced_.mark == Mark::tip ? traced_.points.end() - 1 : traced_.points.begin();
        for (auto point = first; point != traced_.points.end(); ++point) {
            const auto lit = *point + place * width;
            const Color pale{1, 1, 1, color.alpha};
            picture_.add(Shape::disc, std::span(&lit, 1), size * width, mix(color, pale, 0.22F));
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

    // --- shadows and walls ---------------------------------------------------------------------------------------

    /// All shadows of all figures layer by layer, the palest first, so that penumbras merge.
    void shadows() {
        if (D == 3 && scene_.world.bounds && scene_.world.bounds->planes.empty()) return;
        if (D == 3 && !scene_.world.bounds) return;
        for (std::size_t layer = 0; layer < penumbra.size(); ++layer)
            for (std::size_t i = 0; i < world_.figures.size(); ++i) {
                StyleResolver wardrobe(scene_, theme_, i, world_.figures[i].name);
                const float depth = float(layer + 1) / float(penumbra.size());
                for (const auto& piece : world_.figures[i].pieces) {
                    const auto& style = wardrobe.of(piece.part);
                    if (!style.hidden.value_or(piece.hidden))
                        cast_shadow(world_.figures[i], piece, style, penumbra[layer] * unit_, depth);
                }
            }
    }

    void cast_shadow(const Figure& figure, const Piece& piece, const Style& style, float wider, float depth) {
        const auto image = image_of(piece, style);
        const Color& own = is_area(piece) ? style.fill : style.color;
        if ((own.alpha < 1 && !image) || piece.mark == Mark::face) return;
        const Color shade =
            D == 3 ? mix(theme_.ground, theme_.floor_shadow, depth) : mix(theme_.background, theme_.shadow, depth);
        if (piece.mark == Mark::fragment) return cast_shadow(figure, piece, style, wider, shade);
        if (!trace_shadow(piece, style)) return;
        if (!is_area(piece) && traced_.width < thinnest) return;
        if (image && is_rigid(traced_)) // only then does the image's outline differ from the piece's
            brush_.paint_image(traced_, *style.image, style.profile, *image, wider, shade);
        else
            brush_.paint(traced_, style, wider, shade);
    }

    /// Shadow of a fragment, tile by tile.
    void cast_shadow(const Figure& figure, const Piece& piece, const Style& style, float wider, const Color& shade) {
        const Sun sun(*this);
        cloth_.each_tile(figure, piece, [&](std::span<const Vec3<double>> places) {
            traced_.mark = piece.mark;
            traced_.width = traced_.end_width = 0;
            traced_.points.clear();
            for (const auto& place : places)
                if (const auto seen = sun.see(place)) traced_.points.push_back(seen->pixel);
            if (traced_.points.size() == places.size()) brush_.paint(traced_, style, wider, shade);
        });
    }

    /// Projection of shadows: offset on screen in 2D, onto the first plane along the light in 3D.
    struct Sun {
        explicit Sun(const Drawer& drawer) : view(drawer.view_), aside(shadow_offset * drawer.unit_) {
            if (D == 2) return;
            const auto& plane = drawer.scene_.world.bounds->planes.front();
            normal = direction(plane.normal.template as<3, double>());
            through = plane.through.template as<3, double>();
            way = direction(normal + drawer.light_.towards_light * 0.5); // a steep light
        }

        std::optional<View::Seen> see(const Vec3<double>& place) const {
            if (D == 3) {
                const double slope = dot(normal, way);
                if (slope <= 0) return std::nullopt;
                return view.see(place - way * (dot(place - through, normal) / slope));
            }
            auto seen = view.see(place);
            if (seen) seen->pixel += aside;
            return seen;
        }

        const View& view;
        Vec2<float> aside{};
        Vec3<double> normal{}, through{}, way{};
    };

    /// Projects the shadow of a piece into traced_.
    bool trace_shadow(const Piece& piece, const Style& style) {
        const Sun sun(*this);
        return trace(piece, style, [&](const Vec3<double>& place) { return sun.see(place); });
    }
};

} // namespace

void draw(const Session& session, const View& view, Picture& picture, OverlaySet overlay) {
    const DrawContext context{session.images(), session.pointer(), session.held_particles(), session.history()};
    std::visit([&](const auto& world) { Drawer(session.scene(), world, view, context, picture).draw(); },
               session.world());
    draw_overlays(overlay, session.scene(), session.world(), view, picture);
}

void draw(const Session& session, Picture& picture, OverlaySet overlay) {
    draw(session, session.view(picture.width, picture.height), picture, overlay);
}

} // namespace sinew
