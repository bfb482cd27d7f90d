#pragma once

#include "bench/cases.h"
#include "bench/simulation.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// How fast and how well a case is solved. Times are of whole steps: fields, integration, constraints, velocities.
namespace sinew::bench {

struct Timing {
    double milliseconds = 0; ///< median of a step, the first of each turn not among them
    double ratio = 0;        ///< how many times the speed of the pace that is: median of all turns; 0: there is none
    int steps = 0;           ///< that were taken
    Strain strain;           ///< max after any step, mean after the last
};

/// Called as often as something is done, with how much of all there is: 0 to 1.
using Watch = std::function<void(double share)>;

/// How long a simulation is run.
struct Extent {
    int steps = 0;
    double seconds = 1e9; ///< after them no further step begins
};
/// With a pace (the textbook, for one) they step by turns, some steps each, at most a tenth of a second: the clock of a
/// processor changes under way, and so it does for both. Nobody looks at what they do: that would take their caches,
/// and let their threads fall asleep.
Timing time(Simulation& simulation, const Extent& extent, const Watch& watch = {}, Simulation* pace = nullptr);

/// How far sticks are from their lengths in so many steps.
Strain look_at(Simulation& simulation, const Work& work, int steps, const Watch& watch = {});

/// Both, of one and then of another that does the same from its beginning.
using Make = std::function<std::unique_ptr<Simulation>()>;
Timing time_and_look(const Make& make, const Work& work, const Extent& extent, const Watch& watch = {},
                     Simulation* pace = nullptr);

/// What of the engine was measured.
struct Engine {
    int threads = 1;
    bool single = true; ///< float, else double
};

struct Measured : Timing {
    double build_ms = 0;             ///< from an empty world to one that is ready to step
    double prepare_ms = 0;           ///< of that: orders, colours, runs, blocks
    double bytes_per_constraint = 0; ///< most memory ever taken, over that of the particles and of
                                     ///< a small world; 0: not known
};

/// What a case asks of every solver.
Work work_of(const Case& chosen);
/// The engine on a case, which is that work; by turns with the textbook.
Measured measure(const Case& chosen, const Work& work, const Engine& engine, int steps, const Watch& watch = {});

/// How many steps are worth their time: enough for a median, and for small cloth to hang.
int usual_steps(const Work& work);

/// The engine as one of those that are compared.
std::unique_ptr<Simulation> simulate(const Case& chosen, const Engine& engine, const Effort& effort);

/// What the engine's lanes are on this processor: scalar, sse2, avx2, avx512, neon.
std::string_view simd();

} // namespace sinew::bench
