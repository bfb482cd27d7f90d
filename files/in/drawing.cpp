#include "files/in/drawing.h"

#include "sinew/collide/decompose.h"
#include "sinew/scene/fill_rule.h"
#include "sinew/scene/text.h"

#include "files/in/body.h"
#include "files/in/json_building.h"
#include "files/in/uncrossed.h"

#include <algorithm>

namespace sinew::files {
namespace {

constexpr double furthest_coordinate = 1e6;  // pixels
constexpr double gravity_in_pixels = 981;    // px/s^2
constexpr double crossing_error = 1.0 / 512; // pixels: two cells of the grid of uncrossed()

std::string path_text(const std::vector<Outline>& outlines, bool closed) {
    std::string text;
    for (const auto& outline : outlines) {
        for (std::size_t i = 0; i < outline.size(); ++i)
            text += format_text("{}{} {}", i == 0 ? "M" : " L", std::round(outline[i][0] * 1e4) / 1e4,
                                std::round(outline[i][1] * 1e4) / 1e4);
        if (closed) text += "Z";
    }
    return text;
}

bool is_far(const DrawnShape& shape) {
    for (const auto& line : shape.lines)
        for (const auto& p : line.points)
            if (!(absolute(p[0]) <= furthest_coordinate && absolute(p[1]) <= furthest_coordinate)) return true;
    return false;
}

/// Points in a place of their own: two at one place have no direction between them.
Outline without_doubles(const Outline& points, bool closed) {
    constexpr double least = 1e-6; // pixels
    Outline result;
    for (const auto& p : points)
        if (result.empty() || distance(result.back(), p) > least) result.push_back(p);
    while (closed && result.size() > 1 && distance(result.back(), result.front()) <= least) result.pop_back();
    return result;
}

} // namespace

double Drawing::thickness() const {
    constexpr double share = 0.002, most = 1; // pixels
    return std::min(most, share * std::max(size_[0], size_[1]));
}

void Drawing::count(std::size_t particles, const std::string& place) {
    particles_ += particles;
    if (particles_ > ImportLimits::particles)
        throw ImportError{place, concat("the figures need more than ", ImportLimits::particles, " particles"),
                          "--error N makes outlines simpler"};
    if (figures_.size() + colliders_.size() > ImportLimits::shapes)
        throw ImportError{place, concat("more than ", ImportLimits::shapes, " shapes")};
}

void Drawing::add(const DrawnShape& shape, const Worn* worn) {
    if (is_far(shape))
        throw ImportError{shape.place, format_text("a coordinate is beyond {} pixels", furthest_coordinate)};
    if (shape.role == Role::none) return notes_.count(shape.place, "left out, as its name says");
    if (shape.role == Role::collider) return add_collider(shape);
    if (shape.role == Role::rope) return add_rope(shape);
    add_area(shape, worn);
}

void Drawing::add_collider(json::Object object, const DrawnShape& drawn) {
    const auto name = names_.take(drawn.name, "collider");
    const bool has_fill = !drawn.fill.empty() && drawn.fill != "none";
    const bool has_line = !drawn.stroke.empty() && drawn.stroke != "none";
    if (has_fill || has_line) {
        const auto& fill = has_fill ? drawn.fill : drawn.stroke;
        looks_.push_back({name, json::Object{{"fill", fill}, {"color", has_line ? drawn.stroke : fill}}});
    }
    object.insert(object.begin(), {"name", name});
    if (drawn.is_sensor) object.push_back({"sensor", true});
    colliders_.push_back(std::move(object));
    count(0, drawn.place);
}

void Drawing::add_collider(const DrawnShape& shape) {
    if (shape.circle)
        return add_collider(
            {{"shape", "sphere"}, {"at", point_json(shape.middle)}, {"radius", rounded_number(*shape.circle)}}, shape);
    if (shape.box) {
        json::Object box{{"shape", "box"}, {"at", point_json(shape.middle)}, {"size", point_json(*shape.box)}};
        if (shape.turn != 0) box.push_back({"turn", rounded_number(-shape.turn)});
        return add_collider(box, shape);
    }
    for (const auto& line : shape.lines)
        if (!line.closed) {
            const auto points = without_doubles(simplified_line(line.points, error_), false);
            if (points.size() < 2) continue;
            json::Array list;
            for (const auto& p : points) list.push_back(point_json(p));
            add_collider({{"shape", "chain"}, {"points", list}}, shape);
        }
    for (const auto& area : areas_of(shape)) {
        const auto holes = std::span(area).subspan(1);
        if (collide::convex_parts(area[0], holes).empty()) {
            notes_.add(shape.place, "its outline touches itself or encloses nothing: no collider");
            continue;
        }
        json::Object polygon{{"shape", "polygon"}, {"path", path_text(area, true)}};
        if (area.size() > 1) polygon.push_back({"fill_rule", "evenodd"});
        add_collider(polygon, shape);
    }
}

/// Closed lines of a shape, simplified.
std::vector<Outline> Drawing::outlines_of(const DrawnShape& shape) {
    std::vector<Outline> outlines;
    std::size_t points = 0, kept = 0;
    for (const auto& line : shape.lines) {
        if (!line.closed) continue;
        points += line.points.size();
        auto simple = without_doubles(simplified_loop(without_doubles(line.points, true), error_), true);
        kept += simple.size();
        if (simple.size() < 3)
            notes_.count(shape.place, without_area());
        else
            outlines.push_back(std::move(simple));
    }
    if (kept > ImportLimits::corners)
        throw ImportError{shape.place,
                          concat("its outline has ", kept, " corners once simplified, at most ", ImportLimits::corners,
                                 " are possible"),
                          format_text("--error N, more than {:6} pixels, leaves fewer", error_)};
    if (kept < points) notes_.count(shape.place, format_text("outlines are simplified, by at most {:6} px", error_));
    return outlines;
}

/// Areas of a shape's closed lines, each with its holes.
std::vector<std::vector<Outline>> Drawing::areas_of(const DrawnShape& shape) {
    auto outlines = outlines_of(shape);
    const bool crossed = have_crossings(outlines);
    if (crossed) outlines = uncrossed(outlines, shape.fill_rule);
    if (crossed && outlines.empty()) notes_.add(shape.place, "its outlines cross too often");
    std::vector<SvgOutline> closed;
    for (auto& outline : outlines) {
        // Splinters of outlines that cross are left out, too.
        const double least = crossed ? error_ * length_of(outline, true) / 2 : 0;
        if (std::abs(collide::twice_area(outline)) <= least)
            notes_.count(shape.place, without_area());
        else
            closed.push_back({std::move(outline), true});
    }
    std::vector<std::vector<Outline>> areas;
    for (const auto& solid : solids_of(closed, crossed ? fill_rules[0] : shape.fill_rule).solids) {
        auto& area = areas.emplace_back();
        area.push_back(solid.outline);
        area.insert(area.end(), solid.holes.begin(), solid.holes.end());
        if (!crossed) continue;
        for (auto& outline : area) {
            outline.erase(outline.begin()); // in the middle of an edge
            outline = simplified_loop(outline, crossing_error);
        }
    }
    return areas;
}

std::string Drawing::without_area() const {
    return format_text("an outline smaller than the error of {:6} px has no area", error_);
}

void Drawing::add_area(const DrawnShape& shape, const Worn* worn) {
    for (const auto& line : shape.lines)
        if (!line.closed)
            notes_.add(shape.place, "an open line has no area to fill: only rope and collider can be made of it");
    for (auto& area : areas_of(shape)) {
        const bool is_stiff = shape.role == Role::solid;
        // About sixty triangles of a soft figure, and not fewer than ten edges along its outline.
        constexpr double triangles = 60, edges = 10;
        double size = std::abs(collide::twice_area(area[0])) / 2;
        for (std::size_t i = 1; i < area.size(); ++i) size -= std::abs(collide::twice_area(area[i])) / 2;
        const double spacing = std::min(std::sqrt(size / triangles * 2.3), length_of(area[0], true) / edges);
        if (!is_stiff)
            for (auto& outline : area) outline = subdivided(outline, spacing, true);
        const auto mesh = triangulated(area, is_stiff ? 0 : spacing, 2 * ImportLimits::corners);
        if (mesh.triangles.empty()) {
            notes_.add(shape.place,
                       "its outline touches itself, or is too thin to be filled with triangles: it is left out");
            continue;
        }
        count(mesh.points.size(), shape.place);
        auto figure = body_of(mesh, {shape.role, thickness() / 2, shape.fill, shape.stroke, shape.stroke_width, worn});
        figure.insert(figure.begin(), {"name", names_.take(shape.name, "figure")});
        figures_.push_back(std::move(figure));
    }
}

void Drawing::add_rope(const DrawnShape& shape) {
    for (const auto& line : shape.lines) {
        const double length = length_of(line.points, line.closed);
        constexpr double pieces = 24;
        auto points = without_doubles(simplified_line(line.points, error_), line.closed);
        if (points.size() < 2 || !(length > 0)) {
            notes_.add(shape.place, "a rope without a length is left out");
            continue;
        }
        if (points.size() > ImportLimits::corners)
            throw ImportError{shape.place, concat("the rope has more than ", ImportLimits::corners, " corners"),
                              "--error N leaves fewer"};
        points = subdivided(points, length / pieces, line.closed);
        count(points.size(), shape.place);
        const double width = shape.stroke_width > 0 ? shape.stroke_width : 2 * thickness();
        // A rope weighs a tenth of a plate as wide as it is drawn would, per length.
        const double mass = length * std::max(width, 1.0) * drawn_density / double(points.size());
        json::Object particles;
        json::Array constraints, names;
        for (std::size_t i = 0; i < points.size(); ++i) {
            json::Object particle{
                {"at", point_json(points[i])}, {"mass", rounded_number(mass)}, {"radius", rounded_number(width / 2)}};
            if (i == 0) particle.push_back({"pinned", true});
            particles.push_back({concat("p", i), particle});
            names.push_back(concat("p", i));
            const auto next = (i + 1) % points.size();
            if (next == 0 && !line.closed) continue;
            constraints.push_back(json::Object{{"between", json::Array{concat("p", i), concat("p", next)}},
                                               {"high", rounded_number(distance(points[i], points[next]))},
                                               {"hidden", true}});
        }
        if (line.closed) names.push_back("p0");
        const json::Object rope{{"hidden", false},
                                {"color", shape.stroke.empty() || shape.stroke == "none" ? "ink" : shape.stroke},
                                {"width", rounded_number(width)}};
        figures_.push_back(
            json::Object{{"name", names_.take(shape.name, "rope")},
                         {"contact", json::Object{{"figures", true}}},
                         {"particles", particles},
                         {"constraints", constraints},
                         {"pieces", json::Array{json::Object{{"mark", "curve"}, {"part", "rope"}, {"through", names}}}},
                         {"looks", json::Object{{"all", json::Object{{"hidden", true}}}, {"rope", rope}}}});
    }
}

Imported Drawing::finish(std::string about) {
    if (figures_.empty() && colliders_.empty()) {
        const auto notes = notes_.taken(); // the first is the reason, as far as there is one
        throw ImportError{notes.empty() ? "" : notes[0].place, "there is no shape in it that a scene can have",
                          notes.empty() ? "" : notes[0].message};
    }
    auto low = Vec2<double>{}, high = size_;
    if (colliders_.empty()) {
        low = {{-size_[0] / 4, -size_[1] / 4}};
        high = {{size_[0] * 1.25, size_[1] * 1.5}};
    }
    const auto size = high - low;
    constexpr double longest = 800; // pixels of a picture
    const double scale = longest / std::max(size[0], size[1]);
    json::Object scene{{"sinew", 1}, {"about", std::move(about)}};
    scene.push_back({"units", json::Object{{"length", "px"}, {"up", "-y"}}});
    const auto pixels = [&](double length) {
        return std::int64_t(std::clamp(std::round(length * scale), 100.0, longest));
    };
    scene.push_back({"view", json::Object{{"size", json::Array{pixels(size[0]), pixels(size[1])}},
                                          {"center", point_json((low + high) * 0.5)},
                                          {"height", rounded_number(size[1])}}});
    scene.push_back(
        {"world", json::Object{{"gravity", json::Array{0, gravity_in_pixels}},
                               {"bounds", json::Object{{"box", json::Array{point_json(low), point_json(high)}},
                                                       {"friction", 0.5}}}}});
    if (!looks_.empty()) scene.push_back({"looks", std::move(looks_)});
    if (!colliders_.empty()) scene.push_back({"colliders", std::move(colliders_)});
    if (!figures_.empty()) scene.push_back({"figures", std::move(figures_)});
    scene.push_back({"seconds", 6});
    return {std::move(scene), notes_.taken(), {}};
}

} // namespace sinew::files
