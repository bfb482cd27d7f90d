#pragma once

#include "files/out/gltf_document.h"
#include "files/out/mesh_film.h"

namespace sinew::files {

/// Faces of a film as one mesh of triangles.
struct FaceMesh {
    std::vector<std::uint32_t> vertices;   ///< of the film, in order
    std::vector<std::uint32_t> triangles;  ///< corners, as indices into `vertices`
    std::vector<GltfDocument::Part> parts; ///< the same by material
    std::vector<Vec2<float>> on_image;     ///< of each vertex, where parts have a texture; else empty
};

/// Vertices of elements, each once, in order.
std::vector<std::uint32_t> vertices_of(const MeshFilm& film, std::span<const MeshElement> elements);

/// `materials`: by group of the film's form.
FaceMesh face_mesh(const MeshFilm& film, std::span<const MeshElement> faces, std::span<const int> materials);

/// The mesh at a frame, about a point.
TriangleMesh posed(const FaceMesh& mesh, const MeshFilm& film, std::size_t frame, const Vec3<double>& about = {});

/// Frames between which the mesh moves in straight lines, up to `tolerance` metres; one if it stays as it is.
std::vector<std::size_t> keys_of(const FaceMesh& mesh, const MeshFilm& film, double tolerance);

} // namespace sinew::files
