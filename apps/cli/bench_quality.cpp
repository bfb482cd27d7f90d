#include "apps/cli/bench_text.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/stepping.h"
#include "bench/contender.h"
#include "canvas/progress.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

/// `sinew bench quality`: accuracy against time. The same work with increasing effort, by every contender able to do
/// the work.
namespace sinew::cli {
namespace {

using bench::Case;
using bench::Effort;
using bench::Timing;
using bench::Work;

constexpr std::array<Effort, 8> efforts = {{{1, 4}, {1, 10}, {1, 40}, {4, 1}, {10, 1}, {20, 1}, {40, 1}, {80, 1}}};
constexpr int usual_steps = 120; // two seconds

struct Tried : bench::Contender {
    std::vector<Timing> results{}; ///< by effort
};

std::vector<Tried> contenders(const Case& chosen, const Work& work, const bench::Engine& engine) {
    std::vector<Tried> all;
    all.push_back({{"sinew", [=](const Effort& effort) { return simulate(chosen, engine, effort); }}});
    for (auto& rival : bench::rivals(work)) all.push_back({std::move(rival)});
    return all;
}

void measure(Tried& one, const Work& work, int steps) {
    canvas::Progress progress(one.name, efforts.size() * std::size_t(steps));
    for (std::size_t i = 0; i < efforts.size(); ++i) {
        const auto make = [&] { return one.make(efforts[i]); };
        one.results.push_back(time_and_look(make, work, {.steps = steps}, [&](double share) {
            progress.update(std::size_t((double(i) + share) * steps));
            give_up_if_interrupted();
        }));
    }
}

json::Object in_json(const Case& chosen, const Tried& one, const bench::Engine& engine, std::size_t i) {
    const auto& timing = one.results[i];
    const bool ours = one.name == "sinew";
    return {{"case", chosen.name},
            {"by", one.name},
            {"steps", timing.steps},
            {"threads", ours ? engine.threads : 1},
            {"precision", ours && !engine.single ? "double" : "float"},
            {"substeps", efforts[i].substeps},
            {"iterations", efforts[i].iterations},
            {"ms_per_step", timing.milliseconds},
            {"stretch_max", timing.strain.max},
            {"stretch_last", timing.strain.last},
            {"stretch_mean", timing.strain.mean}};
}

std::vector<std::string> in_row(const Tried& one, std::size_t i) {
    const auto& timing = one.results[i];
    return {i == 0 ? one.name : "",
            fmt::format("{} x {}", efforts[i].substeps, efforts[i].iterations),
            fmt::format("{:.3f}", timing.milliseconds),
            stretch_text(timing.strain.max),
            stretch_text(timing.strain.last),
            stretch_text(timing.strain.mean)};
}

bench::Curve curve(const Tried& one, double bench::Strain::*what) {
    bench::Curve made{one.name, {}};
    for (std::size_t i = 0; i < efforts.size(); ++i)
        made.points.push_back(
            {one.results[i].milliseconds, 100 * (one.results[i].strain.*what),
             one.name == "sinew" ? fmt::format("{}x{}", efforts[i].substeps, efforts[i].iterations) : ""});
    std::ranges::sort(made.points, {}, &bench::PlotPoint::x);
    mark_beaten(made);
    return made;
}

bench::Plot plot_of(const Case& chosen, std::span<const Tried> all) {
    bench::Plot plot{"Stretch of " + chosen.name + " against the time of a step", "ms a step, one core", {}};
    for (const auto& [title, what] : {std::pair("mean stretch after two seconds, %", &bench::Strain::mean),
                                      std::pair("most stretch ever, %", &bench::Strain::max)}) {
        plot.panels.push_back({title, {}});
        for (const auto& one : all) plot.panels.back().curves.push_back(curve(one, what));
    }
    return plot;
}

} // namespace

void bench_quality(const BenchOptions& options, const Case& chosen) {
    const auto work = work_of(chosen);
    const bench::Engine engine{int(options.threads.value_or(1)), options.precision != "double"};
    auto all = contenders(chosen, work, engine);
    std::vector<std::vector<std::string>> rows{
        {"by", "substeps x iterations", "ms a step", "most stretch", "at the end", "mean stretch"}};
    for (auto& one : all) {
        measure(one, work, int(options.steps.value_or(usual_steps)));
        for (std::size_t i = 0; i < efforts.size(); ++i)
            if (options.as_json)
                print(to_line(in_json(chosen, one, engine, i)));
            else
                rows.push_back(in_row(one, i));
        flush_output();
    }
    if (!options.as_json) print(bench_table(rows, options));
    if (!options.plot.empty()) write_plot(options.plot, plot_of(chosen, all));
}

std::string quality_details() {
    return "quality [CASE]: what time buys. The case (else swing-64) with more and more substeps and iterations, by\n"
           "everyone who can do it: time against the most stretch of any constraint ever, that at the end, and the\n"
           "mean at the end. --plot draws the curves into an SVG file.\n";
}

} // namespace sinew::cli
