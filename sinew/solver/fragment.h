#pragma once

#include "sinew/math/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew {

/// A corner of a cut cell: a particle, or a virtual node that continues the cloth beyond the cut. The place of a
/// virtual node is at[0] (b - a) + at[1] (c - a) + at[2] n from its base a, with n the unit normal of (a, b, c). With
/// two particles c - a is b - a turned by a quarter (2D); with one, `at` is the way from a in the axes of the world.
struct VirtualNode {
    std::array<std::uint8_t, 3> of{}; ///< numbers among the particles of the piece: a, b, c
    std::uint8_t count = 1;           ///< particles it depends on; 0: not bound yet, `at` is its place
    Vec3<double> at{};

    bool is_particle() const { return count == 1 && at == Vec3<double>{}; }
};

/// A part of a cell of cloth that a blade left, in the manner of virtual nodes (Molino, Bao and Fedkiw 2004): the cell
/// keeps four corners, of which those beyond the blade are virtual, and a polygon in its (u, v) is what there is of it.
struct Fragment {
    std::array<VirtualNode, 4> corners; ///< at (0, 0), (1, 0), (1, 1), (0, 1)
    std::vector<Vec2<float>> points;    ///< (u, v) of the corners of its tiles, convex polygons one after the other
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

/// The place of a corner, where place(i) is that of the piece's particle number i, in space.
template <class Place> Vec3<double> place_of(const VirtualNode& node, Place&& place, bool flat) {
    if (node.count == 0) return node.at;
    const Vec3<double> a = place(node.of[0]);
    if (node.count == 1) return a + node.at;
    const Vec3<double> b = place(node.of[1]) - a;
    if (node.count == 2) return a + b * node.at[0] + Vec3<double>{{-b[1], b[0], 0}} * node.at[1];
    const Vec3<double> c = place(node.of[2]) - a;
    const auto even = a + b * node.at[0] + c * node.at[1];
    return flat ? even : even + direction(cross(b, c)) * node.at[2];
}

} // namespace sinew
