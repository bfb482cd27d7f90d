#pragma once

#include "sinew/solver/simd/lane_pack.h"

#include <cstddef>
#include <cstdint>

/// Small sparse blocks of equal structure side by side in the lanes of packs: trees, and figures with few loops.
namespace sinew {

/// The structure of a block: which nodes its rows join, and the program of its elimination (direct/matrices.h). Blocks
/// of the same numbers are solved side by side. Nodes, entries and rows are numbered from 0; immovable nodes come last.
struct BlockProgram {
    /// A rigid distance, and the entry that couples the ends.
    struct Link {
        std::uint32_t a, b, entry, pulls_only;
    };
    /// A flat square, held in its plane (direct/flat_squares.h), and the entries of the pairs 0 1, 0 2, 0 3, 1 2, 1 3,
    /// 2 3.
    struct Plane {
        std::uint32_t nodes[4], entries[6];
    };
    /// A distance that limits a joint's range.
    struct Range {
        std::uint32_t a, b;
    };
    /// A volume that limits a joint's range.
    struct Fold {
        std::uint32_t nodes[4];
    };
    static constexpr std::uint32_t none = ~std::uint32_t(0);

    std::uint32_t unknowns = 0, nodes = 0, entries = 0;
    std::uint32_t links = 0, planes = 0, ranges = 0, folds = 0;
    const Link* link = nullptr;
    const Plane* plane = nullptr;
    const Range* range = nullptr;
    const Fold* fold = nullptr;
    const std::uint32_t* first_entry = nullptr; ///< of each unknown; one element more than unknowns
    const std::uint32_t* entry_node = nullptr;  ///< later node of each entry
    const std::uint32_t* pairs = nullptr;       ///< entry that receives the product of a pair, in order
};

/// A node. V is a pack, with one number for each block.
template <int D, class V> struct ProgramNode {
    V start[D];    ///< position at the start of the substep, m
    V velocity[D]; ///< at the start of the substep, drag included, m/s
    V mass;        ///< kg

    // Work space of a substep.
    V position[D], predicted[D]; ///< position in this iteration, and without constraints, m
    V after[D];                  ///< velocity at the end of the substep, m/s
    V diagonal[D * D];           ///< of the matrix; its inverse after the elimination, kg
    V residual[D];               ///< kg m
    V displacement[D];           ///< Newton step, m
};

/// A rigid distance.
template <int D, class V> struct ProgramLink {
    V length2, per_length2; ///< squared length, m^2, and its inverse
    V tension;              ///< multiplier of (length^2 - limit^2) / 2 at the start of the substep, N/m

    V stiffness;         ///< penalty, kg/m^2
    V begun[D], span[D]; ///< at the start of the substep, and in this iteration, m
    V pull, next;        ///< multiplier in this iteration and the next, kg/m^2
};

/// A flat square: volume zero.
template <int D, class V> struct ProgramPlane {
    V per_unit; ///< 1 / volume that counts as 1, 1/m^3
    V tension;  ///< multiplier of the volume over its unit, at the start of the substep, N m

    V begun, volume; ///< over the unit, at the start of the substep and in this iteration
    V pull, next, stiffness;
    V gradient[4][D];
};

/// Limits of a squared distance, m^2, or of a volume, m^3; the block is at a limit outside of them,
/// or while the limit has a tension.
template <class V> struct ProgramLimit {
    V low, high;
    V per_unit; ///< 1 / excess that counts as 1
    V tension;
};

/// Coupling of a node with a later one.
template <int D, class V> struct ProgramEntry { V lower[D * D], upper[D * D]; };

/// A substep of several blocks of one program.
template <int D> struct ProgramPack : LanePack<D> {
    BlockProgram program;
    bool is_free = false; ///< no immovable node holds the blocks

    // Packs of `width`.
    double* nodes = nullptr;   ///< ProgramNode
    double* links = nullptr;   ///< ProgramLink
    double* planes = nullptr;  ///< ProgramPlane
    double* limits = nullptr;  ///< ProgramLimit of the ranges, then of the folds
    double* entries = nullptr; ///< ProgramEntry

    /// Numbers of one block.
    static std::size_t size_of(const BlockProgram& program) {
        return (program.nodes * sizeof(ProgramNode<D, double>) + program.links * sizeof(ProgramLink<D, double>) +
                program.planes * sizeof(ProgramPlane<D, double>) +
                (program.ranges + program.folds) * sizeof(ProgramLimit<double>) +
                program.entries * sizeof(ProgramEntry<D, double>)) /
               sizeof(double);
    }
    /// Lays the tables out one after the other, in room for size_of(program) packs.
    void lay_out(double* room) {
        const auto take = [&](std::size_t bytes, std::size_t count) {
            double* const first = room;
            room += bytes / sizeof(double) * count * std::size_t(this->width);
            return first;
        };
        nodes = take(sizeof(ProgramNode<D, double>), program.nodes);
        links = take(sizeof(ProgramLink<D, double>), program.links);
        planes = take(sizeof(ProgramPlane<D, double>), program.planes);
        limits = take(sizeof(ProgramLimit<double>), program.ranges + program.folds);
        entries = take(sizeof(ProgramEntry<D, double>), program.entries);
    }
};

} // namespace sinew
