#pragma once

#include <cstdint>

/// What is done to many particles at once. Each function is compiled once for each kind of processor from the same text
/// (kernel_text.h), and which is used is chosen when the program runs; all give the same bits.
namespace sinew {

/// Plain distances that are solved one after the other: of particles a and b, a + 1 and b + 1, ... Within any 16
/// consecutive ones, and the 16 after them, no particle comes twice.
struct LinkRun {
    std::uint32_t a = 0, b = 0; ///< slots of Swept; where scattered, a is where in the list of ends it begins
    std::uint32_t count = 0;
    std::uint32_t row = 0;        ///< of the table of distances; where scattered, see `ends`
    std::uint32_t row_step = 0;   ///< from one to the next
    std::uint32_t parameters = 0; ///< of low, high and compliance
    bool uniform = false;         ///< one set of parameters for all
    bool soft = false;            ///< some have compliance
    bool exact = true;            ///< each has but one limit
    bool swings = false;          ///< corrected along the links as they were when the substep began
    bool scattered = false;
};

/// The columns of the particles (swept.h), and of the plan (plan.h).
template <int D, class Real> struct LinkColumns {
    const Real* place[D];
    Real* move[D];
    const Real* mobility;
    const Real *low, *high, *compliance;
    const std::uint32_t *ends_a, *ends_b, *rows; ///< of scattered ones
    Real* multiplier;                            ///< by row
};

template <class Real> struct LinkPass {
    Real per_h2 = 0;   ///< 1 / h^2
    Real shortest = 1; ///< found: no length that should be some was less
    bool kept = false; ///< multipliers are wanted
    bool first = true; ///< they begin at zero
};

template <int D, class Real> struct Drift {
    Real* move[D];
    const Real* mobility;
    Real add[D]; ///< to each move
    Real keep;   ///< of it, before
    Real most;   ///< it may be
};

template <int D, class Real> struct Advance {
    Real *place[D], *move[D], *residual[D];
    Real most;     ///< a move may be
    Real furthest; ///< a particle may be
};

template <int D, class Real> struct Tethering {
    const Real* place[D];
    Real* move[D];
    const Real* mobility;
    const Real* reach; ///< by slot
    Real anchor[D];    ///< where it will be
};

template <int D, class Real> struct Kernels {
    /// Solves some runs one after the other.
    void (*project)(const LinkColumns<D, Real>&, LinkPass<Real>&, const LinkRun* first, const LinkRun* last);
    /// move <- keep move + add of what can move, 0 of the rest, for slots [first, last).
    void (*drift)(const Drift<D, Real>&, std::uint32_t first, std::uint32_t last);
    /// place <- place + move, with what rounding takes kept in the residual (Kahan 1965).
    void (*advance)(const Advance<D, Real>&, std::uint32_t first, std::uint32_t last);
    /// Pulls what is out of reach of the anchor back.
    void (*tether)(const Tethering<D, Real>&, std::uint32_t first, std::uint32_t last);
    /// The least of normal . (place + move).
    Real (*lowest)(const Advance<D, Real>&, const Real* normal, std::uint32_t first, std::uint32_t last);
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
