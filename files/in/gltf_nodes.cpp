#include "files/in/gltf_nodes.h"

#include "sinew/scene/text.h"

namespace sinew::files {

GltfNodes::GltfNodes(const JsonNode& root) : root_(root) {
    constexpr std::size_t most_nodes = 20'000;
    const auto nodes = root["nodes"], scenes = root["scenes"];
    if (nodes.size() > most_nodes) nodes.fail(concat("at most ", most_nodes, " nodes are read"));
    maps.resize(nodes.size()), parents.resize(nodes.size()), is_joint_.resize(nodes.size());
    const auto number = root["scene"].exists() ? root["scene"].index() : 0;
    if (const auto roots = scenes[number]["nodes"]; roots.exists())
        for (std::size_t i = 0; i < roots.size(); ++i) place(roots[i], {}, {}, 0);
    for (std::size_t i = 0; i < root["skins"].size(); ++i) find_skeleton(root["skins"][i]);
}

void GltfNodes::place(const JsonNode& index, const Affine3& outer, std::optional<std::size_t> parent,
                      std::size_t depth) {
    const auto i = index.index(), count = maps.size();
    if (i >= count) index.fail(concat("there are only ", count, " nodes"));
    constexpr std::size_t deepest = 256; // skeletons are deeper than scenes
    if (depth > deepest) index.fail(concat("nodes nest more than ", deepest, " deep"));
    if (maps[i]) index.fail(concat("node ", i, " has two parents, or is below itself"));
    const auto node = root_["nodes"][i];
    maps[i] = outer * GltfData::matrix_of(node);
    parents[i] = parent;
    order.push_back(i);
    const auto children = node["children"];
    for (std::size_t k = 0; k < children.size(); ++k) place(children[k], *maps[i], i, depth + 1);
}

/// Joints of a skin, each with the nearest joint above it. Skins of several meshes often share one skeleton.
void GltfNodes::find_skeleton(const JsonNode& skin) {
    const auto joints = skin["joints"];
    std::vector<std::optional<std::size_t>> numbers(maps.size());
    std::vector<bool> in_skin(maps.size());
    bool is_known = true;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const auto node = joints[i].index();
        if (node >= maps.size() || !maps[node]) joints[i].fail(concat("node ", node, " is not in the scene"));
        is_known = is_known && is_joint_[node];
        is_joint_[node] = in_skin[node] = true;
    }
    if (is_known) return;
    GltfSkeleton skeleton;
    for (const auto i : order) {
        if (!in_skin[i]) continue;
        const auto node = root_["nodes"][i];
        auto above = parents[i];
        while (above && !in_skin[*above]) above = parents[*above];
        numbers[i] = skeleton.joints.size();
        skeleton.nodes.push_back(i);
        skeleton.joints.push_back(
            {node["name"].text_or("joint"), node.place(), above ? numbers[*above] : std::nullopt, maps[i]->origin});
        check_point(maps[i]->origin, node);
    }
    skeletons.push_back(std::move(skeleton));
}

void check_point(const Vec3<double>& point, const JsonNode& of) {
    constexpr double furthest = 1e6;
    for (int i = 0; i < 3; ++i)
        if (!(absolute(point[i]) <= furthest)) of.fail(format_text("a coordinate is beyond {:6}", furthest));
}

} // namespace sinew::files
