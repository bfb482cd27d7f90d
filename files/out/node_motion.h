#pragma once

#include "files/out/gltf_document.h"

namespace sinew::files {

/// Translations, rotations and scales of a node: of all frames, or of the one that it keeps. No scales: 1.
struct NodeMotion {
    std::vector<Vec3<double>> translation, scale;
    std::vector<Vec<4, double>> rotation;
};

/// Places a node at the first frame and animates what moves. `tolerance`: largest distance, in metres, of a point from
/// its place between keys, for points up to `reach` metres from the node's origin.
void animate(GltfDocument& document, int node, const NodeMotion& motion, double tolerance, double reach);

} // namespace sinew::files
