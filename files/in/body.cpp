#include "files/in/body.h"

#include "sinew/collide/decompose.h"
#include "sinew/scene/text.h"

#include "files/in/json_building.h"

#include <algorithm>
#include <map>
#include <set>

namespace sinew::files {
namespace {

using Side = std::pair<std::size_t, std::size_t>;
using Quad = std::array<std::size_t, 4>;

std::string particle_name(std::size_t i) {
    return concat("p", i);
}

json::Value particle_names(std::span<const std::size_t> numbers) {
    json::Array names;
    for (const auto i : numbers) names.push_back(particle_name(i));
    return names;
}

double area_of(const AreaMesh& mesh, const std::array<std::size_t, 3>& t) {
    const auto b = mesh.points[t[1]] - mesh.points[t[0]], c = mesh.points[t[2]] - mesh.points[t[0]];
    return (b[0] * c[1] - b[1] * c[0]) / 2;
}

class BodyBuilder {
  public:
    BodyBuilder(const AreaMesh& mesh, const Body& body) : mesh_(mesh), body_(body) {}

    json::Object figure() {
        json::Object contact{{"figures", true}};
        json::Object figure{{"contact", contact}};
        if (body_.role != Role::solid) figure.push_back({"internal_damping", damping_rate});
        figure.push_back({"particles", particles()});
        figure.push_back({"constraints", constraints()});
        draw();
        figure.push_back({"pieces", std::move(pieces_)});
        figure.push_back({"looks", std::move(looks_)});
        return figure;
    }

  private:
    static constexpr double damping_rate = 2; // 1/s
    static constexpr double sag = 0.03;       // of a jelly under its own weight, as a share of its size
    static constexpr double least_area = 0.3; // share of a triangle's area that cannot be crushed
    static constexpr double held = 0.02;      // share of a cloth's height from the top that is pinned
    static constexpr double gravity = 9.81;   // m/s^2
    static constexpr double pixels_a_metre = 100;

    const AreaMesh& mesh_;
    const Body& body_;
    double mass_ = 0;
    json::Array pieces_;
    json::Object looks_{{"all", json::Object{{"hidden", true}}}};

    std::pair<Vec2<double>, Vec2<double>> extent() const {
        auto low = mesh_.points[0], high = low;
        for (const auto& p : mesh_.points)
            for (int i = 0; i < 2; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
        return {low, high};
    }

    /// A third of each triangle's mass is at each of its corners: the mass and its middle are exact.
    json::Object particles() {
        std::vector<double> areas(mesh_.points.size());
        for (const auto& t : mesh_.triangles)
            for (const auto corner : t) areas[corner] += area_of(mesh_, t) / 3;
        const auto [low, high] = extent();
        json::Object particles;
        for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
            const double mass = std::max(areas[i] * drawn_density, 1e-9);
            mass_ += mass;
            json::Object particle{{"at", point_json(mesh_.points[i])},
                                  {"mass", rounded_number(mass)},
                                  {"radius", rounded_number(body_.radius)}};
            const bool is_top = mesh_.points[i][1] <= low[1] + held * (high[1] - low[1]);
            if (body_.role == Role::cloth && is_top) particle.push_back({"pinned", true});
            particles.push_back({particle_name(i), particle});
        }
        return particles;
    }

    json::Array constraints() const {
        std::set<Side> sides;
        for (const auto& t : mesh_.triangles)
            for (std::size_t k = 0; k < 3; ++k)
                sides.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
        json::Array all;
        for (const auto& [a, b] : sides) all.push_back(distance_between(a, b));
        if (body_.role != Role::solid)
            for (const auto& t : mesh_.triangles)
                all.push_back(json::Object{{"kind", "area"},
                                           {"between", particle_names(t)},
                                           {"low", rounded_number(least_area * area_of(mesh_, t))}});
        return all;
    }

    json::Object distance_between(std::size_t a, std::size_t b) const {
        json::Object constraint{{"between", particle_names(std::array{a, b})}};
        if (body_.role == Role::cloth)
            constraint.push_back({"high", rounded_number(distance(mesh_.points[a], mesh_.points[b]))});
        if (body_.role == Role::jelly) {
            const auto [low, high] = extent();
            const double size = std::max(high[0] - low[0], high[1] - low[1]) / pixels_a_metre;
            constraint.push_back({"compliance", rounded_number(sag * size / (gravity * mass_))});
        }
        constraint.push_back({"hidden", true});
        return constraint;
    }

    std::vector<std::size_t> outline(std::size_t number) const {
        std::vector<std::size_t> corners;
        for (auto i = mesh_.begin_of(number); i < mesh_.ends[number]; ++i) corners.push_back(i);
        return corners;
    }

    /// The outer outline, with a way to each hole and back.
    std::vector<std::size_t> outline_through_holes() const {
        auto path = outline(0);
        for (std::size_t number = 1; number < mesh_.ends.size(); ++number) {
            const auto hole = outline(number);
            std::size_t from = 0, to = 0;
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < path.size(); ++i)
                for (std::size_t k = 0; k < hole.size(); ++k)
                    if (const double away = distance(mesh_.points[path[i]], mesh_.points[hole[k]]); away < least)
                        least = away, from = i, to = k;
            std::vector<std::size_t> detour;
            for (std::size_t k = 0; k <= hole.size(); ++k) detour.push_back(hole[(to + k) % hole.size()]);
            detour.push_back(path[from]);
            path.insert(path.begin() + std::ptrdiff_t(from) + 1, detour.begin(), detour.end());
        }
        return path;
    }

    void draw() {
        const bool has_fill = !body_.fill.empty() && body_.fill != "none";
        const bool has_stroke = !body_.stroke.empty() && body_.stroke != "none" && body_.stroke_width > 0;
        if (has_fill) {
            add_piece("fill", "inside", outline_through_holes());
            looks_.push_back({"inside", json::Object{{"hidden", false}, {"fill", body_.fill}}});
        }
        if (body_.worn) wear(*body_.worn);
        if (!has_stroke) return;
        for (std::size_t number = 0; number < mesh_.ends.size(); ++number) add_piece("loop", "edge", outline(number));
        looks_.push_back(
            {"edge",
             json::Object{{"hidden", false}, {"color", body_.stroke}, {"width", rounded_number(body_.stroke_width)}}});
    }

    void add_piece(std::string_view mark, std::string_view part, const std::vector<std::size_t>& through) {
        pieces_.push_back(json::Object{{"mark", mark}, {"part", part}, {"through", particle_names(through)}});
    }

    void wear(const Worn& worn) {
        if (body_.role == Role::solid) return wear_whole(worn);
        std::size_t number = 0;
        for (const auto& quad : quads()) {
            const auto part = concat("picture_", number++);
            std::array<Vec2<double>, 4> corners;
            for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh_.points[quad[k]];
            add_piece("fill", part, {quad.begin(), quad.end()});
            const json::Object image{{"file", worn.tile(corners)}};
            looks_.push_back({part, json::Object{{"hidden", false}, {"image", image}}});
        }
    }

    /// An image on a stiff figure keeps its place at the line between two far particles.
    void wear_whole(const Worn& worn) {
        std::size_t a = 0, b = 1;
        for (std::size_t i = 1; i < mesh_.points.size(); ++i)
            if (distance(mesh_.points[0], mesh_.points[i]) > distance(mesh_.points[0], mesh_.points[b])) b = i;
        const auto along = direction(mesh_.points[b] - mesh_.points[a]);
        const auto shift = worn.at + worn.size * 0.5 - (mesh_.points[a] + mesh_.points[b]) * 0.5;
        const double turn = std::atan2(along[1], along[0]) * (180 / pi<double>);
        add_piece("stroke", "picture", {a, b});
        const json::Object image{
            {"file", worn.file},
            {"size", point_json(worn.size)},
            {"turn", rounded_number(turn)},
            {"shift", point_json(Vec2<double>{{dot(shift, along), along[0] * shift[1] - along[1] * shift[0]}})}};
        looks_.push_back({"picture", json::Object{{"hidden", false}, {"image", image}}});
    }

    /// Triangles in pairs where two make a convex quadrilateral; the others have one corner twice.
    std::vector<Quad> quads() const {
        std::map<Side, std::size_t> across; // triangle at each directed side
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) across[{mesh_.triangles[i][k], mesh_.triangles[i][(k + 1) % 3]}] = i;
        std::vector<bool> is_done(mesh_.triangles.size());
        std::vector<Quad> quads;
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
            if (is_done[i]) continue;
            is_done[i] = true;
            quads.push_back(pair_of(i, across, is_done));
        }
        return quads;
    }

    Quad pair_of(std::size_t i, const std::map<Side, std::size_t>& across, std::vector<bool>& is_done) const {
        const auto& t = mesh_.triangles[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            const auto found = across.find({b, a});
            if (found == across.end() || is_done[found->second]) continue;
            const auto& other = mesh_.triangles[found->second];
            const auto d = other[0] != a && other[0] != b   ? other[0]
                           : other[1] != a && other[1] != b ? other[1]
                                                            : other[2];
            if (!(area_of(mesh_, {c, a, d}) > 0 && area_of(mesh_, {c, d, b}) > 0)) continue;
            is_done[found->second] = true;
            return {c, a, d, b};
        }
        return {t[0], t[1], t[2], t[2]};
    }
};

} // namespace

json::Object body_of(const AreaMesh& mesh, const Body& body) {
    return BodyBuilder(mesh, body).figure();
}

} // namespace sinew::files
