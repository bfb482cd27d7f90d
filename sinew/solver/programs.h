#pragma once

#include "sinew/solver/simd/program_pack.h"

#include <algorithm>
#include <cstdint>
#include <vector>

/// Programs of blocks: their structure, by which blocks of equal structure are solved side by side
/// (direct/step_programs.h).
namespace sinew {

/// The numbers of a program, one after the other: those of BlockProgram in the same order, tables included.
struct ProgramNumbers {
    std::uint32_t first = 0, size = 0; ///< range in Programs::numbers
    std::uint64_t hash = 0;
};

/// A block with a program, in the order in which such blocks are solved.
struct ProgramTurn {
    std::uint32_t block = 0;
    std::uint32_t group = 0; ///< equal for blocks of equal programs
};

/// Work space of a thread.
template <int D> struct ProgramSpace {
    static constexpr std::size_t line = 64 / sizeof(double);

    ProgramPack<D> pack;
    std::vector<double> numbers;
    std::vector<std::uint32_t> rows; ///< particles of the nodes of a pack

    void make_room(std::size_t block, std::size_t nodes) {
        const auto needed = block * max_block_lanes + line;
        if (numbers.size() < needed) numbers.resize(needed);
        rows.resize(std::max(rows.size(), nodes * max_block_lanes));
    }
    /// The numbers, from a cache line's start on.
    double* aligned() {
        const auto at = reinterpret_cast<std::uintptr_t>(numbers.data()) / sizeof(double);
        return numbers.data() + (line - at % line) % line;
    }
};

template <int D> struct Programs {
    /// Larger blocks are solved one by one: in lanes they would not stay in the cache.
    static constexpr std::uint32_t max_nodes = 64, max_entries = 4 * max_nodes, max_rows = 4 * max_nodes;

    std::vector<ProgramNumbers> list;
    std::vector<std::uint32_t> numbers;
    std::vector<ProgramTurn> turns;
    std::vector<ProgramSpace<D>> spaces;

    /// Reserves for every state that so many particles and constraints can reach by tearing.
    void reserve(std::size_t particles, std::size_t rows, std::size_t entries) {
        list.reserve(particles);
        turns.reserve(particles / 2 + 1);
        numbers.reserve(8 * particles + 8 * rows + 3 * entries);
    }
};

} // namespace sinew
