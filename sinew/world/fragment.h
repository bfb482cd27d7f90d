#pragma once

#include "sinew/math/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew {

/// Corner of a cut cell: a particle, or a virtual node which continues the cloth beyond the cut. A virtual node is at
///
///     a + at[0] (b - a) + at[1] (c - a) + at[2] n
///
/// with n the unit normal of (a, b, c). With two particles c - a is b - a turned by 90 degrees (2D); with one particle,
/// `at` is the offset from a in world axes.
struct VirtualNode {
    std::array<std::uint8_t, 3> of{}; ///< indices in the particles of the piece: a, b, c
    std::uint8_t count = 1;           ///< number of particles in `of`; 0: unbound, `at` is a world position
    Vec3<double> at{};

    bool is_particle() const { return count == 1 && at == Vec3<double>{}; }
};

/// Part of a cell of cloth left by a blade, by the virtual node algorithm (Molino, Bao and Fedkiw 2004): the cell keeps
/// four corners, virtual beyond the blade, and the remaining material is a polygon in (u, v).
struct Fragment {
    std::array<VirtualNode, 4> corners; ///< at (0, 0), (1, 0), (1, 1), (0, 1)
    std::vector<Vec2<float>> points;    ///< corners of the tiles in (u, v): convex polygons, concatenated
    std::vector<std::uint32_t> ends;    ///< for each tile, the number of points up to its last

    template <class Visit> void each_tile(Visit&& visit) const {
        std::uint32_t first = 0;
        for (const auto end : ends) {
            visit(std::span(points).subspan(first, end - first));
            first = end;
        }
    }
    void add_tile(std::span<const Vec2<float>> tile) {
        points.insert(points.end(), tile.begin(), tile.end());
        ends.push_back(std::uint32_t(points.size()));
    }
};

/// Position of a corner in 3D, where place(i) is the position of the piece's particle i.
template <class Position> Vec3<double> position_of(const VirtualNode& node, Position&& position, bool flat) {
    if (node.count == 0) return node.at;
    const Vec3<double> a = position(node.of[0]);
    if (node.count == 1) return a + node.at;
    const Vec3<double> b = position(node.of[1]) - a;
    if (node.count == 2) return a + b * node.at[0] + Vec3<double>{{-b[1], b[0], 0}} * node.at[1];
    const Vec3<double> c = position(node.of[2]) - a;
    const auto even = a + b * node.at[0] + c * node.at[1];
    return flat ? even : even + direction(cross(b, c)) * node.at[2];
}

} // namespace sinew
