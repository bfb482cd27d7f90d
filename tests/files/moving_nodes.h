#pragma once

#include "sinew/collide/pose.h"

#include "tests/files/glb_file.h"

#include <vector>

/// Nodes of a .glb at a second, as a viewer places them.
namespace sinew::test {

struct NodePose {
    Vec3<double> at{};
    collide::Rotation<3, double> turn{};

    Vec3<double> operator()(const Vec3<double>& p) const { return at + turn * p; }
    NodePose operator()(const NodePose& inner) const { return {(*this)(inner.at), (turn * inner.turn).normalized()}; }
};

inline std::vector<float> numbers_of(const GlbFile& file, std::size_t node, const char* path, float second,
                                     std::vector<float> usual) {
    const auto& json = file.json["nodes"][node];
    const auto curve = file.json.contains("animations") ? file.curve(json["name"], path) : GlbFile::Curve();
    if (!curve.seconds.empty()) return curve.at(second);
    return json.value(path, std::move(usual));
}

/// Pose of a node below the node above. Scales are 1.
inline NodePose local_pose(const GlbFile& file, std::size_t node, float second) {
    const auto t = numbers_of(file, node, "translation", second, {0, 0, 0});
    const auto q = numbers_of(file, node, "rotation", second, {0, 0, 0, 1});
    const collide::Rotation<3, double> turn{{{double(q[0]), double(q[1]), double(q[2]), double(q[3])}}};
    return {{{double(t[0]), double(t[1]), double(t[2])}}, turn.normalized()};
}

/// Pose of a node in the world.
inline NodePose world_pose(const GlbFile& file, std::size_t node, float second) {
    const auto& nodes = file.json["nodes"];
    const auto here = local_pose(file, node, second);
    for (std::size_t above = 0; above < nodes.size(); ++above)
        for (const auto& child : nodes[above].value("children", std::vector<std::size_t>()))
            if (child == node) return world_pose(file, above, second)(here);
    return here;
}

} // namespace sinew::test
