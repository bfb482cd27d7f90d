#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/sweep/momentum_keeper.h"
#include "sinew/solver/sweep/projections.h"
#include "sinew/solver/sweep/substeps.h"
#include "sinew/solver/workers.h"

#include <algorithm>

namespace sinew::detail {

/// All substeps of a component before the next component, for worlds whose components share nothing but threads: simple
/// distances, pins and planes. Iterations follow each other through the tiles as a wavefront, as closely as shared
/// particles allow, while a tile is still in the cache (Wonnacott, Using time skewing, 2000).
template <int D, class Real> class WavefrontSweep {
  public:
    WavefrontSweep(World<D, Real>& world, Solver<D, Real>& solver, const Substeps<D, Real>& substeps)
        : world_(world), solver_(solver), plan_(solver.sweep_state.plan), substeps_(substeps),
          threads_(threads_for(solver.sweep_state.size(), solver.options.threads_wanted())), keeper_{
                                                                                                 solver.sweep_state,
                                                                                                 substeps.kernels()} {}

    /// Distributes components over threads; all threads together run a component so large that one thread would finish
    /// long after the others.
    void run() {
        const auto& components = plan_.components;
        Workers::run(threads_, int(components.size()), [&](int i) {
            if (const auto& component = components[std::size_t(i)]; !is_large(component)) run_component(component, 1);
        });
        for (const auto& component : components)
            if (is_large(component)) run_component(component, threads_);
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    const Plan<Real>& plan_;
    const Substeps<D, Real>& substeps_;
    int threads_;
    MomentumKeeper<D, Real> keeper_;

    /// Range of substeps, counted from 0.
    struct Range {
        int first = 0, last = 0;
        bool gathers = false;  ///< particles are gathered before, and scattered afterwards
        bool predicts = false; ///< the first substep is yet to be predicted
    };

    bool is_large(const Component& component) const {
        const auto tiles = substeps_.tiles_of(component);
        const auto max = solver_.sweep_state.size() / std::uint32_t(2 * threads_);
        return tiles.size() >= 8 * std::size_t(threads_) && tiles.back().last - tiles.front().first > max;
    }

    /// Runs all substeps of a component. The momenta of free bodies are kept over the whole step where all forces are
    /// alike, otherwise in each substep, between forces and constraints.
    void run_component(const Component& component, int threads) {
        if (component.bodies == 0)
            return run_range(component, threads, {.last = substeps_.count, .gathers = true, .predicts = true});
        const auto tiles = substeps_.tiles_of(component);
        const auto bodies = std::span(solver_.sweep_state.bodies.list).subspan(component.first_body, component.bodies);
        const bool alike = solver_.sweep_state.everyone_alike;
        const int number = alike ? substeps_.count : 1;
        gather(world_, solver_, substeps_.h, tiles.front().first, tiles.back().last);
        for (int first = 0; first < substeps_.count; first += number) {
            if (!alike) predict(component, first + 1);
            keeper_.note(bodies, alike ? substeps_.decay() : 1);
            run_range(component, threads, {.first = first, .last = first + number, .predicts = alike});
            keeper_.restore(bodies);
        }
        scatter(world_, solver_, tiles.front().first, tiles.back().last);
    }
    void predict(const Component& component, int number) {
        auto substep = substeps_.number(number);
        for (const auto& tile : substeps_.tiles_of(component)) substep.predict(tile);
    }

    /// Runs some substeps over a component turn after turn, a few iterations to a stage.
    void run_range(const Component& component, int threads, const Range& range) {
        const int iterations = (range.last - range.first) * world_.settings.iterations;
        const int stages = std::min(iterations, WavefrontScheduler::max_stages);
        if (stages < 1) return;
        WavefrontScheduler scheduler(stages, turns_of(component, iterations));
        Workers::run(threads, threads, [&](int) {
            scheduler.help([&](int stage, int turn) {
                for (int i = iterations * stage / stages; i < iterations * (stage + 1) / stages; ++i)
                    run_turn(component, turn, i, range);
            });
        });
    }

    /// Number of tiles of a turn. With fewer tiles, threads take tiles out of each other's caches more often; with
    /// more, there is less to share.
    static constexpr std::uint32_t at_once = 16;
    int turns_of(const Component& component, int iterations) const {
        const auto total_offset = std::uint32_t(iterations) * wavefront_offset(world_, component);
        return int((component.tiles + total_offset + at_once - 1) / at_once);
    }

    /// Runs one turn of iteration `number` of the range. The first iteration gathers and predicts; later substeps are
    /// predicted as the substep before ends.
    void run_turn(const Component& component, int turn, int number, const Range& range) {
        const int iterations = world_.settings.iterations, iteration = number % iterations;
        const int substep_number = range.first + number / iterations;
        const auto iteration_offset = wavefront_offset(world_, component);
        const auto begun = std::uint32_t(number) * iteration_offset, ended = begun + iteration_offset;
        const auto first = std::max(begun, std::uint32_t(turn) * at_once);
        const auto last = std::min(ended + component.tiles, std::uint32_t(turn + 1) * at_once);
        if (first >= last) return;
        auto substep = substeps_.number(substep_number + 1), next = substeps_.number(substep_number + 2);
        substep.set_anchors(component);
        substep.mover().first_iteration = iteration == 0;
        for (auto time = first; time < last; ++time) {
            const auto at = [&](std::uint32_t begin, auto&& work) {
                if (time >= begin && time - begin < component.tiles) work(time - begin);
            };
            if (number == 0) at(0, [&](std::uint32_t i) { enter(substep, tile_of(component, i), range); });
            for_each_projection(world_, plan_, substep, component,
                                [&](std::uint32_t offset, auto&& work) { at(begun + offset, work); });
            at(ended, [&](std::uint32_t i) {
                const auto& tile = tile_of(component, i);
                if (iteration + 1 < iterations) return substep.hold(tile);
                const bool over = substep_number + 1 == range.last;
                substep.go_on(tile, over ? nullptr : &next);
                if (over && range.gathers) scatter(world_, solver_, tile.first, tile.last);
            });
        }
    }

    const Tile& tile_of(const Component& component, std::uint32_t i) const {
        SINEW_ASSERT(i < component.tiles, "the tile is in the component");
        return plan_.tiles[component.first_tile + i];
    }
    void enter(Substep<D, Real>& substep, const Tile& tile, const Range& range) {
        if (range.gathers) gather(world_, solver_, substeps_.h, tile.first, tile.last);
        if (range.predicts) substep.predict(tile);
    }
};

} // namespace sinew::detail
