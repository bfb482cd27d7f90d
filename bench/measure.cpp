#include "bench/measure.h"

#include "sinew/simulation.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/world/edit.h"

#include "bench/memory.h"
#include "bench/textbook.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sinew::bench {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

double timed_step(Simulation& simulation) {
    const auto begun = Clock::now();
    simulation.step();
    return milliseconds_since(begun);
}

/// Consecutive step times without the first, which starts with cold caches; a single time is kept.
std::vector<double> warm(std::vector<double> times) {
    if (times.size() > 1) times.erase(times.begin());
    return times;
}

/// Number of steps in a turn of `turn` milliseconds, at `step` milliseconds per step; at most a sixth of all steps.
int turn_length(double step, double turn, int steps) {
    return std::max(1, int(std::min(turn / step, steps / 6.0)));
}

template <class Real> class EngineRun final : public Simulation {
  public:
    EngineRun(World<3, Real> world, int threads)
        : simulation_{std::move(world), sinew::Solver<3, Real>({.threads = threads})} {
        simulation_.solver.prepare(simulation_.world);
    }
    void step() override { simulation_.step(Real(frame)); }
    Found position(std::size_t particle) const override {
        return cast<double>(simulation_.world.particles.position[particle]);
    }

  private:
    sinew::Simulation<3, Real> simulation_;
};

/// Bytes of the particles' own columns.
template <class Real> std::size_t particle_bytes(const World<3, Real>& world) {
    std::size_t bytes = 0;
    Particles<3, Real>::columns(world.particles,
                                [&](const auto& column) { bytes += column.size() * sizeof column[0]; });
    return bytes;
}

/// Progress of one half of the work, after a share `before`.
Watch half_of(const Watch& watch, double before) {
    return [&watch, before](double share) {
        if (watch) watch(before + share / 2);
    };
}

/// Steps a small world first, so that memory a process needs for any world, such as code, is not counted.
template <class Real> void step_a_small_one(Case chosen, int threads) {
    constexpr int small = 16;
    chosen.size = std::min(chosen.size, small);
    EngineRun<Real>(world_of<Real>(chosen), threads).step();
}

template <class Real>
Measured measure_as(const Case& chosen, const Work& work, const Engine& engine, int steps, const Watch& watch) {
    Measured measured;
    step_a_small_one<Real>(chosen, engine.threads);
    const PeakMemory memory;
    const auto begun = Clock::now();
    auto world = world_of<Real>(chosen);
    const auto particles = double(particle_bytes(world));
    const auto built = Clock::now();
    EngineRun<Real> run(std::move(world), engine.threads); // prepares
    measured.prepare_ms = milliseconds_since(built);
    measured.build_ms = milliseconds_since(begun);
    run.step();
    constexpr std::size_t enough = 50'000; // constraints: below, pages and the heap's reserve dominate
    if (const auto bytes = memory.risen(); bytes > 0 && work.constraints() >= enough)
        measured.bytes_per_constraint = (double(bytes) - particles) / double(work.constraints());
    constexpr double patience = 1.5; // seconds
    Textbook textbook(work, Effort{});
    static_cast<Timing&>(measured) = time(run, {.steps = steps, .seconds = patience}, half_of(watch, 0), &textbook);
    const Effort effort{.substeps = chosen.direct ? 0 : Effort{}.substeps};
    measured.strain = look_at(*simulate(chosen, engine, effort), work, measured.steps, half_of(watch, 0.5));
    return measured;
}

} // namespace

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto rank = std::size_t(std::ceil(share * double(values.size())));
    const auto at = values.begin() + std::ptrdiff_t(std::clamp<std::size_t>(rank, 1, values.size()) - 1);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

Timing time(Simulation& simulation, const Extent& extent, const Watch& watch, Simulation* pace) {
    Timing timing;
    std::vector<double> times, all, ratios; // per step, without the first of a turn or with all; per turn
    double spent = 0;                       // milliseconds
    const auto on = [&] { return timing.steps < extent.steps && spent < 1000 * extent.seconds; };
    int length = pace ? 1 : extent.steps, pace_length = pace ? 1 : 0;
    while (on()) {
        std::vector<double> paced, turn;
        for (int i = 0; i < pace_length; ++i) paced.push_back(timed_step(*pace));
        for (int i = 0; i < length && on(); ++i) {
            turn.push_back(timed_step(simulation));
            all.push_back(turn.back());
            spent += turn.back();
            ++timing.steps;
            if (watch) watch(std::max(double(timing.steps) / extent.steps, spent / (1000 * extent.seconds)));
        }
        turn = warm(std::move(turn));
        times.insert(times.end(), turn.begin(), turn.end());
        if (!pace) continue;
        const double unit = median(warm(std::move(paced))), mine = median(std::move(turn));
        ratios.push_back(unit / mine);
        length = turn_length(mine, 100, extent.steps);
        pace_length = turn_length(unit, 30, extent.steps);
    }
    timing.milliseconds = median(warm(std::move(times)));
    timing.percentile_99 = percentile(all, 0.99);
    timing.worst = percentile(std::move(all), 1);
    if (pace) timing.ratio = median(warm(std::move(ratios)));
    return timing;
}

Strain look_at(Simulation& simulation, const Work& work, int steps, const Watch& watch) {
    Strain strain;
    std::vector<Found> positions(work.positions.size());
    for (int i = 0; i < steps; ++i) {
        simulation.step();
        for (std::size_t k = 0; k < positions.size(); ++k) positions[k] = simulation.position(k);
        const double before = strain.max;
        strain = strain_of(work, positions);
        if (before > strain.max || std::isnan(before)) strain.max = before;
        if (watch) watch(double(i + 1) / steps);
    }
    return strain;
}

Timing time_and_look(const Make& make, const Work& work, const Extent& extent, const Watch& watch, Simulation* pace) {
    auto timing = time(*make(), extent, half_of(watch, 0), pace);
    timing.strain = look_at(*make(), work, timing.steps, half_of(watch, 0.5));
    return timing;
}

Measured measure(const Case& chosen, const Work& work, const Engine& engine, int steps, const Watch& watch) {
    return engine.single ? measure_as<float>(chosen, work, engine, steps, watch)
                         : measure_as<double>(chosen, work, engine, steps, watch);
}

int usual_steps(const Work& work) {
    constexpr double constraints_stepped = 5e6; // about half a second of the textbook
    return int(std::clamp(constraints_stepped / double(work.constraints()), 3.0, 300.0));
}

Work work_of(const Case& chosen) {
    return work_of(world_of<double>(chosen));
}

std::unique_ptr<Simulation> simulate(const Case& chosen, const Engine& engine, const Effort& effort) {
    const auto made = [&]<class Real>(World<3, Real> world) -> std::unique_ptr<Simulation> {
        world.settings.substeps = effort.substeps;
        world.settings.iterations = effort.iterations;
        return std::make_unique<EngineRun<Real>>(std::move(world), engine.threads);
    };
    return engine.single ? made(world_of<float>(chosen)) : made(world_of<double>(chosen));
}

std::string_view simd() {
    return name_of(best_simd());
}

} // namespace sinew::bench
