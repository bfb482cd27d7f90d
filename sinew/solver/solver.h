#pragma once

#include "sinew/solver/block.h"
#include "sinew/solver/collider_touches.h"
#include "sinew/solver/contact_filter.h"
#include "sinew/solver/profile.h"
#include "sinew/solver/program_threads.h"
#include "sinew/solver/sweep_state.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <vector>

/// Everything of a simulation that follows from its world, and can be thrown away and worked out again: plans, blocks,
/// and room to work in. A solver follows the world by the world's journal.
namespace sinew {

template <int D, class Real> struct World;
template <int D, class Real> struct ContactRoom;
template <int D, class Real> struct SleepRoom;
template <int D, class Real> struct AloneRoom;
struct DampedBodies;
template <int D, class Real> struct EnergyRoom;
struct WindAreas;

struct SolverOptions {
    int threads = 0;         ///< threads of a step; 0: the number of cores. Results do not depend on the number
    Simd simd = best_simd(); ///< instruction set of the kernels. Results do not depend on it
    ContactFilter contact_filter{};
    ProgramThreads program_threads{}; ///< in place of those for every world (set_program_threads)

    /// Threads that a step may use: one while a filter is asked.
    int threads_wanted() const { return contact_filter ? 1 : threads; }
};

/// Reports of a solver to its owner; a copy of a solver makes none.
struct SolverReports {
    std::shared_ptr<PhaseTimes> times;           ///< receives the times of all steps; without it no clock is read
    std::function<void(double share)> preparing; ///< progress of preparing a large world, [0, 1], never decreasing
};

template <int D, class Real> struct Solver {
    SolverOptions options;
    SolverReports reports;
    Blocks<D> blocks;                               ///< constraints solved at once instead of in the sweep
    SweepState<D, Real> sweep_state;                ///< plan and columns of the sweep
    std::shared_ptr<ContactRoom<D, Real>> contacts; ///< of figures with each other; none before the first
    std::shared_ptr<SleepRoom<D, Real>> sleep;      ///< bodies that may fall asleep; none before the first
    std::shared_ptr<EnergyRoom<D, Real>> energy;    ///< before a step; none before the first
    std::shared_ptr<AloneRoom<D, Real>> alone;      ///< bodies that may be far from all others; none before the first
    std::shared_ptr<DampedBodies> damped;           ///< of figures with internal damping; none before the first
    std::shared_ptr<WindAreas> wind_areas;          ///< areas that winds press on; none before the first
    std::vector<Vec<D, Real>> scratch;              ///< points and gradients of the widest constraint
    std::vector<char> torn;                         ///< by row of a table: to be removed at the end of the step
    std::vector<char> stays;                        ///< classic mode, by row: moved by the pin alone
    ColliderTouches<D, Real> touches;
    std::shared_ptr<const char>
        identity{}; ///< of the solver and the world it follows: the world's journal has the same

    // Special members are defined in solver.cpp, because each one generates a lot of code.
    Solver();
    explicit Solver(const SolverOptions& chosen);
    /// A copy has the options, and works out the rest anew.
    Solver(const Solver& other);
    Solver& operator=(const Solver& other);
    Solver(Solver&&) noexcept;
    Solver& operator=(Solver&&) noexcept;
    ~Solver();

    /// Advances a world by dt, in the world's time unit. dt is clamped to limit::step; zero, negative, NaN or below
    /// limit::shortest_step does nothing. Events stay in world.events until the next step. Allocates nothing, except
    /// that the first step after an edit, or of another world, does the work of `prepare`.
    void step(World<D, Real>& world, Real dt);

    /// Finds the connected components of an edited world and reserves memory for their solution; a no-op without edits.
    void prepare(World<D, Real>& world);
    /// Takes up a world: begins anew, unless the solver has read the world's journal, and no other's since.
    void follow(World<D, Real>& world);
    /// Reports the progress of preparation.
    void report(double share) const {
        if (reports.preparing) reports.preparing(share);
    }
};

/// True if a direct block moves some of the particles.
template <int D, class Real>
bool moves_any(const Blocks<D>& blocks, const World<D, Real>& world, std::span<const Row> particles) {
    return std::any_of(particles.begin(), particles.end(),
                       [&](Row row) { return blocks.particles.has(world.particles.handles.index_of(row)); });
}

} // namespace sinew
