#include "files/in/model_scene.h"

#include "sinew/prefab/jelly.h"
#include "sinew/prefab/tetrahedra.h"
#include "sinew/scene/text.h"

#include "files/in/json_building.h"

#include <algorithm>
#include <limits>
#include <map>

namespace sinew::files {
namespace {

constexpr double cloth_density = 0.3;  // kg/m^2: a shirt's
constexpr double jelly_density = 100;  // kg/m^3
constexpr double highest_share = 0.01; // of a cloth's height, from its top: those points are pinned

struct MeshMeasure {
    double area = 0, volume = 0;
    Vec3<double> low{}, high{};
};

MeshMeasure measured(const MeshModel& model) {
    MeshMeasure result;
    result.low = result.high = model.points[0];
    for (const auto& p : model.points)
        for (int i = 0; i < 3; ++i)
            result.low[i] = std::min(result.low[i], p[i]), result.high[i] = std::max(result.high[i], p[i]);
    for (std::size_t i = 0; i < model.faces(); ++i) {
        const auto face = model.face(i);
        for (std::size_t k = 2; k < face.size(); ++k) {
            const auto &a = model.points[face[0]], &b = model.points[face[k - 1]], &c = model.points[face[k]];
            const auto normal = cross(b - a, c - a);
            result.area += norm(normal) / 2;
            result.volume += dot(a - result.low, normal) / 6;
        }
    }
    return result;
}

} // namespace

MeshModel part_of(const MeshModel& whole, const std::vector<std::size_t>& faces) {
    MeshModel part;
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (const auto i : faces) {
        for (const auto corner : whole.face(i)) {
            const auto [found, fresh] = numbers.try_emplace(corner, std::uint32_t(part.points.size()));
            if (fresh) part.points.push_back(whole.points[corner]);
            part.corners.push_back(found->second);
        }
        part.ends.push_back(std::uint32_t(part.corners.size()));
    }
    return weld(part);
}

void ModelScene::include(const Vec3<double>& point) {
    if (is_empty_) low_ = high_ = point;
    is_empty_ = false;
    for (int i = 0; i < 3; ++i) low_[i] = std::min(low_[i], point[i]), high_[i] = std::max(high_[i], point[i]);
}

double ModelScene::longest_side() const {
    const auto size = high_ - low_;
    return std::max({size[0], size[1], size[2]});
}

double ModelScene::scale() const {
    if (options_.scale) return *options_.scale;
    const double longest = longest_side();
    constexpr double least = 0.1, most = 50, usual = 2; // metres
    return longest >= least && longest <= most ? 1 : usual / std::max(longest, 1e-9);
}

void ModelScene::add(ImportedMesh mesh) {
    if (meshes_.size() >= ImportLimits::shapes)
        throw ImportError{mesh.place, concat("more than ", ImportLimits::shapes, " meshes")};
    for (const auto& p : mesh.model.points) include(p);
    meshes_.push_back(std::move(mesh));
}

void ModelScene::add(json::Object figure, const Vec3<double>& low, const Vec3<double>& high) {
    include(low), include(high);
    const auto* const name = json::find(figure, "name");
    const auto wanted = name ? *name->value.as<std::string>() : std::string("figure");
    if (auto* found = json::find(figure, "name")) found->value = names_.take(wanted, "figure");
    figures_.push_back(std::move(figure));
}

/// A mesh without a role is soft if it is closed, else cloth.
void ModelScene::build(ImportedMesh& mesh) {
    const double factor = scale();
    constexpr double furthest = 1e6; // metres, as for every OBJ file
    for (auto& p : mesh.model.points) {
        p = p * factor;
        for (int i = 0; i < 3; ++i)
            if (!(absolute(p[i]) <= furthest))
                throw ImportError{mesh.place, format_text("a coordinate is beyond {:6} m", furthest)};
    }
    auto role = mesh.role.value_or(
        role_called(options_.role).value_or(open_edges(mesh.model) == 0 ? Role::jelly : Role::cloth));
    if (role == Role::none) return notes_.count(mesh.place, "left out, as its name says");
    if (role == Role::rope) notes_.add(mesh.place, "a mesh is no rope: it comes as cloth"), role = Role::cloth;
    if (role == Role::solid)
        notes_.add(mesh.place, "stiff meshes are not possible: it comes as jelly"), role = Role::jelly;
    if (role == Role::jelly) {
        const Jelly jelly{.model = std::make_shared<const MeshModel>(mesh.model)};
        if (const auto problem = jelly.problem(3))
            notes_.add(mesh.place, concat(*problem, ": it comes as cloth")), role = Role::cloth;
    }
    mesh.name = names_.take(mesh.name, "model");
    const auto file = format_text("{}_models/{}.obj", file_.title, mesh.name);
    beside_.push_back({file, to_obj(mesh.model)});
    if (role == Role::collider) {
        if (!mesh.color.empty()) looks_.push_back({mesh.name, json::Object{{"fill", mesh.color}}});
        colliders_.push_back(json::Object{{"name", mesh.name}, {"shape", "mesh"}, {"file", file}});
    } else {
        add_figure(mesh, role, file);
    }
}

void ModelScene::add_figure(const ImportedMesh& mesh, Role role, const std::string& file) {
    const auto size = measured(mesh.model);
    const auto extent = size.high - size.low;
    const double longest = std::max({extent[0], extent[1], extent[2]});
    json::Object figure{{"prefab", role == Role::jelly ? "jelly" : "mesh"}, {"name", mesh.name}, {"file", file}};
    const double mass = role == Role::jelly ? std::abs(size.volume) * jelly_density : size.area * cloth_density;
    figure.push_back({"mass", rounded_number(std::clamp(mass, 1e-3, 1e6))});
    constexpr double thin = 0.01; // of the longest side
    figure.push_back({"thickness", rounded_number(std::max(longest * thin, 1e-6))});
    if (role == Role::cloth) {
        json::Array pins;
        const bool hangs = extent[1] > 0.1 * longest;
        for (std::size_t i = 0; hangs && i < mesh.model.points.size(); ++i)
            if (mesh.model.points[i][1] >= size.high[1] - highest_share * extent[1]) pins.push_back(std::int64_t(i));
        if (hangs) {
            notes_.add(mesh.place,
                       concat(mesh.name, " hangs from its ", pins.size(), " highest points; pin_list names them"));
            figure.push_back({"pin_list", std::move(pins)});
        }
    }
    figure.push_back({"contact", json::Object{{"figures", true}}});
    // The colour of a surface is that of its front, the fill that of its back.
    const json::Object look{{"color", mesh.color}, {"fill", mesh.color}};
    if (!mesh.color.empty()) figure.push_back({"looks", json::Object{{role == Role::jelly ? "skin" : "cloth", look}}});
    figures_.push_back(std::move(figure));
}

/// A floor below everything, unless a collider reaches as deep.
bool ModelScene::needs_floor() const {
    return colliders_.empty();
}

json::Object ModelScene::view() const {
    const auto middle = (low_ + high_) * (scale() / 2);
    const double radius = std::max(norm(high_ - low_) * scale() / 2, 0.05);
    constexpr double distance = 3.1; // radii: all is seen, with room to fall
    const auto eye = middle + direction(Vec3<double>{{0.45, 0.35, 1}}) * (distance * radius);
    const auto target = middle - Vec3<double>{{0, 0.2 * radius, 0}};
    return {{"size", json::Array{800, 600}},
            {"camera", json::Object{{"eye", point_json(eye)}, {"target", point_json(target)}}}};
}

Imported ModelScene::finish() {
    if (meshes_.empty() && figures_.empty())
        throw ImportError{"", "there is no mesh and no skeleton in it that a scene can have"};
    if (const double factor = scale(); factor != 1 && !options_.scale)
        notes_.add("", format_text("its longest side is {:3} m: it is scaled by {:3} to be 2 m; --scale 1 keeps it",
                                   longest_side(), factor));
    for (auto& mesh : meshes_) build(mesh);
    if (figures_.empty() && colliders_.empty()) throw ImportError{"", "everything in it is left out by its name"};
    const double height = std::max(high_[1] - low_[1], 0.2 * norm(high_ - low_)) * scale();
    if (needs_floor()) {
        const Vec3<double> at{{0, low_[1] * scale() - 0.4 * height, 0}};
        colliders_.push_back(json::Object{{"name", names_.take("floor", "floor")},
                                          {"shape", "half_space"},
                                          {"at", point_json(at)},
                                          {"friction", 0.6}});
    }
    json::Object scene{{"sinew", 1},
                       {"about", concat("Imported from ", file_.name)},
                       {"dimension", 3},
                       {"view", view()},
                       {"world", json::Object{{"gravity", json::Array{0, -9.81, 0}}, {"damping", 0.05}}},
                       {"colliders", std::move(colliders_)}};
    if (!looks_.empty()) scene.push_back({"looks", std::move(looks_)});
    if (!figures_.empty()) scene.push_back({"figures", std::move(figures_)});
    scene.push_back({"seconds", 5});
    return {std::move(scene), notes_.taken(), std::move(beside_)};
}

} // namespace sinew::files
