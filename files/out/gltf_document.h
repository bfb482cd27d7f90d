#pragma once

#include "sinew/math/color.h"
#include "sinew/math/vec.h"
#include "sinew/scene/image.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew::files {

/// Corners of triangles with a position and a normal each, and a place on an image where there are images.
struct TriangleMesh {
    std::vector<Vec3<float>> positions, normals;
    std::vector<Vec2<float>> on_image;
    std::vector<std::uint32_t> indices;
};

struct JointSkin;

/// A glTF 2.0 document with one scene, one animation and one buffer, as a .glb file. Functions return the index of what
/// they add.
class GltfDocument {
  public:
    /// `fps`: frames per second of all animations.
    explicit GltfDocument(double fps);
    GltfDocument(const GltfDocument&) = delete;
    GltfDocument& operator=(const GltfDocument&) = delete;
    ~GltfDocument();

    /// An image for materials; one that repeats does so from left to right.
    int add_texture(const Image& image, bool repeats);
    /// With a texture, transparent where the image is less than half opaque.
    int add_material(const std::string& name, const Color& color, std::optional<int> texture = {});

    /// A part of a mesh in one material: indices into the mesh's vertices.
    struct Part {
        int material = 0;
        std::vector<std::uint32_t> indices;
        bool has_texture = false;
    };
    /// Displacements of a mesh's vertices and normals.
    struct Target {
        std::vector<Vec3<float>> positions, normals;
    };
    int add_mesh(const std::string& name, const TriangleMesh& vertices, std::span<const Part> parts,
                 std::span<const Target> targets = {});

    /// A node below another; -1: at the root. Mesh -1: none.
    int add_node(const std::string& name, int parent, int mesh = -1);
    void place(int node, const Vec3<double>& translation, const Vec<4, double>& rotation, const Vec3<double>& scale);

    using Frames = std::vector<std::size_t>;
    /// Animates "translation", "rotation" or "scale" of a node: as many numbers at each key as the path has.
    void animate(int node, const std::string& path, const Frames& keys, std::span<const float> numbers);
    /// Animates the weights of a node whose mesh has a target for each key but the first: one at a time. The weights
    /// take room as the keys, not as their square: they are zeros but for a list of ones.
    void animate_targets(int node, const Frames& keys);

    /// Skins the mesh of a node at the root to joints, which are nodes at their first frame without a rotation.
    void add_skin(int node, std::span<const int> joints, const JointSkin& skin);

    std::size_t bytes() const { return binary_.size(); }
    /// The finished file.
    std::string glb();

  private:
    /// Accessor of the moments of keys, seconds; made once.
    int times_of(const Frames& keys);
    void add_channel(int node, const std::string& path, const Frames& keys, int output);
    int add_accessor(std::span<const float> numbers, int components, int target, bool bounds);
    int add_indices(std::span<const std::uint32_t> indices);
    int add_view(std::span<const std::byte> bytes, int target);
    int add_vectors(std::span<const Vec3<float>> vectors, bool bounds);
    int add_places(std::span<const Vec2<float>> on_image);

    std::unique_ptr<nlohmann::json> root_;
    std::string binary_;
    const double fps_;
    std::map<Frames, int> times_; ///< accessors
};

} // namespace sinew::files
