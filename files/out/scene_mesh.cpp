#include "files/out/scene_mesh.h"

#include "sinew/math/bezier.h"
#include "sinew/picture/style_resolver.h"
#include "sinew/picture/surface.h"
#include "sinew/picture/theme.h"
#include "sinew/world/edit.h"

#include "files/out/model_space.h"
#include "files/out/worn_image.h"

#include <algorithm>
#include <utility>

namespace sinew::files {
namespace {

constexpr auto unused = ~std::uint32_t(0);

/// Straight parts of a Bezier limb.
constexpr int limb_parts = 12;

/// Point at t of a limb with three control points or four.
Vec3<double> limb_at(std::span<const Vec3<double>> p, double t) {
    if (p.size() == 3) return QuadraticBezier<3, double>{p[0], p[1], p[2]}.at(t);
    return CubicBezier<3, double>{p[0], p[1], p[2], p[3]}.at(t);
}

template <class WorldT> class Collector {
  public:
    Collector(const Session& session, const WorldT& world, const MeshContent& content)
        : scene_(session.scene()), world_(world), content_(content), theme_(theme_called(scene_.view.theme)),
          space_(scene_), vertex_of_(world.particles.size(), unused) {
        mesh_.flat = D == 2;
        if (content.images) mesh_.images = session.images();
    }

    SceneMesh collect() {
        each_piece(
            [this](const Figure& figure, const Piece& piece, const Style& style) { mark(figure, piece, style); });
        for (const auto& figure : world_.figures)
            for (const auto id : figure.particles)
                if (const auto row = row_of(world_, id); row && vertex_of_[*row] != unused) add_particle(*row);
        each_piece([this](const Figure& figure, const Piece& piece, const Style& style) { add(figure, piece, style); });
        if (!rolls_) mesh_.turns.clear();
        if (!mesh_.on_image.empty()) mesh_.on_image.resize(mesh_.vertices.size());
        return std::move(mesh_);
    }

  private:
    static constexpr int D = WorldT::dimension;

    template <class Visit> void each_piece(Visit&& visit) {
        for (std::size_t i = 0; i < world_.figures.size(); ++i) {
            const auto& figure = world_.figures[i];
            if (!figure.in_use() || !is_wanted(figure.name)) continue;
            StyleResolver resolver(scene_, theme_, i, figure.name);
            for (const auto& piece : figure.pieces) {
                const auto& style = resolver.of(piece.part);
                const bool is_seen = color_of(piece, style).alpha > 0 || image_on(piece, style);
                if (!style.hidden.value_or(piece.hidden) && is_seen && is_whole(piece)) visit(figure, piece, style);
            }
        }
    }

    bool is_wanted(const std::string& figure) const {
        return content_.figures.empty() || std::ranges::find(content_.figures, figure) != content_.figures.end();
    }

    bool is_whole(const Piece& piece) const {
        return std::all_of(piece.particles.begin(), piece.particles.end(),
                           [&](ParticleId id) { return row_of(world_, id).has_value(); });
    }

    static const Color& color_of(const Piece& piece, const Style& style) {
        return piece.mark == Mark::fill ? style.fill : style.color;
    }

    /// Number of the image that a piece wears: in space, only from corner to corner.
    std::optional<std::uint32_t> image_on(const Piece& piece, const Style& style) const {
        if (D == 3 && piece.mark != Mark::fill) return std::nullopt;
        return image_of(piece, style, mesh_.images);
    }

    /// True if faces with an image take the place of the piece.
    bool is_worn(const Piece& piece, const Style& style) const { return image_on(piece, style) && !is_rope(piece); }

    static bool is_bent(const Piece& piece) {
        return piece.mark == Mark::limb && (piece.particles.size() == 3 || piece.particles.size() == 4);
    }

    bool is_shown(const Piece& piece) const {
        switch (piece.mark) {
        case Mark::face:
            return false;
        case Mark::ring:
        case Mark::dot:
        case Mark::tip:
            return content_.balls;
        default:
            return true;
        }
    }

    /// First pass: notes which particles become vertices.
    void mark(const Figure&, const Piece& piece, const Style& style) {
        if (!is_shown(piece) || is_bent(piece) || piece.mark == Mark::fragment || is_worn(piece, style)) return;
        for (const auto id : piece.particles) vertex_of_[*row_of(world_, id)] = 0;
    }

    void add_particle(Row row) {
        vertex_of_[row] = add_vertex(position_of(row));
        const auto& turn = world_.particles.turn[row].number;
        rolls_ |= world_.particles.turn[row] != collide::Rotation<D, typename WorldT::Real>{};
        if constexpr (D == 3)
            mesh_.turns.push_back({{double(turn[0]), double(turn[1]) * space_.sense(), double(turn[2]) * space_.sense(),
                                    double(turn[3])}});
        else
            mesh_.turns.push_back(half_of(double(turn[0]), double(turn[1]) * space_.sense()));
    }

    /// Quaternion about z of a rotation given by cosine and sine: the half angle, by the bisector.
    static Vec<4, double> half_of(double c, double s) {
        const double w = square_root(max(0.0, (1 + c) / 2)), z = square_root(max(0.0, (1 - c) / 2));
        return {{0, 0, s < 0 ? -z : z, w}};
    }

    Vec3<double> in_scene(Row row) const {
        Vec3<double> wide{};
        for (int i = 0; i < D; ++i) wide[i] = double(world_.particles.position[row][i]);
        return wide;
    }
    Vec3<double> position_of(Row row) const { return space_.position(in_scene(row)); }

    std::uint32_t add_vertex(const Vec3<double>& position) {
        mesh_.vertices.push_back(position);
        return std::uint32_t(mesh_.vertices.size() - 1);
    }

    std::uint32_t number_of(const MeshGroup& group) {
        if (mesh_.groups.empty() || mesh_.groups.back() != group) {
            const auto found = std::ranges::find(mesh_.groups, group);
            if (found != mesh_.groups.end()) return std::uint32_t(found - mesh_.groups.begin());
            mesh_.groups.push_back(group);
        }
        return std::uint32_t(mesh_.groups.size() - 1);
    }

    void add(const Figure& figure, const Piece& piece, const Style& style) {
        if (!is_shown(piece)) return;
        const auto image = image_on(piece, style);
        if (image && is_rope(piece)) return add_rope(figure, piece, style, *image);
        if (image) return add_worn(figure, piece, style, *image);
        if (image_of(piece, style, mesh_.images)) note_bare(figure.name);
        MeshElement element{.group = number_of({figure.name, piece.part, color_of(piece, style)})};
        element.width = space_.length(width_of(piece, style));
        element.end_width = piece.end_width > 0 ? element.width * piece.end_width / piece.width : element.width;
        switch (piece.mark) {
        case Mark::fill:
        case Mark::surface:
            return add_face(piece, element);
        case Mark::fragment:
            return add_fragment(figure.fragments[piece.fragment], piece, element);
        case Mark::dot:
            for (const auto id : piece.particles) add_ball(id, element);
            return;
        case Mark::tip:
            return add_ball(piece.particles[piece.particles.size() - 1], element);
        case Mark::ring:
            return add_along(piece, ElementKind::ring, element);
        default:
            return is_bent(piece) ? add_limb(piece, element) : add_along(piece, ElementKind::line, element);
        }
    }

    double width_of(const Piece& piece, const Style& style) const {
        constexpr double usual_line = 0.04, usual_dot = 0.07; // metres, as the picture draws them
        const double usual = piece.mark == Mark::dot || piece.mark == Mark::tip ? usual_dot : usual_line;
        return style.width.value_or(piece.width > 0 ? piece.width : usual * scene_.measures().per_metre);
    }

    void note_bare(const std::string& figure) {
        if (mesh_.bare.empty() || mesh_.bare.back() != figure) mesh_.bare.push_back(figure);
    }

    void add_worn(const Figure& figure, const Piece& piece, const Style& style, std::uint32_t image) {
        std::vector<Vec3<double>> places;
        for (const auto id : piece.particles) places.push_back(position_of(*row_of(world_, id)));
        const auto group = number_of({figure.name, piece.part, {1, 1, 1, 1}, image});
        if (piece.mark == Mark::fill) return add_grid(worn_quad(places), group);
        ProjectedPiece seen{.mark = piece.mark, .points = {}, .scale = float(space_.length(1))};
        for (const auto& p : places) seen.points.push_back({{float(p[0]), -float(p[1])}});
        const double width = width_of(piece, style), end = piece.end_width > 0 ? piece.end_width / piece.width : 1;
        seen.width = float(space_.length(width)), seen.end_width = float(space_.length(width * end));
        for (const auto& worn : worn_images(seen, style, mesh_.images[image].second)) add_grid(worn, group);
    }

    static bool is_rope(const Piece& piece) {
        return piece.mark == Mark::curve || (piece.mark == Mark::stroke && piece.particles.size() > 2);
    }

    /// A line as wide as the image, which repeats along it.
    void add_rope(const Figure& figure, const Piece& piece, const Style& style, std::uint32_t image) {
        const auto& [pixels, size] = std::pair(mesh_.images[image].second, style.image->size);
        const double width = space_.length(size ? absolute((*size)[1]) : width_of(piece, style));
        MeshElement rope{.group = number_of({figure.name, piece.part, {1, 1, 1, 1}, image, true})};
        rope.width = rope.end_width = width;
        rope.image_length = size ? space_.length(absolute((*size)[0])) : width * pixels->width / pixels->height;
        add_along(piece, ElementKind::line, rope);
    }

    /// The grid as triangles. In a plane scene later parts lie in front of earlier ones, by a tenth of a millimetre.
    void add_grid(const WornImage& worn, std::uint32_t group) {
        const double front = D == 2 ? 1e-4 * double(group + 1) : 0;
        const auto first = std::uint32_t(mesh_.vertices.size());
        mesh_.on_image.resize(first);
        for (const auto& p : worn.points) add_vertex(p + Vec3<double>{{0, 0, front}});
        mesh_.on_image.insert(mesh_.on_image.end(), worn.on_image.begin(), worn.on_image.end());
        for (auto corners : worn.triangles()) {
            for (auto& corner : corners) corner += first;
            add_element({.group = group}, ElementKind::face, corners);
        }
    }

    void add_element(MeshElement element, ElementKind kind, std::span<const std::uint32_t> corners) {
        element.kind = kind;
        element.first = std::uint32_t(mesh_.corners.size());
        element.count = std::uint32_t(corners.size());
        mesh_.corners.insert(mesh_.corners.end(), corners.begin(), corners.end());
        mesh_.elements.push_back(element);
    }

    std::vector<std::uint32_t> corners_of(const Piece& piece) const {
        std::vector<std::uint32_t> corners;
        for (const auto id : piece.particles) corners.push_back(vertex_of_[*row_of(world_, id)]);
        return corners;
    }

    /// Triangles of cloth are patches with one corner twice.
    void add_face(const Piece& piece, const MeshElement& element) {
        auto corners = corners_of(piece);
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
        if (corners.size() >= 3) add_element(element, ElementKind::face, corners);
    }

    void add_along(const Piece& piece, ElementKind kind, const MeshElement& element) {
        auto corners = corners_of(piece);
        if (piece.mark == Mark::loop && corners.size() > 2) corners.push_back(corners.front());
        if (corners.size() >= 2 && (kind == ElementKind::line || corners[0] != corners[1]))
            add_element(element, kind, corners);
    }

    void add_limb(const Piece& piece, const MeshElement& element) {
        std::vector<Vec3<double>> points;
        for (const auto id : piece.particles) points.push_back(position_of(*row_of(world_, id)));
        std::vector<std::uint32_t> corners;
        for (int i = 0; i <= limb_parts; ++i) corners.push_back(add_vertex(limb_at(points, double(i) / limb_parts)));
        add_element(element, ElementKind::line, corners);
    }

    void add_ball(ParticleId id, const MeshElement& element) {
        const std::uint32_t corner = vertex_of_[*row_of(world_, id)];
        add_element(element, ElementKind::ball, std::span(&corner, 1));
    }

    void add_fragment(const Fragment& fragment, const Piece& piece, const MeshElement& element) {
        const auto position = [&](std::size_t i) { return in_scene(*row_of(world_, piece.particles[i])); };
        Patch patch;
        for (std::size_t i = 0; i < patch.corner.size(); ++i)
            patch.corner[i] = sinew::position_of(fragment.corners[i], position, D == 2);
        fragment.each_tile([&](std::span<const Vec2<float>> tile) {
            std::vector<std::uint32_t> corners;
            for (const auto& uv : tile)
                corners.push_back(add_vertex(space_.position(sinew::flat(patch, double(uv[0]), double(uv[1])))));
            if (corners.size() >= 3) add_element(element, ElementKind::face, corners);
        });
    }

    const Scene& scene_;
    const WorldT& world_;
    const MeshContent& content_;
    const Theme& theme_;
    const ModelSpace space_;
    SceneMesh mesh_;
    std::vector<std::uint32_t> vertex_of_; ///< by row
    bool rolls_ = false;
};

} // namespace

SceneMesh mesh_of(const Session& session, const MeshContent& content) {
    return std::visit([&](const auto& world) { return Collector(session, world, content).collect(); }, session.world());
}

} // namespace sinew::files
