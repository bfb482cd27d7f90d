#pragma once

#include "sinew/math/union_find.h"
#include "sinew/math/vec.h"
#include "sinew/world/figure.h"

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

namespace sinew::detail {

/// Edge of a solid: both ends, and the corners opposite to it in the triangles on either side. Numbers of particles.
struct SolidEdge {
    std::uint32_t a = 0, b = 0;
    std::array<std::uint32_t, 2> opposite{};
    std::uint32_t solid = 0;
};

/// Ranges of a solid in the lists of the room.
struct SolidParts {
    std::uint32_t first_face = 0, faces = 0;
    std::uint32_t first_corner = 0, corners = 0;
    std::uint32_t first_edge = 0, edges = 0;
    friend bool operator==(const SolidParts&, const SolidParts&) = default;
};

/// Solids in space: convex bodies within filled outlines on all sides.
struct PolyhedronRoom {
    static constexpr auto none = ~std::uint32_t(0);
    using Face = std::array<std::uint32_t, 3>;

    std::vector<SolidParts> solids;
    std::vector<double> half_width;     ///< per solid: from the middle to the nearest face, at the start of the step, m
    std::vector<Face> faces;            ///< triangles, counter-clockwise as seen from outside; numbers of particles
    std::vector<std::uint32_t> corners; ///< of each solid, ascending
    std::vector<SolidEdge> edges;
    std::vector<std::uint32_t> solid_of; ///< per particle, or none

    /// First corner of a solid.
    std::uint32_t lead(std::uint32_t solid) const { return corners[solids[solid].first_corner]; }

    // Scratch.
    struct Half {
        std::array<std::uint32_t, 2> ends{};
        std::uint32_t opposite = 0;
        friend constexpr auto operator<=>(const Half&, const Half&) = default;
    };
    struct Listed {
        std::uint32_t solid = 0; ///< first particle joined to the face
        Face face{};
        friend constexpr auto operator<=>(const Listed&, const Listed&) = default;
    };
    std::vector<Vec3<double>> place; ///< of corners, by number of the particle
    std::vector<Half> halves;
    std::vector<Listed> listed;
    UnionFind joined;

    void clear() { solids.clear(), half_width.clear(), faces.clear(), corners.clear(), edges.clear(), listed.clear(); }
};

} // namespace sinew::detail
