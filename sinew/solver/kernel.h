#pragma once

#include <cstddef>
#include <cstdint>

/// What is done to many particles at once. Each function is compiled once for each kind of processor from the same text
/// (kernel_text.h), and which is used is chosen when the program runs; all give the same bits.
namespace sinew {

/// The most that 1 / length^2 of a limit counts for, also where that is no length at all.
template <class Real> inline constexpr Real most_per_square = Real(1e30);

/// What most runs are: rigid, and side by side. All links are alike, or each has its own limits; or, uneven, not all
/// particles move as readily as those they are linked to.
enum class LinkKind : unsigned char {
    other,
    exact,
    exact_each,
    exact_uneven,
    swinging, ///< exact, and corrected along the links as they were when the substep began
    swinging_each,
    swinging_uneven,
    ranging, ///< between two limits
    ranging_each,
    ranging_uneven
};

/// Plain distances that are solved one after the other: of particles a and b, a + 1 and b + 1, ... Within any 16
/// consecutive ones, and the 16 after them, no particle comes twice.
struct LinkRun {
    std::uint32_t a = 0, b = 0; ///< slots of Swept; where scattered, a is where in the list of ends it begins
    std::uint32_t count = 0;
    std::uint32_t row = 0;        ///< of the table of distances; without a step, where in the list of rows it begins
    std::uint32_t row_step = 0;   ///< from one to the next; 0: as they are listed
    std::uint32_t parameters = 0; ///< of low, high and compliance
    bool uniform = false;         ///< one set of parameters for all
    bool soft = false;            ///< some have compliance
    bool exact = true;            ///< each has but one limit
    bool swings = false;          ///< corrected along the links as they were when the substep began
    bool even = true;             ///< both ends of each move as readily, and can
    bool scattered = false;
    LinkKind kind = LinkKind::other;
};

/// The columns of the particles (swept.h), and of the plan (plan.h).
template <int D, class Real> struct LinkColumns {
    const Real* place;
    Real* move;
    std::size_t apart; ///< from one component to the next
    const Real* mobility;
    const Real *low, *high;
    const Real* compliance;               ///< of runs of which some have any
    const Real* quarter_per_square;       ///< 1 / 4 low^2
    const std::uint32_t *ends_a, *ends_b; ///< of scattered ones
    const std::uint32_t* rows;            ///< of runs without a step
    Real* multiplier;                     ///< by row
};

template <class Real> struct LinkPass {
    Real per_h2 = 0;       ///< 1 / h^2
    Real shortest = 1;     ///< found: no length that should be some was less
    bool kept = false;     ///< multipliers are wanted, after the substep or in its later iterations
    bool told = false;     ///< after it
    bool first = true;     ///< they begin at zero
    bool again = false;    ///< of this iteration: what has compliance has given way
    bool strained = false; ///< found: a link without was much too long
};

/// Where particles are tied to: each no further from it than it reaches.
template <int D, class Real> struct Anchor {
    Real opposite[D];                  ///< of its place: what added to another gives the way to that
    const Real* half_per_reach_square; ///< 1 / 2 reach^2, by slot
};

/// What a substep does to each particle by itself.
template <int D, class Real> struct Motion {
    Real *place, *move, *residual;
    std::size_t apart; ///< from one component to the next
    const Real* mobility;
    const Anchor<D, Real>* anchors = nullptr;
    std::uint32_t anchor_count = 0;
    Real most = 0;     ///< a move may be
    Real furthest = 0; ///< a particle may be
    Real add[D];       ///< to each move
    Real keep = 1;     ///< of it, before
};

/// Vectors by row, and columns of their components by slot.
template <int D, class Real> struct Turning {
    Real* rows; ///< D numbers each
    Real* columns;
    std::size_t apart;           ///< from one component to the next
    const std::uint32_t* row_of; ///< by slot
    std::uint32_t slot_of_last;  ///< that holds the last row there is
    Real by = 1;                 ///< what numbers are multiplied by on their way
    Real most = 0;               ///< in columns they are at most so large; 0: there they are as in rows
};

/// Each of particles in slots [first, last).
template <int D, class Real> using Moving = void (*)(const Motion<D, Real>&, std::uint32_t first, std::uint32_t last);

template <int D, class Real> struct Kernels {
    /// Solves some runs one after the other.
    void (*project)(const LinkColumns<D, Real>&, LinkPass<Real>&, const LinkRun* first, const LinkRun* last);
    /// Pulls what is out of reach of an anchor back.
    Moving<D, Real> tether;
    /// place <- place + move, with what rounding takes kept in the residual (Kahan 1965).
    Moving<D, Real> advance;
    /// move <- keep move + add of what can move, 0 of the rest.
    Moving<D, Real> drift;
    /// Both, one after the other.
    Moving<D, Real> go_on;
    /// The least of normal . (place + move).
    Real (*lowest)(const Motion<D, Real>&, const Real* normal, std::uint32_t first, std::uint32_t last);
    /// Those of slots [first, last).
    void (*to_columns)(const Turning<D, Real>&, std::uint32_t first, std::uint32_t last);
    void (*to_rows)(const Turning<D, Real>&, std::uint32_t first, std::uint32_t last);
    /// Whether all numbers are within [-limit, limit], or [0, limit]; what is no number is not.
    bool (*all_within)(const Real* numbers, std::size_t count, Real limit);
    bool (*all_within_and_positive)(const Real* numbers, std::size_t count, Real limit);
};

/// Those of one kind of processor.
struct KernelSet {
    Kernels<2, float> in_2d_float;
    Kernels<2, double> in_2d_double;
    Kernels<3, float> in_3d_float;
    Kernels<3, double> in_3d_double;
};

enum class Simd { one, sse2, avx2, avx512 };

/// The best that this processor has; or what the environment's SINEW_SIMD says (one, sse2, avx2, avx512), if it has
/// that.
Simd best_simd();
/// Whether this processor, and this build, has it.
bool has_simd(Simd simd);
/// What is used from now on. For tests: it changes no bit.
void use_simd(Simd simd);
const char* name_of(Simd simd);
Simd simd_in_use();

template <int D, class Real> const Kernels<D, Real>& kernels();

} // namespace sinew
