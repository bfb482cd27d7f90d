#pragma once

#include "sinew/math/color.h"
#include "sinew/session/session.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew::files {

/// Elements of one part of a figure, in one colour or wearing one image.
struct MeshGroup {
    std::string figure, part;
    Color color;
    std::optional<std::uint32_t> image{}; ///< of faces, index in SceneMesh::images
    bool repeats = false;                 ///< the image, from left to right
    friend bool operator==(const MeshGroup&, const MeshGroup&) = default;
};

enum class ElementKind : std::uint8_t {
    face, ///< a polygon, three corners or more
    line, ///< a line through its corners
    ring, ///< a long ring around two corners: a link of a chain
    ball  ///< a sphere at one corner; a disc in 2D
};

struct MeshElement {
    ElementKind kind = ElementKind::face;
    std::uint32_t first = 0, count = 0; ///< in SceneMesh::corners
    std::uint32_t group = 0;
    double width = 0;        ///< metres: of a line or ring, diameter of a ball
    double end_width = 0;    ///< of a line, at its last corner
    double image_length = 0; ///< metres: of a line whose group has an image, which repeats along it
    friend bool operator==(const MeshElement&, const MeshElement&) = default;
};

/// The drawn pieces of a session's figures at a moment, as a model. Vertices are the particles of the figures in the
/// order of construction, as far as elements use them, followed by computed points: of limbs along Bezier curves, of
/// worn images, and of cut cloth. Positions in metres, y upwards.
struct SceneMesh {
    std::vector<Vec3<double>> vertices;
    std::vector<std::uint32_t> corners;
    std::vector<MeshElement> elements;
    std::vector<MeshGroup> groups;
    std::vector<Vec2<float>> on_image; ///< of each vertex, its place on the image of its face; empty without images
    Images images{};                   ///< of the scene
    std::vector<std::string> bare{};   ///< figures in space with images that face the viewer, which stay behind
    std::vector<Vec<4, double>> turns; ///< of each vertex that is a particle, a unit quaternion; empty if none rolls
    bool flat = false;                 ///< of a 2D scene

    std::span<const std::uint32_t> corners_of(const MeshElement& element) const {
        return std::span(corners).subspan(element.first, element.count);
    }
    const MeshGroup& group_of(const MeshElement& element) const { return groups[element.group]; }
    /// True if the other mesh differs at most in positions and turns.
    bool has_form_of(const SceneMesh& other) const {
        return vertices.size() == other.vertices.size() && corners == other.corners && elements == other.elements &&
               groups == other.groups;
    }
};

struct MeshContent {
    std::vector<std::string> figures; ///< names; empty: all
    bool balls = false;               ///< rings and balls too, which a file of faces and lines cannot hold
    bool images = false;              ///< worn images as faces
};

SceneMesh mesh_of(const Session& session, const MeshContent& content);

} // namespace sinew::files
