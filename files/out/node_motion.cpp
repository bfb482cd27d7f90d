#include "files/out/node_motion.h"

#include "sinew/math/scalar.h"

#include "files/out/linear_keys.h"

#include <algorithm>
#include <array>

namespace sinew::files {
namespace {

template <class VecT> bool varies(const std::vector<VecT>& vectors) {
    constexpr double least = 1e-7; // metres, or a part of a quaternion
    return std::ranges::any_of(vectors, [&](const VecT& v) { return norm(v - vectors.front()) > least; });
}

/// Animates a path with keys where each component is at most `tolerance` off.
template <int N>
void animate_path(GltfDocument& document, int node, const char* path, const std::vector<Vec<N, double>>& vectors,
                  double tolerance) {
    if (vectors.empty() || !varies(vectors)) return;
    std::vector<float> numbers, kept;
    for (const auto& v : vectors)
        for (const double c : v.component) numbers.push_back(float(c));
    std::array<float, N> tolerances{};
    tolerances.fill(float(tolerance));
    const auto keys = linear_keys(numbers, tolerances);
    for (const auto key : keys) kept.insert(kept.end(), &numbers[key * N], &numbers[key * N] + N);
    document.animate(node, path, keys, kept);
}

} // namespace

void animate(GltfDocument& document, int node, const NodeMotion& motion, double tolerance, double reach) {
    document.place(node, motion.translation[0], motion.rotation[0],
                   motion.scale.empty() ? Vec3<double>{{1, 1, 1}} : motion.scale[0]);
    // Shares of the tolerance: three components of a translation that are a quarter off, 0.43; a quaternion whose four
    // components are e off is 2 e, and its angle 4 e, 0.5; lengths 0.06.
    const double extent = max(reach, 1e-9);
    animate_path(document, node, "translation", motion.translation, tolerance / 4);
    animate_path(document, node, "rotation", motion.rotation, tolerance / (8 * extent));
    animate_path(document, node, "scale", motion.scale, tolerance / (16 * extent));
}

} // namespace sinew::files
