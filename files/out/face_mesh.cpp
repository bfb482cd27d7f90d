#include "files/out/face_mesh.h"

#include "sinew/collide/decompose.h"

#include "files/out/linear_keys.h"

#include <algorithm>

namespace sinew::files {
namespace {

using Indices = std::vector<std::uint32_t>;

/// Corners of a polygon's triangles: of a plane one, which may be concave, by its convex parts.
void add_triangles(std::span<const std::uint32_t> corners, const MeshFilm& film, Indices& triangles) {
    const auto fan = [&](std::span<const std::uint32_t> part) {
        for (std::size_t i = 2; i < part.size(); ++i)
            for (const auto corner : {part[0], part[i - 1], part[i]}) triangles.push_back(corner);
    };
    std::vector<Vec2<double>> outline;
    for (const auto i : corners) outline.push_back({{film.position(0, i)[0], film.position(0, i)[1]}});
    const auto parts =
        film.form().flat && corners.size() > 3 ? collide::convex_parts(outline) : std::vector<collide::Corners>{};
    if (parts.empty()) return fan(corners);
    for (const auto& part : parts) {
        Indices known;
        for (const auto& p : part)
            known.push_back(corners[std::size_t(std::ranges::find(outline, p) - outline.begin())]);
        fan(known);
    }
}

/// Normals of vertices: area-weighted means of the triangles around.
std::vector<Vec3<float>> normals_of(std::span<const Vec3<float>> positions, std::span<const std::uint32_t> triangles) {
    std::vector<Vec3<float>> normals(positions.size());
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const auto &a = positions[triangles[i]], &b = positions[triangles[i + 1]], &c = positions[triangles[i + 2]];
        for (std::size_t k = 0; k < 3; ++k) normals[triangles[i + k]] += cross(b - a, c - a);
    }
    for (auto& normal : normals) {
        normal = direction(normal);
        if (normal == Vec3<float>{}) normal = {{0, 0, 1}};
    }
    return normals;
}

} // namespace

std::vector<std::uint32_t> vertices_of(const MeshFilm& film, std::span<const MeshElement> elements) {
    Indices vertices;
    for (const auto& element : elements) {
        const auto corners = film.form().corners_of(element);
        vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

FaceMesh face_mesh(const MeshFilm& film, std::span<const MeshElement> faces, std::span<const int> materials) {
    FaceMesh mesh{.vertices = vertices_of(film, faces), .triangles = {}, .parts = {}, .on_image = {}};
    for (const auto& face : faces) {
        Indices corners;
        add_triangles(film.form().corners_of(face), film, corners);
        for (auto& corner : corners)
            corner = std::uint32_t(std::ranges::lower_bound(mesh.vertices, corner) - mesh.vertices.begin());
        mesh.triangles.insert(mesh.triangles.end(), corners.begin(), corners.end());
        const int material = materials[face.group];
        if (mesh.parts.empty() || mesh.parts.back().material != material)
            mesh.parts.push_back({material, {}, film.form().group_of(face).image.has_value()});
        auto& indices = mesh.parts.back().indices;
        indices.insert(indices.end(), corners.begin(), corners.end());
    }
    if (std::ranges::any_of(mesh.parts, [](const auto& part) { return part.has_texture; }))
        for (const auto vertex : mesh.vertices) mesh.on_image.push_back(film.form().on_image[vertex]);
    return mesh;
}

TriangleMesh posed(const FaceMesh& mesh, const MeshFilm& film, std::size_t frame, const Vec3<double>& about) {
    TriangleMesh pose;
    for (const auto i : mesh.vertices) pose.positions.push_back(cast<float>(film.position(frame, i) - about));
    pose.normals = normals_of(pose.positions, mesh.triangles);
    pose.on_image = mesh.on_image;
    return pose;
}

std::vector<std::size_t> keys_of(const FaceMesh& mesh, const MeshFilm& film, double tolerance) {
    std::vector<float> numbers;
    numbers.reserve(3 * film.frames() * mesh.vertices.size());
    for (std::size_t frame = 0; frame < film.frames(); ++frame)
        for (const auto i : mesh.vertices)
            for (const double c : film.position(frame, i).component) numbers.push_back(float(c));
    // A vertex whose three coordinates are half the tolerance off is 0.87 of it off.
    return linear_keys(numbers, std::vector<float>(3 * mesh.vertices.size(), float(tolerance / 2)));
}

} // namespace sinew::files
