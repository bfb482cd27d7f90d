#pragma once

#include "files/out/face_mesh.h"
#include "files/out/node_motion.h"

#include <array>
#include <cstdint>

namespace sinew::files {

/// A mesh that follows joints, each by a rigid motion.
struct JointSkin {
    static constexpr std::size_t influences = 4; ///< joints of a vertex: as many as every engine has

    struct Vertex {
        std::array<std::uint16_t, influences> joints{};
        std::array<float, influences> weights{}; ///< their sum is 1
    };
    std::vector<Vertex> vertices;   ///< of the mesh
    std::vector<NodeMotion> joints; ///< motion of each, without scales; at the first frame without a rotation
    double error = 0, mean = 0;     ///< metres: largest and mean distance of a vertex from its place, over all frames
};

/// Joints evenly over the mesh, each moving as the vertices nearest to it; weights are those that bring vertices
/// nearest to their places over all frames (as James and Twigg 2005, over the four nearest joints).
JointSkin joint_skin(const FaceMesh& mesh, const MeshFilm& film, std::size_t joints);

} // namespace sinew::files
