#include "sinew/session/outline.h"
#include "sinew/session/session.h"
#include "sinew/session/surface.h"
#include "sinew/session/view.h"
#include "sinew/session/wardrobe.h"
#include "sinew/solver/edit.h"

#include <algorithm>

/// What a session looks like: the pieces of its figures, dressed by the scene's looks, as a display list. Back to
/// front: background, shadows on it, walls, figures.
namespace sinew {
namespace {

/// Sizes in a picture 480 pixels high; they grow with it.
constexpr double nominal_height = 480;
constexpr float wall_thickness = 3, rim = 2.5F;
constexpr float thinnest = 4; // thinner lines have no outline and throw no shadow
constexpr Vec2<float> shadow_offset{{7, 9}};
constexpr std::array<float, 3> penumbra = {9, 5, 1}; // how much wider than the piece, from the palest to the darkest

template <class WorldT> class Drawer {
  public:
    Drawer(const Scene& scene, const WorldT& world, const View& view, Picture& picture)
        : scene_(scene), world_(world), view_(view), picture_(picture), theme_(theme_called(scene.view.theme)),
          light_(view, theme_.ink), unit_(float(picture.height / nominal_height)) {}

    void draw() {
        picture_.clear();
        picture_.background = theme_.background;
        if (D == 3) floors();
        shadows();
        if (D == 2) walls();
        for (std::size_t i = 0; i < world_.figures.size(); ++i) figure(world_.figures[i], i);
    }

  private:
    static constexpr int D = WorldT::dimension;
    const Scene& scene_;
    const WorldT& world_;
    const View& view_;
    Picture& picture_;
    const Theme& theme_;
    const Light light_;
    const float unit_; // pixels a nominal pixel has
    Pixels outline_, shape_;
    float scale_ = 1; // of what was traced last

    struct Drawn {
        const Piece* piece;
        float depth;
        std::uint32_t group;
    };
    std::vector<Drawn> order_;
    std::vector<std::uint32_t> group_of_row_;
    std::vector<Vec3<double>> normals_; // by row

    static Vec3<double> in_space(const Vec<D, typename WorldT::Real>& place) {
        Vec3<double> wide{};
        for (int i = 0; i < D; ++i) wide[i] = double(place[i]);
        return wide;
    }

    std::optional<Vec3<double>> place_of(ParticleId id) const {
        const auto row = row_of(world_, id);
        return row ? std::optional(in_space(world_.particles.position[*row])) : std::nullopt;
    }

    /// The pixels of a piece's particles into outline_; false if part of it is gone or behind the eye.
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

    float width_of(const Piece& piece, const Style& style) const {
        constexpr double usual_line = 0.04, usual_dot = 0.07; // metres
        const double usual = (piece.mark == Mark::dot ? usual_dot : usual_line) * scene_.measures().per_metre;
        return float(style.width.value_or(piece.width > 0 ? piece.width : usual)) * scale_;
    }

    static bool is_area(const Piece& piece) { return piece.mark == Mark::fill || piece.mark == Mark::surface; }

    // --- order ---------------------------------------------------------------------------------------------------

    /// The visible pieces of a figure, back to front: in 3D by depth; in 2D as they were built, where pieces of one
    /// part that hang together are one group with one outline.
    void put_in_order(const Figure& figure, Wardrobe& wardrobe) {
        order_.clear();
        for (const auto& piece : figure.pieces)
            if (!wardrobe.of(piece.part).hidden.value_or(piece.hidden))
                order_.push_back({&piece, D == 3 ? depth_of(piece) : 0, std::uint32_t(order_.size())});
        if (D == 3)
            std::stable_sort(order_.begin(), order_.end(),
                             [](const Drawn& a, const Drawn& b) { return a.depth > b.depth; });
        if (D == 2) group();
    }

    void group() {
        constexpr auto none = std::uint32_t(-1);
        group_of_row_.assign(world_.particles.size(), none);
        for (std::size_t i = 0, run = 0; i < order_.size(); ++i) {
            if (order_[i].piece->part != order_[run].piece->part) run = i;
            for (const auto id : order_[i].piece->particles) {
                const auto row = row_of(world_, id);
                if (!row) continue;
                auto& known = group_of_row_[*row];
                if (known != none && known >= run) join(run, i, order_[i].group, known);
                known = order_[i].group;
            }
        }
        std::stable_sort(order_.begin(), order_.end(),
                         [](const Drawn& a, const Drawn& b) { return a.group < b.group; });
    }

    /// Two groups of a run become one.
    void join(std::size_t run, std::size_t i, std::uint32_t a, std::uint32_t b) {
        if (a == b) return;
        const auto into = std::min(a, b), gone = std::max(a, b);
        for (std::size_t k = run; k <= i; ++k) {
            if (order_[k].group != gone) continue;
            order_[k].group = into;
            for (const auto id : order_[k].piece->particles)
                if (const auto row = row_of(world_, id); row && group_of_row_[*row] == gone) group_of_row_[*row] = into;
        }
    }

    // --- figures -------------------------------------------------------------------------------------------------

    void figure(const Figure& figure, std::size_t index) {
        Wardrobe wardrobe(scene_, theme_, index, figure.name);
        put_in_order(figure, wardrobe);
        find_normals();
        for (std::size_t i = 0; i < order_.size();) {
            std::size_t end = i + 1;
            while (end < order_.size() && order_[end].group == order_[i].group) ++end;
            for (std::size_t k = i; k < end; ++k) draw_outline(*order_[k].piece, wardrobe.of(order_[k].piece->part));
            for (std::size_t k = i; k < end; ++k) draw_piece(*order_[k].piece, wardrobe.of(order_[k].piece->part));
            i = end;
        }
    }

    void draw_outline(const Piece& piece, const Style& style) {
        if (is_area(piece) || style.color.alpha < 1 || !trace(piece)) return;
        if (width_of(piece, style) >= thinnest)
            paint(piece, style, rim * unit_, mix(style.color, theme_.ink, theme_.outline_shade));
    }

    void draw_piece(const Piece& piece, const Style& style) {
        if (piece.mark == Mark::surface) return draw_surface(piece, style);
        if (!trace(piece)) return;
        paint(piece, style, 0, piece.mark == Mark::fill ? style.fill : style.color);
        if (piece.mark == Mark::dot) add_gloss(width_of(piece, style), style.color);
    }

    /// Where the light catches balls that are large enough to have a shape.
    void add_gloss(float width, const Color& color) {
        constexpr float least = 18, size = 0.3F;
        constexpr Vec2<float> place{{-0.19F, -0.21F}};
        if (width < least * unit_) return;
        for (auto& point : outline_) {
            point += place * width;
            const Color pale{1, 1, 1, color.alpha};
            picture_.add(Shape::disc, std::span(&point, 1), size * width, mix(color, pale, 0.22F));
        }
    }

    /// The piece traced last, so many pixels thicker than it is.
    void paint(const Piece& piece, const Style& style, float thicker, Color color) {
        const float width = width_of(piece, style) + thicker;
        switch (piece.mark) {
        case Mark::stroke:
            if (piece.end_width > 0) return paint_limb(piece, width, thicker, color);
            return picture_.add(Shape::polyline, outline_, width, color);
        case Mark::curve:
            smooth(outline_, shape_);
            return picture_.add(Shape::polyline, shape_, width, color);
        case Mark::loop:
            return picture_.add(Shape::loop, outline_, width, color);
        case Mark::ring: {
            if (outline_.size() != 2) return;
            constexpr float wire = 0.3F; // of the ring's width
            ring(outline_[0], outline_[1], width - thicker, (width - thicker) * wire, shape_);
            return picture_.add(Shape::loop, shape_, (width - thicker) * wire + thicker, color);
        }
        case Mark::dot:
            for (const auto& point : outline_) picture_.add(Shape::disc, std::span(&point, 1), width, color);
            return;
        case Mark::fill:
        case Mark::surface:
            widen(outline_, thicker / 2);
            return picture_.add(Shape::polygon, outline_, 0, color);
        }
    }

    void paint_limb(const Piece& piece, float width, float thicker, Color color) {
        const float end_width = float(piece.end_width) * (width - thicker) / float(piece.width) + thicker;
        const auto width_at = [&](std::size_t i) {
            return width + (end_width - width) * float(i) / float(outline_.size() - 1);
        };
        for (std::size_t i = 0; i + 1 < outline_.size(); ++i) {
            taper(outline_[i], width_at(i), outline_[i + 1], width_at(i + 1), shape_);
            picture_.add(Shape::polygon, shape_, 0, color);
        }
    }

    // --- surfaces ------------------------------------------------------------------------------------------------

    std::optional<Patch> patch_of(const Piece& piece) const {
        Patch patch;
        if (piece.particles.size() != patch.corner.size()) return std::nullopt;
        for (std::size_t i = 0; i < patch.corner.size(); ++i) {
            const auto row = row_of(world_, piece.particles[i]);
            if (!row) return std::nullopt;
            patch.corner[i] = in_space(world_.particles.position[*row]);
            if (*row < normals_.size()) patch.normal[i] = direction(normals_[*row]);
        }
        return patch;
    }

    void find_normals() {
        normals_.clear();
        for (const auto& [piece, depth, group] : order_) {
            if (piece->mark != Mark::surface) continue;
            if (normals_.empty()) normals_.resize(world_.particles.size());
            const auto patch = patch_of(*piece);
            if (!patch) continue;
            const auto normal = own_normal<D>(*patch);
            for (const auto id : piece->particles) normals_[*row_of(world_, id)] += normal;
        }
    }

    void draw_surface(const Piece& piece, const Style& style) {
        const auto patch = patch_of(piece);
        if (!patch || !trace(piece)) return;
        constexpr float finest = 4.5F; // pixels
        constexpr int most = 8;
        float side = 0;
        for (std::size_t i = 0; i < 4; ++i) side = maximum(side, distance(outline_[i], outline_[(i + 1) % 4]));
        const int parts = 1 + int(minimum(side / (finest * unit_), float(most - 1)));
        const double step = 1.0 / parts;
        for (int i = 0; i < parts; ++i)
            for (int k = 0; k < parts; ++k) draw_part(*patch, i * step, k * step, step, style);
    }

    void draw_part(const Patch& patch, double u, double v, double size, const Style& style) {
        constexpr float seam = 0.5F; // pixels
        constexpr std::array<Vec2<double>, 4> corners = {{{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}}};
        shape_.clear();
        for (const auto& corner : corners) {
            const double at_u = u + size * corner[0], at_v = v + size * corner[1];
            const auto place = D == 3 ? bulge(patch, at_u, at_v) : flat(patch, at_u, at_v);
            const auto seen = view_.see(place);
            if (!seen) return;
            shape_.push_back(seen->pixel);
        }
        widen(shape_, seam);
        const auto normal = normal_at(patch, u + size / 2, v + size / 2);
        picture_.add(Shape::polygon, shape_, 0, light_.shade(style.color, style.fill, normal));
    }

    // --- shadows and walls ---------------------------------------------------------------------------------------

    /// All shadows of all figures, palest first, so that they melt into one.
    void shadows() {
        if (D == 3 && scene_.world.bounds && scene_.world.bounds->planes.empty()) return;
        if (D == 3 && !scene_.world.bounds) return;
        for (std::size_t layer = 0; layer < penumbra.size(); ++layer)
            for (std::size_t i = 0; i < world_.figures.size(); ++i) {
                Wardrobe wardrobe(scene_, theme_, i, world_.figures[i].name);
                const float depth = float(layer + 1) / float(penumbra.size());
                for (const auto& piece : world_.figures[i].pieces) {
                    const auto& style = wardrobe.of(piece.part);
                    if (!style.hidden.value_or(piece.hidden)) cast_shadow(piece, style, penumbra[layer] * unit_, depth);
                }
            }
    }

    void cast_shadow(const Piece& piece, const Style& style, float wider, float depth) {
        const Color& own = is_area(piece) ? style.fill : style.color;
        if (own.alpha < 1 || !(D == 3 ? trace_on_floor(piece) : trace(piece))) return;
        if (!is_area(piece) && width_of(piece, style) < thinnest) return;
        if (D == 2)
            for (auto& pixel : outline_) pixel += shadow_offset * unit_;
        paint(piece, style, wider,
              D == 3 ? mix(theme_.ground, theme_.floor_shadow, depth) : mix(theme_.background, theme_.shadow, depth));
    }

    /// The pixels of a piece's shadow on the first of the planes, into outline_.
    bool trace_on_floor(const Piece& piece) {
        const auto& plane = scene_.world.bounds->planes.front();
        const auto normal = direction(plane.normal.template as<3, double>());
        const auto through = plane.through.template as<3, double>();
        const auto sun = direction(normal + light_.towards_light * 0.5); // high above the plane
        const double slope = dot(normal, sun);
        if (slope <= 0) return false;
        outline_.clear();
        for (const auto id : piece.particles) {
            const auto place = place_of(id);
            if (!place) return false;
            const auto seen = view_.see(*place - sun * (dot(*place - through, normal) / slope));
            if (!seen) return false;
            outline_.push_back(seen->pixel);
            scale_ = seen->scale;
        }
        return true;
    }

    /// A pool of light on each plane that is seen from above, below what the camera looks at.
    void floors() {
        if (!scene_.world.bounds) return;
        for (const auto& plane : scene_.world.bounds->planes) {
            const auto normal = direction(plane.normal.template as<3, double>());
            const auto through = plane.through.template as<3, double>();
            const auto onto = [&](const Vec3<double>& place) { return place - normal * dot(place - through, normal); };
            const auto& camera = scene_.view.camera;
            if (dot(camera.eye - through, normal) <= 0) continue;
            const auto middle = onto(camera.target);
            const auto below_eye = onto(camera.eye);
            const double reach = maximum(0.93 * distance(below_eye, middle), 1.2 * distance(below_eye, camera.eye));
            const auto across = direction(cross(normal, view_.towards_eye())), along = cross(across, normal);
            constexpr int rings = 24, corners = 64; // more are closer than one shade
            for (int ring = 0; ring < rings; ++ring) {
                const double t = double(ring + 1) / rings, radius = reach * (1 - double(ring) / rings);
                outline_.clear();
                for (int i = 0; i < corners; ++i) {
                    const double angle = 2 * pi<double> * i / corners;
                    const auto place = middle + (across * cosine(angle) + along * sine(angle)) * radius;
                    if (const auto seen = view_.see(place)) outline_.push_back(seen->pixel);
                }
                const auto blend = float(t * t * (3 - 2 * t));
                picture_.add(Shape::polygon, outline_, 0, mix(theme_.background, theme_.ground, blend));
            }
        }
    }

    /// What is beyond the walls, and a line along them.
    void walls() {
        if (!scene_.world.bounds) return;
        if (const auto& box = scene_.world.bounds->box) {
            outline_.clear();
            const auto& [a, b] = *box;
            for (const auto& corner : {Vec3<double>{{a[0], a[1], 0}}, Vec3<double>{{b[0], a[1], 0}},
                                       Vec3<double>{{b[0], b[1], 0}}, Vec3<double>{{a[0], b[1], 0}}})
                if (const auto seen = view_.see(corner)) outline_.push_back(seen->pixel);
            around(outline_);
            picture_.add(Shape::loop, outline_, wall_thickness * unit_, theme_.wall);
        }
        for (const auto& plane : scene_.world.bounds->planes) {
            const auto normal = direction(plane.normal.template as<2, double>());
            const auto along = perpendicular(normal), through = plane.through.template as<2, double>();
            const double far =
                10 * (absolute(through[0]) + absolute(through[1]) + double(picture_.width + picture_.height));
            const auto corner = [&](double way, double below) {
                const auto place = through + along * way - normal * below;
                return view_.see({{place[0], place[1], 0}})->pixel;
            };
            outline_ = {corner(-far, 0), corner(far, 0), corner(far, far), corner(-far, far)};
            picture_.add(Shape::polygon, outline_, 0, theme_.ground);
            outline_.resize(2);
            picture_.add(Shape::polyline, outline_, wall_thickness * unit_, theme_.wall);
        }
    }

    /// Everything outside of a rectangle, as four bars.
    void around(std::span<const Vec2<float>> rectangle) {
        const auto w = float(picture_.width), h = float(picture_.height);
        float left = w, right = 0, top = h, bottom = 0;
        for (const auto& corner : rectangle) {
            left = minimum(left, corner[0]), right = maximum(right, corner[0]);
            top = minimum(top, corner[1]), bottom = maximum(bottom, corner[1]);
        }
        const auto bar = [&](float x0, float y0, float x1, float y1) {
            const std::array<Vec2<float>, 4> corners = {{{{x0, y0}}, {{x1, y0}}, {{x1, y1}}, {{x0, y1}}}};
            if (x0 < x1 && y0 < y1) picture_.add(Shape::polygon, corners, 0, theme_.ground);
        };
        bar(0, 0, w, top);
        bar(0, bottom, w, h);
        bar(0, maximum(top, 0.0F), left, minimum(bottom, h));
        bar(right, maximum(top, 0.0F), w, minimum(bottom, h));
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
