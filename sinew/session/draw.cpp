#include "sinew/session/session.h"
#include "sinew/session/theme.h"
#include "sinew/session/view.h"
#include "sinew/solver/edit.h"

#include <algorithm>

/// What a session looks like: the pieces of its figures, dressed by the scene's looks, as a display list.
namespace sinew {
namespace {

struct Style {
    Color color, fill;
    std::optional<double> width;
    std::optional<bool> hidden;
};

void dress(Style& style, const Look& look) {
    if (const auto color = parse_color(look.color)) style.color = *color;
    if (const auto fill = parse_color(look.fill)) style.fill = *fill;
    if (look.width) style.width = look.width;
    if (look.hidden) style.hidden = look.hidden;
}

/// The looks of one figure's parts, the general before the particular: part anywhere, figure, all of it, its part.
class Wardrobe {
  public:
    Wardrobe(const Scene& scene, const Theme& theme, std::size_t index, const std::string& name)
        : scene_(scene), section_(index < scene.figures.size() ? &scene.figures[index] : nullptr), name_(name) {
        plain_.color = theme.color_of(index);
        plain_.fill = plain_.color;
        plain_.fill.alpha = 0.25F;
    }

    const Style& of(const std::string& part) {
        if (part == last_part_ && dressed_) return last_;
        last_ = plain_;
        for (const auto& [key, look] : scene_.looks)
            if (key == part) dress(last_, look);
        for (const auto& [key, look] : scene_.looks)
            if (key == name_) dress(last_, look);
        if (section_) {
            for (const auto& [key, look] : section_->looks)
                if (key == "all") dress(last_, look);
            for (const auto& [key, look] : section_->looks)
                if (key == part) dress(last_, look);
        }
        for (const auto& [key, look] : scene_.looks)
            if (key.size() == name_.size() + 1 + part.size() && key.starts_with(name_) && key.ends_with(part) &&
                key[name_.size()] == '/')
                dress(last_, look);
        last_part_ = part;
        dressed_ = true;
        return last_;
    }

  private:
    const Scene& scene_;
    const FigureSection* section_;
    const std::string& name_;
    Style plain_, last_;
    std::string last_part_;
    bool dressed_ = false;
};

template <class WorldT> class Drawer {
  public:
    Drawer(const Scene& scene, const WorldT& world, const View& view, Picture& picture)
        : scene_(scene), world_(world), view_(view), picture_(picture), theme_(theme_called(scene.view.theme)) {}

    void draw() {
        picture_.clear();
        picture_.background = theme_.background;
        walls();
        for (std::size_t i = 0; i < world_.figures.size(); ++i) figure(world_.figures[i], i);
    }

  private:
    static constexpr int D = WorldT::dimension;
    const Scene& scene_;
    const WorldT& world_;
    const View& view_;
    Picture& picture_;
    const Theme& theme_;
    std::vector<Vec2<float>> outline_;
    float scale_ = 1; // of what was traced last
    struct Deep {
        float depth;
        const Piece* piece;
    };
    std::vector<Deep> order_;

    static Vec3<double> in_space(const Vec<D, typename WorldT::Real>& place) {
        Vec3<double> wide{};
        for (int i = 0; i < D; ++i) wide[i] = double(place[i]);
        return wide;
    }

    std::optional<Vec3<double>> place_of(ParticleId id) const {
        const auto row = row_of(world_, id);
        return row ? std::optional(in_space(world_.particles.position[*row])) : std::nullopt;
    }

    /// The pixels of a piece into outline_; false if part of it is gone or behind the eye.
    bool trace(const Piece& piece) {
        outline_.clear();
        float sum = 0;
        for (const auto id : piece.particles) {
            const auto place = place_of(id);
            const auto seen = place ? view_.see(*place) : std::nullopt;
            if (!seen) return false;
            outline_.push_back(seen->pixel);
            sum += seen->scale;
        }
        scale_ = sum / float(std::max<std::size_t>(piece.particles.size(), 1));
        return !outline_.empty();
    }

    float depth_of(const Piece& piece) const {
        float sum = 0;
        for (const auto id : piece.particles)
            if (const auto place = place_of(id))
                if (const auto seen = view_.see(*place)) sum += seen->depth;
        return sum / float(std::max<std::size_t>(piece.particles.size(), 1));
    }

    void figure(const Figure& figure, std::size_t index) {
        Wardrobe wardrobe(scene_, theme_, index, figure.name);
        const auto visible = [&](const Piece& piece) { return !wardrobe.of(piece.part).hidden.value_or(piece.hidden); };
        order_.clear();
        for (const auto& piece : figure.pieces)
            if (visible(piece)) order_.push_back({D == 3 ? depth_of(piece) : 0, &piece});
        if (D == 3)
            std::stable_sort(order_.begin(), order_.end(),
                             [](const Deep& a, const Deep& b) { return a.depth > b.depth; });
        if (D == 2) // one outline around all of it, not one around each limb
            for (const auto& [depth, piece] : order_) draw_outline(*piece, wardrobe.of(piece->part));
        for (const auto& [depth, piece] : order_) draw_piece(*piece, wardrobe.of(piece->part));
    }

    float width_of(const Piece& piece, const Style& style) const {
        constexpr double usual_line = 0.04, usual_dot = 0.07; // metres
        const double usual = (piece.mark == Mark::dot ? usual_dot : usual_line) * scene_.measures().per_metre;
        const double width = style.width.value_or(piece.width > 0 ? piece.width : usual);
        return float(width) * scale_;
    }

    void draw_outline(const Piece& piece, const Style& style) {
        constexpr float thinnest = 4, rim = 2.5F; // pixels; thinner lines are clearer without
        if (piece.mark == Mark::fill || piece.mark == Mark::surface || !trace(piece)) return;
        const float width = width_of(piece, style);
        if (width < thinnest || style.color.alpha < 1) return;
        stroke(piece, width + rim, mix(style.color, theme_.ink, theme_.outline_shade));
    }

    void draw_piece(const Piece& piece, const Style& style) {
        if (!trace(piece)) return;
        switch (piece.mark) {
        case Mark::fill:
            picture_.add(Shape::polygon, outline_, 0, style.fill);
            break;
        case Mark::surface:
            picture_.add(Shape::polygon, outline_, 0, shade(piece, style.color));
            break;
        default:
            stroke(piece, width_of(piece, style), style.color);
        }
    }

    void stroke(const Piece& piece, float width, Color color) {
        if (piece.mark == Mark::dot) {
            for (const auto& point : outline_) picture_.add(Shape::disc, std::span(&point, 1), width, color);
        } else {
            picture_.add(piece.mark == Mark::loop ? Shape::loop : Shape::polyline, outline_, width, color);
        }
    }

    /// Lit from the upper left behind the reader, the same from both sides.
    Color shade(const Piece& piece, const Color& color) const {
        if (piece.particles.size() < 3) return color;
        std::array<Vec3<double>, 3> corner{};
        for (std::size_t i = 0; i < 3; ++i) corner[i] = place_of(piece.particles[i]).value_or(Vec3<double>{});
        const auto normal = direction(cross(corner[1] - corner[0], corner[2] - corner[0]));
        const auto light = direction(view_.towards_eye() + Vec3<double>{{-0.6, 0.8, 0}});
        const float lit = float(absolute(dot(normal, light)));
        const Color dark = mix(color, theme_.ink, 0.55F);
        return mix(dark, mix(color, {1, 1, 1, color.alpha}, 0.12F), lit);
    }

    /// Walls as seen from inside: a line along each.
    void walls() {
        if (D != 2 || !scene_.world.bounds) return;
        constexpr float thickness = 3;
        if (const auto& box = scene_.world.bounds->box) {
            outline_.clear();
            const auto& [a, b] = *box;
            for (const auto& corner : {Vec3<double>{{a[0], a[1], 0}}, Vec3<double>{{b[0], a[1], 0}},
                                       Vec3<double>{{b[0], b[1], 0}}, Vec3<double>{{a[0], b[1], 0}}})
                if (const auto seen = view_.see(corner)) outline_.push_back(seen->pixel);
            picture_.add(Shape::loop, outline_, thickness, theme_.wall);
        }
        for (const auto& plane : scene_.world.bounds->planes) {
            const auto normal = direction(plane.normal.as<2, double>());
            const auto along = perpendicular(normal), through = plane.through.as<2, double>();
            const double far =
                10 * (absolute(through[0]) + absolute(through[1]) + double(picture_.width + picture_.height));
            outline_.clear();
            for (const double way : {-far, far})
                if (const auto seen = view_.see({{through[0] + along[0] * way, through[1] + along[1] * way, 0}}))
                    outline_.push_back(seen->pixel);
            picture_.add(Shape::polyline, outline_, thickness, theme_.wall);
        }
    }
};

/// Two corners around all that a world shows.
template <class WorldT> std::array<Point, 2> extent(const WorldT& world, const Scene& scene) {
    if (scene.world.bounds && scene.world.bounds->box) {
        auto corners = *scene.world.bounds->box;
        for (int i = 0; i < 3; ++i)
            if (corners[0][i] > corners[1][i]) std::swap(corners[0][i], corners[1][i]);
        return corners;
    }
    std::array<Point, 2> corners{};
    for (Row row = 0; row < world.particles.size(); ++row)
        for (int i = 0; i < WorldT::dimension; ++i) {
            const double x = double(world.particles.position[row][i]);
            corners[0][i] = row == 0 ? x : std::min(corners[0][i], x);
            corners[1][i] = row == 0 ? x : std::max(corners[1][i], x);
        }
    // what hangs swings: room for the larger side all around
    const double side = std::max(corners[1][0] - corners[0][0], corners[1][1] - corners[0][1]);
    for (int i = 0; i < 2; ++i) {
        corners[0][i] -= side * 0.5;
        corners[1][i] += side * 0.5;
    }
    return corners;
}

} // namespace

std::array<Point, 2> focus_of(const Scene& scene, const AnyWorld& world) {
    return std::visit([&](const auto& w) { return extent(w, scene); }, world);
}

Vec2<double> Session::place_of(Vec2<double> pixel, int width, int height) const {
    return View(scene_, focus_, width, height).place_of(pixel);
}

void Session::draw(Picture& picture) const {
    const View view(scene_, focus_, picture.width, picture.height);
    std::visit([&](const auto& world) { Drawer(scene_, world, view, picture).draw(); }, world_);
}

} // namespace sinew
