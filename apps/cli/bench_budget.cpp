#include "sinew/sinew.h"
#include "sinew/world/colliders.h"

#include "apps/cli/bench_options.h"
#include "apps/cli/bench_text.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/stepping.h"
#include "bench/measure.h"
#include "canvas/progress.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

/// `sinew bench budget`: how many ropes and ragdolls a game can afford in half a millisecond of a frame.
namespace sinew::cli {
namespace {

constexpr double budget = 0.5; ///< ms of a step
constexpr int warm_up = 30, measured = 90, rounds = 3;

struct Crowd {
    std::string_view figure; ///< rope or ragdoll
    int links = 0;           ///< of a rope
    bool contact = false;    ///< true: figures touch each other, where they meet
};
constexpr std::array<Crowd, 8> crowds = {{{"rope", 20, false},
                                          {"rope", 50, false},
                                          {"rope", 100, false},
                                          {"ragdoll", 0, false},
                                          {"rope", 20, true},
                                          {"rope", 50, true},
                                          {"rope", 100, true},
                                          {"ragdoll", 0, true}}};

/// Result for a crowd of one size.
struct Affordable {
    int figures = 0;
    double milliseconds = 0, percentile_99 = 0, worst = 0; ///< of a step
    double stretch_last = 0;                               ///< worst link at the end, a fraction

    double fitting() const { return figures * budget / milliseconds; } ///< in a step of `budget`
};

/// Ropes released level, 10 cm apart.
template <class Real> void add_ropes(World<3, Real>& world, int links, int ropes) {
    for (int i = 0; i < ropes; ++i)
        build(world, Rope{.length = 0.1 * links, .segments = links, .angle = pi<double> / 2, .mass = double(links)},
              fmt::format("rope_{}", i), {.at = {{0, 0, Real(0.1 * i)}}});
}

template <class Real> World<3, Real> world_of(const Crowd& crowd, int figures) {
    World<3, Real> world;
    if (crowd.links > 0) {
        set_gravity(world, {{0, Real(-9.81), 0}});
        add_ropes(world, crowd.links, figures);
    } else {
        constexpr Real further = 5; // metres apart: a crowd in which nothing touches
        world = bench::world_of<Real>(*bench::find_case(fmt::format("ragdolls-{}-direct", std::max(figures, 2))));
        for (Row row = 0; row < world.particles.size(); ++row)
            world.particles.position[row][2] += further * Real(world.particles.figure[row]);
    }
    for (FigureIndex i = 0; i < world.figures.size(); ++i) set_contact(world, i, {.figures = crowd.contact});
    return world;
}

template <class Real> Affordable time_crowd(const Crowd& crowd, int figures, int threads) {
    Simulation<3, Real> simulation{world_of<Real>(crowd, figures), Solver<3, Real>({.threads = threads})};
    std::vector<double> times;
    for (int i = 0; i < warm_up + measured; ++i) {
        const auto before = std::chrono::steady_clock::now();
        simulation.step(Real(bench::frame));
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - before;
        if (i >= warm_up) times.push_back(taken.count());
        give_up_if_interrupted();
    }
    return {figures, bench::percentile(times, 0.5), bench::percentile(times, 0.99), bench::percentile(times, 1),
            stretch(simulation.world).max};
}

/// Size of the crowd whose median step takes the budget: the size is corrected by the time that it took.
template <class Real> Affordable afford(const Crowd& crowd, int threads, canvas::Progress& progress) {
    Affordable found;
    int figures = 64;
    for (int i = 0; i < rounds; ++i) {
        found = time_crowd<Real>(crowd, figures, threads);
        figures = std::clamp(int(found.fitting()), 2, 20'000);
        progress.update(std::size_t(i + 1));
    }
    return found;
}

std::string name_of(const Crowd& crowd) {
    return crowd.links > 0 ? fmt::format("ropes of {} links", crowd.links) : "ragdolls";
}

} // namespace

void bench_budget(const BenchOptions& options) {
    std::vector<std::vector<std::string>> rows{
        {"figures", "contact", "in 0.5 ms", "ms a step", "99 %", "worst", "stretch"}};
    for (const auto& crowd : crowds) {
        canvas::Progress progress(name_of(crowd), rounds);
        const int threads = int(options.threads.value_or(1));
        const auto found = options.precision == "double" ? afford<double>(crowd, threads, progress)
                                                         : afford<float>(crowd, threads, progress);
        if (options.as_json)
            print(to_line(json::Object{{"figures", name_of(crowd)},
                                       {"contact", crowd.contact},
                                       {"in_half_ms", found.fitting()},
                                       {"ms_per_step", found.milliseconds},
                                       {"ms_percentile_99", found.percentile_99},
                                       {"ms_worst", found.worst},
                                       {"stretch_last", found.stretch_last}}));
        else
            rows.push_back({name_of(crowd), crowd.contact ? "on" : "off", fmt::format("{:.0f}", found.fitting()),
                            fmt::format("{:.3f}", found.milliseconds), fmt::format("{:.3f}", found.percentile_99),
                            fmt::format("{:.3f}", found.worst), stretch_text(found.stretch_last)});
    }
    if (!options.as_json) print(bench_table(rows, options));
}

std::string budget_details() {
    return "budget: how many ropes let go level, 10 cm apart, and ragdolls tumbling 6 m apart fit into a step of 0.5 "
           "ms,\n"
           "what a shipped game spends on them: with contact between figures switched off, and on. Told are the median "
           "time\n"
           "of a step of about that many, that of 99 of 100 steps and of all, and the worst link at the end.\n";
}

} // namespace sinew::cli
