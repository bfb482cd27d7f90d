#pragma once

#include "bench/cases.h"
#include "bench/simulation.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Speed and accuracy of a solver on a case. Times are of whole steps: force fields, integration, constraints,
/// velocities.
namespace sinew::bench {

struct Timing {
    double milliseconds = 0;  ///< median of a step, without the first step of each turn
    double percentile_99 = 0; ///< of all steps: 99 of 100 take no longer, ms
    double worst = 0;         ///< longest of all steps, ms
    double ratio = 0;         ///< speed as a multiple of the pace's: median over turns; 0 without a pace
    int steps = 0;            ///< number of steps taken
    Strain strain;            ///< max after any step, mean after the last
};

/// Progress callback; share of the work done, 0 to 1.
using Watch = std::function<void(double share)>;

/// Length of a run: ends at whichever limit comes first.
struct Extent {
    int steps = 0;
    double seconds = 1e9; ///< no further step begins afterwards
};
/// The least of the values that `share` of them do not exceed (the nearest rank); 0 of none.
double percentile(std::vector<double> values, double share);

/// Times a simulation. A pace (usually the textbook) alternates with the simulation, in turns of about 30 and 100 ms:
/// changes of the processor's clock then affect both. Positions are not read while timing, which would evict caches and
/// let threads fall asleep.
Timing time(Simulation& simulation, const Extent& extent, const Watch& watch = {}, Simulation* pace = nullptr);

/// Measures the strain of sticks over `steps` steps.
Strain look_at(Simulation& simulation, const Work& work, int steps, const Watch& watch = {});

/// Timing and strain, from two simulations made alike.
using Make = std::function<std::unique_ptr<Simulation>()>;
Timing time_and_look(const Make& make, const Work& work, const Extent& extent, const Watch& watch = {},
                     Simulation* pace = nullptr);

/// Configuration of the engine.
struct Engine {
    int threads = 1;
    bool single = true; ///< true: float, false: double
};

struct Measured : Timing {
    double build_ms = 0;             ///< from an empty world to one ready to step
    double prepare_ms = 0;           ///< part of build_ms: orders, colours, runs, blocks
    double bytes_per_constraint = 0; ///< peak memory above the particles and a small world; 0: unknown
};

/// A case in solver-neutral form.
Work work_of(const Case& chosen);
/// Measures the engine on a case, of which `work` is the neutral form, in turns with the textbook.
Measured measure(const Case& chosen, const Work& work, const Engine& engine, int steps, const Watch& watch = {});

/// Default number of steps, 3 to 300: enough for a median, and for small cloth to hang.
int usual_steps(const Work& work);

/// The engine as a contender.
std::unique_ptr<Simulation> simulate(const Case& chosen, const Engine& engine, const Effort& effort);

/// Instruction set of the engine's kernels on this processor: scalar, sse2, avx2, avx512, neon.
std::string_view simd();

} // namespace sinew::bench
