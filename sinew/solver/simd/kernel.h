#pragma once

#include "sinew/math/limit.h"
#include "sinew/math/moments.h"
#include "sinew/solver/simd/chain_pack.h"
#include "sinew/solver/simd/link_pack.h"
#include "sinew/solver/simd/program_pack.h"
#include "sinew/world/world_types.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

/// SIMD kernels over many particles. Each function is compiled from the same text for every instruction set
/// (simd/targets/all.h) and selected at run time; all variants give the same bits.
namespace sinew {

/// Upper bound on 1 / length^2 of a limit, also used for a limit of zero.
template <class Real> inline constexpr Real max_per_square = Real(1e30);

/// Variants of most batches: rigid links of consecutive slots. Without suffix all links are alike, `_each` has limits
/// per link, `_uneven` has ends of unequal or zero mobility.
enum class LinkKind : unsigned char {
    other,
    equality,
    equality_each,
    equality_uneven,
    old_gradient, ///< equality, corrected along the links at the start of the substep
    old_gradient_each,
    old_gradient_uneven,
    inequality, ///< inequality: two limits
    inequality_each,
    inequality_uneven
};

/// Batch of simple distances solved together: between slots a and b, a + 1 and b + 1, ... Any 32 consecutive links (two
/// packs of 16) are disjoint.
struct LinkBatch {
    std::uint32_t a = 0, b = 0; ///< first slots in SweepState; scattered: a is an offset in the lists of ends
    std::uint32_t count = 0;
    std::uint32_t row = 0;      ///< first row in the table of distances; with row_step 0 an offset in the list of rows
    std::uint32_t row_step = 0; ///< from link to link; 0: rows are listed
    std::uint32_t parameters = 0; ///< index of the first low, high and compliance
    bool uniform = false;         ///< a single set of parameters
    bool compliant = false;       ///< some links are compliant
    bool equality = true;         ///< all links are equalities
    bool old_gradient = false;    ///< corrected along the links at the start of the substep
    bool equal_mass = true;       ///< both ends of every link have the same nonzero mobility
    bool scattered = false;
    LinkKind kind = LinkKind::other;
};

/// Columns of the particles (sweep_state.h) and of the plan (plan.h).
template <int D, class Real> struct DistanceColumns {
    const Real* position;
    Real* displacement;
    std::size_t stride; ///< numbers between the columns of two components
    const Real* mobility;
    const Real *low, *high;
    const Real* compliance;               ///< for batches with compliant links
    const Real* quarter_per_square;       ///< 1 / (4 low^2)
    const std::uint32_t *ends_a, *ends_b; ///< slots of scattered batches
    const std::uint32_t* rows;            ///< rows of batches with row_step 0
    Real* multiplier;                     ///< by row
};

template <class Real> struct DistancePass {
    Real per_h2 = 0;   ///< 1 / h^2
    Real shortest = 1; ///< output: a length below limit::shortest_link of a link with a positive limit, otherwise 1
    bool kept = false; ///< store multipliers, for later iterations or for readers
    bool last_substep = false; ///< last substep: multipliers are read after the step
    bool first = true;         ///< first iteration: multipliers start at zero
    bool adds = false;         ///< multipliers of rigid equalities add up, and links are corrected as in other substeps
    bool again = false;        ///< repair within an iteration: compliant batches are skipped
    Real overstretched_from = 1; ///< square of the length, as a multiple of the length allowed
    bool overstretched = false;  ///< output: some rigid link was longer than that
};

/// Anchor of long-range attachments: an upper limit on each particle's distance from a point.
template <int D, class Real> struct Anchor {
    Real opposite[D];                       ///< anchor position, negated
    const Real* half_per_max_length_square; ///< 1 / (2 max_length^2) by slot; 0: unlimited
};

/// Motion of particles independently of each other, in a substep.
template <int D, class Real> struct Motion {
    Real *position, *displacement, *residual;
    std::size_t stride; ///< numbers between the columns of two components
    const Real* mobility;
    const Anchor<D, Real>* anchors = nullptr;
    std::uint32_t anchor_count = 0;
    Real max = 0;      ///< largest displacement
    Real furthest = 0; ///< largest coordinate
    Real add[D];       ///< added to each displacement
    Real keep = 1;     ///< factor of the displacement, applied before `add`
};

/// Transposition between vectors by row and columns of components by slot.
template <int D, class Real> struct Transposition {
    Real* rows; ///< D numbers each
    Real* columns;
    std::size_t stride;          ///< numbers between the columns of two components
    const std::uint32_t* row_of; ///< by slot
    std::uint32_t slot_of_last;  ///< slot of the last row, whose load must not pass the end
    Real by = 1;                 ///< factor applied to every number
    Real max = 0;                ///< bound on stored numbers; 0: copies, without factor or bound
};

/// Particles of one body.
template <int D, class Real> struct BodyColumns {
    const Real* position;
    Real* displacement;
    std::size_t stride; ///< numbers between the columns of two components
    const Real* mobility;
    const std::uint32_t* slots; ///< null: `count` slots from `first` on
    std::uint32_t first, count;
    Vec<D, double> origin, drift; ///< subtracted from each place and displacement
};

/// Rotation added to the motion of a body, and the share by which the rest of the motion is slowed down.
template <int D, class Real> struct BodyTurn {
    Vec<spins<D>, double> rate;   ///< radians
    Vec<D, double> center, drift; ///< drift: mean displacement
    double loss;                  ///< 0..1
    Real max;                     ///< largest displacement
};

/// Nodes of blocks in the lanes of packs, and the particles that they stand for. A record of a node begins with D
/// numbers of the position, D of the velocity, and the mass.
template <int D, class Real> struct NodeExchange {
    double* nodes = nullptr;
    std::size_t numbers = 0;             ///< of a record and lane
    std::uint32_t count = 0;             ///< nodes
    int width = 1;                       ///< lanes
    const std::uint32_t* rows = nullptr; ///< particle of each node, one for each lane in a row
    bool has_last_row = false;           ///< some lane has the last particle, whose load must not pass the end
    Real *position = nullptr, *residual = nullptr, *velocity = nullptr; ///< D numbers a particle
    const Real* inverse_mass = nullptr;
};

/// Pairs of a particle and a segment, by slots; a and b are the same for a particle.
template <int D, class Real> struct PairColumns {
    const Real *position, *displacement;
    std::size_t stride; ///< numbers between the columns of two components
    const Real* mobility;
    const std::uint32_t *p, *a, *b;
    const Real* size; ///< distance at which the pair may touch, without the approach
};
/// Pair that may touch in a substep.
template <int D, class Real> struct NearSegment {
    std::uint32_t pair = 0;
    Real t = 0;          ///< parameter of the nearest point on the segment, 0..1
    Real distance = 0;   ///< metres
    Real normal[D] = {}; ///< from there to the particle; 0 at a distance of 0
    Real left = 0;       ///< in the plane: positive where the particle is to the left of a-b
    Real response = 0;   ///< of the gap, 1 / kg
    Real approach = 0;   ///< in the substep, metres
};

/// Kernel over the particles in slots [first, last).
template <int D, class Real> using Moving = void (*)(const Motion<D, Real>&, std::uint32_t first, std::uint32_t last);

template <int D, class Real> struct Kernels {
    /// Solves a range of batches in order.
    void (*project)(const DistanceColumns<D, Real>&, DistancePass<Real>&, const LinkBatch* first,
                    const LinkBatch* last);
    /// Pulls particles back within reach of the anchors.
    Moving<D, Real> tether;
    /// place <- place + move, the rounding error kept in the residual (Kahan 1965).
    Moving<D, Real> advance;
    /// move <- keep move + add for movable particles, 0 for others.
    Moving<D, Real> drift;
    /// `advance`, then `drift`.
    Moving<D, Real> go_on;
    /// Minimum of normal . (place + move).
    Real (*lowest)(const Motion<D, Real>&, const Real* normal, std::uint32_t first, std::uint32_t last);
    /// Moments of a body; immovable particles weigh infinitely much.
    void (*moments)(const BodyColumns<D, Real>&, Moments<D>&);
    void (*turn)(const BodyColumns<D, Real>&, const BodyTurn<D, Real>&);
    /// Transposes slots [first, last).
    void (*to_columns)(const Transposition<D, Real>&, std::uint32_t first, std::uint32_t last);
    void (*to_rows)(const Transposition<D, Real>&, std::uint32_t first, std::uint32_t last);
    /// True if all numbers are within [-limit, limit], or [0, limit]; NaN is not.
    bool (*all_within)(const Real* numbers, std::size_t count, Real limit);
    bool (*all_within_and_positive)(const Real* numbers, std::size_t count, Real limit);
    /// Particles to nodes and back, in lanes [first, last).
    void (*load_nodes)(const NodeExchange<D, Real>&, int first, int last);
    void (*store_nodes)(const NodeExchange<D, Real>&, int first, int last);
    /// Moves chains or other blocks on by a substep: as many side by side as there are lanes, or a single one.
    int block_lanes;
    void (*swing_chains)(ChainPack<D>&);
    void (*swing_chain)(ChainPack<D>&);
    void (*swing_programs)(ProgramPack<D>&);
    void (*swing_program)(ProgramPack<D>&);
    LinkKernels<D, Real> links;
    /// Writes those pairs in [first, last) that may touch in a substep; returns how many.
    std::uint32_t (*near_pairs)(const PairColumns<D, Real>&, std::uint32_t first, std::uint32_t last,
                                NearSegment<D, Real>* to);
};

/// Kernels of an instruction set.
template <class... Each> struct AllKernels : Each... {};
using KernelSet = EveryWorld<AllKernels, Kernels>;

enum class Simd { one, sse2, avx2, avx512 };

/// True if both the processor and the build support the instruction set.
bool has_simd(Simd simd);
/// False if the processor has none of the instruction sets of the build: the program cannot step.
bool has_any_simd();
/// The widest instruction set that both support.
Simd best_simd();
/// one; sse2, neon or simd128; avx2; avx512.
const char* name_of(Simd simd);
/// The instruction set of a name, if it is supported.
std::optional<Simd> simd_called(std::string_view name);

/// Kernels of an instruction set; of the best one instead of one that is not supported. Results are the same bits.
template <int D, class Real> const Kernels<D, Real>& kernels(Simd simd);

} // namespace sinew
