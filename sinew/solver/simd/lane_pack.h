#pragma once

/// Blocks side by side in the lanes of packs, a block to a lane.
namespace sinew {

/// Most blocks side by side.
inline constexpr int max_block_lanes = 8;
/// Lanes for a block by itself. A small module has no kernels of one lane beside those of two.
#if defined(SINEW_SMALL)
inline constexpr int min_block_lanes = 2;
#else
inline constexpr int min_block_lanes = 1;
#endif

/// A substep of several blocks of equal structure. Numbers by lane; unused lanes have `active` 0.
template <int D> struct LanePack {
    struct alignas(64) Numbers {
        double lane[max_block_lanes] = {};
    };
    int width = 1;      ///< lanes of the kernel
    double longest = 0; ///< length of an undivided substep, s

    Numbers active;          ///< 1 or 0
    Numbers fresh;           ///< 1: lengths and velocities at the start are to be examined
    Numbers shortest;        ///< 1: the substep is not to be divided any further
    Numbers h;               ///< length of the substep, s
    Numbers keep, yield;     ///< factors of drag (math/decay.h)
    Numbers acceleration[D]; ///< acceleration times `yield`, m/s^2
    Numbers total;           ///< mass, kg
    Numbers total_length;    ///< total length, m
    Numbers weight_length;   ///< weight times total length, J

    Numbers low[D], high[D]; ///< room in which the nodes meet nothing, m

    /// Results.
    Numbers good;  ///< 1: the block has moved on by h; otherwise it is as before
    Numbers alien; ///< 1: a substep that needs more than shorter substeps: slack, stretched, struck, or at a limit
    Numbers lost;  ///< energy lost, times `yield`, J
};

} // namespace sinew
