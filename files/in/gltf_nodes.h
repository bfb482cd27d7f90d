#pragma once

#include "files/in/gltf_data.h"
#include "files/in/skeleton.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace sinew::files {

/// A skeleton of a file, and the node of each joint.
struct GltfSkeleton {
    std::vector<SkeletonJoint> joints;
    std::vector<std::size_t> nodes;
};

/// Nodes of a glTF file's scene and the skeletons of its skins.
struct GltfNodes {
    /// Throws ImportError for nodes that nest too deep, or are below themselves.
    explicit GltfNodes(const JsonNode& root);

    std::vector<std::optional<Affine3>> maps;        ///< of nodes in the scene, to the world
    std::vector<std::optional<std::size_t>> parents; ///< by node
    std::vector<std::size_t> order;                  ///< of nodes, parents first
    std::vector<GltfSkeleton> skeletons;

  private:
    const JsonNode& root_;
    std::vector<bool> is_joint_;

    void place(const JsonNode& index, const Affine3& outer, std::optional<std::size_t> parent, std::size_t depth);
    void find_skeleton(const JsonNode& skin);
};

/// Refuses a point of a node or a mesh beyond a million.
void check_point(const Vec3<double>& point, const JsonNode& of);

} // namespace sinew::files
