#include "sinew/sinew.h"
#include "sinew/topology/cut.h"

#include "apps/cli/bench_options.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/rope_cases.h"
#include "apps/cli/stepping.h"
#include "bench/measure.h"
#include "canvas/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

struct RopeResult {
    double milliseconds = 0;             ///< median of a step
    double percentile_99 = 0, worst = 0; ///< of all steps, ms
    double stretch = 0;                  ///< largest strain of any link after any step, a fraction
    double outside = 0;                  ///< largest violation of an angle limit after any step, degrees
    double cut = 0;  ///< case `ropes`: median milliseconds of cutting one rope and finding the blocks again
    double gain = 0; ///< largest energy above the initial energy, as a fraction of total weight times length
};

/// Largest violation of an angle limit, degrees.
template <class Real> double worst_angle(const World<2, Real>& world) {
    double worst = 0;
    const auto& angles = std::get<kind_number<Angle, 2>>(world.constraints);
    for (Row row = 0; row < angles.size(); ++row)
        worst = std::max(worst,
                         std::abs(constraint_state(world, {kind_number<Angle, 2>, angles.handles.id_of(row)})->error));
    return worst * 180 / pi<double>;
}

double median(std::vector<double> times) {
    if (times.empty()) return 0;
    const auto middle = times.begin() + std::ptrdiff_t(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    return *middle;
}

double milliseconds_since(std::chrono::steady_clock::time_point before) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count();
}

/// Median time of a cut, milliseconds: 21 of the ropes are cut in the middle, one after the other.
template <class Real> double time_of_a_cut(Simulation<2, Real>& simulation, int links) {
    auto& world = simulation.world;
    constexpr int cuts = 21;
    std::vector<double> times;
    for (int i = 0; i < cuts; ++i) {
        const auto link = find_constraint(world, fmt::format("rope_{}/link_{}", i * many_ropes / cuts, links / 2));
        const auto before = std::chrono::steady_clock::now();
        cut(world, std::span<const ConstraintId>(&*link, 1));
        simulation.solver.prepare(world);
        times.push_back(milliseconds_since(before));
        simulation.step(Real(1.0 / 60));
    }
    return median(times);
}

template <class Real> RopeResult run_rope(const RopeCase& rope, double seconds, canvas::Progress& progress) {
    double scale = 0;
    Simulation<2, Real> simulation{world_of<Real>(rope, scale), Solver<2, Real>({.threads = rope.threads})};
    const auto& world = simulation.world;
    const double begun = energy(world).total();
    RopeResult result;
    std::vector<double> times;
    const auto steps = std::size_t(std::round(seconds * 60));
    simulation.solver.prepare(simulation.world);
    for (std::size_t i = 0; i < steps; ++i) {
        const auto before = std::chrono::steady_clock::now();
        simulation.step(Real(1.0 / 60));
        times.push_back(milliseconds_since(before));
        result.outside = std::max(result.outside, worst_angle(world));
        result.stretch = std::max(result.stretch, stretch(world).max);
        result.gain = std::max(result.gain, (energy(world).total() - begun) / scale);
        progress.update(i + 1);
        give_up_if_interrupted();
    }
    result.milliseconds = median(times);
    result.percentile_99 = bench::percentile(times, 0.99);
    result.worst = bench::percentile(std::move(times), 1);
    if (rope.name == "ropes") result.cut = time_of_a_cut(simulation, rope.links);
    return result;
}

json::Object in_json(const RopeCase& rope, const RopeResult& result) {
    json::Object line{{"case", rope.name},
                      {"links", rope.links},
                      {"weight", rope.weight},
                      {"start", rope.start},
                      {"threads", rope.threads},
                      {"precision", rope.precision},
                      {"ms_per_step", result.milliseconds},
                      {"ms_percentile_99", result.percentile_99},
                      {"ms_worst", result.worst},
                      {"stretch_max", result.stretch},
                      {"outside_limits", result.outside},
                      {"energy_gain", result.gain}};
    // half a millisecond: a shipped game's budget for all ropes
    if (rope.name == "ropes") {
        line.emplace_back("ropes_per_half_ms", many_ropes * 0.5 / result.milliseconds);
        line.emplace_back("ms_per_cut", result.cut);
    }
    return line;
}

std::vector<std::string> in_row(const RopeCase& rope, const RopeResult& result) {
    return {rope.name,
            fmt::format("{}", rope.links),
            fmt::format("{:g}", rope.weight),
            rope.start,
            rope.precision,
            fmt::format("{:.4f}", result.milliseconds),
            fmt::format("{:.4f}", result.percentile_99),
            fmt::format("{:.4f}", result.worst),
            fmt::format("{:.2g} %", 100 * result.stretch),
            fmt::format("{:.2g}", result.outside),
            fmt::format("{:.2g} %", 100 * result.gain)};
}

std::vector<RopeCase> cases_of(const BenchOptions& options) {
    std::vector<RopeCase> all;
    const std::string real = options.precision.empty() ? "double" : options.precision;
    const auto some = [](const std::optional<double>& one, std::initializer_list<double> usual) {
        return one ? std::vector{*one} : std::vector(usual);
    };
    for (const double n : some(options.links, {10, 100, 1000}))
        for (const double w : some(options.weight, {1, 100, 1000, 100000}))
            for (const std::string s : {"hang", "level"})
                if (options.start.empty() || options.start == s)
                    if (options.only.empty() || options.only == "rope") all.push_back({"rope", int(n), w, s, real});
    const bool chosen = options.links || options.weight || !options.start.empty();
    for (const auto& example : rope_cases)
        if (options.only == example.name || (options.only.empty() && !chosen))
            all.push_back({std::string(example.name), int(options.links.value_or(example.links)),
                           options.weight.value_or(example.weight), std::string(example.start), real});
    for (auto& rope : all) rope.threads = int(options.threads.value_or(1));
    return all;
}

} // namespace

void bench_ropes(const BenchOptions& options) {
    if (!options.only.empty() && options.only != "rope" &&
        std::ranges::find(rope_cases, options.only, &RopeExample::name) == rope_cases.end())
        usage_error(fmt::format("bench: there is no case {}", options.only), "sinew bench --help");
    std::vector<std::vector<std::string>> rows{{"case", "links", "weight", "start", "precision", "ms a step", "99 %",
                                                "worst", "stretch", "degrees", "energy gain"}};
    for (const auto& rope : cases_of(options)) {
        const double whole = options.seconds.value_or(5);
        canvas::Progress progress(
            fmt::format("{}, {} links, weight {:g}, {}", rope.name, rope.links, rope.weight, rope.start),
            std::size_t(std::round(whole * 60)));
        const auto result = rope.precision == "float" ? run_rope<float>(rope, whole, progress)
                                                      : run_rope<double>(rope, whole, progress);
        if (options.as_json)
            print(to_line(in_json(rope, result)));
        else
            rows.push_back(in_row(rope, result));
    }
    if (!options.as_json) print(table(rows));
}

std::string rope_details() {
    std::string cases = "rope";
    for (const auto& example : rope_cases) cases += fmt::format("; {} ({})", example.name, example.about);
    return "rope: 10 m of rope, each link 1 kg, a weight on the end, 5 s at 60 steps a second and the\n"
           "default settings. Told are the median time of a step, that of 99 of 100 steps and of all,\n"
           "the stretch of the worst link after any step, and the most energy it ever gained, as a part of its weight "
           "times its length.\n"
           "With --json one line a case: case, links, weight, start, threads, precision, ms_per_step,\n"
           "ms_percentile_99, ms_worst, stretch_max, energy_gain (fractions), outside_limits (the worst angle, in "
           "degrees); of the case\n"
           "ropes also ropes_per_half_ms: how many a step of 0.5 ms would move; and ms_per_cut: what it takes to\n"
           "cut one of them in the middle.\n"
           "Cases of rope: " +
           cases + ".\n";
}

} // namespace sinew::cli
