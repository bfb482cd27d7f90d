#include "apps/cli/bench_options.h"
#include "apps/cli/bench_text.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/stepping.h"
#include "bench/cases.h"
#include "bench/contender.h"
#include "canvas/progress.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

/// `sinew bench weights`: a rope under increasing weights, by every contender.
namespace sinew::cli {
namespace {

constexpr std::array weights = {100, 1000, 10'000, 100'000}; // links; the rope has 100
constexpr int usual_steps = 300;                             // five seconds

/// Equal work split in two ways: impulse solvers favour iterations, position-based solvers substeps.
constexpr std::array<bench::Effort, 2> efforts = {{{10, 1}, {1, 10}}};

struct Hung {
    std::string by;
    std::string effort;
    bench::Timing timing;
};

bench::Timing hang(const bench::Contender& one, const bench::Effort& effort, const bench::Work& work, int steps) {
    canvas::Progress progress(one.name, std::size_t(steps));
    return time_and_look([&] { return one.make(effort); }, work, {.steps = steps},
                         [&](double share) {
                             progress.update(std::size_t(share * steps));
                             give_up_if_interrupted();
                         });
}

std::vector<Hung> hang_all(int weight, int steps) {
    const auto swept = *bench::find_case(fmt::format("heavy-{}", weight));
    const auto direct = *bench::find_case(fmt::format("heavy-{}-direct", weight));
    const auto work = work_of(swept);
    const bench::Engine engine{.threads = 1, .single = false};
    auto all = bench::rivals(work);
    all.push_back({"sinew, swept", [&](const bench::Effort& effort) { return simulate(swept, engine, effort); }});
    std::vector<Hung> results;
    for (const auto& one : all)
        for (const auto& effort : efforts)
            results.push_back(
                {one.name, fmt::format("{} x {}", effort.substeps, effort.iterations), hang(one, effort, work, steps)});
    const bench::Contender ours{"sinew", [&](const bench::Effort& effort) { return simulate(direct, engine, effort); }};
    results.push_back({ours.name, "default", hang(ours, {.substeps = 0}, work, steps)});
    return results;
}

/// Adds a result to the contender's curve; at each weight the better effort counts.
void add(std::vector<bench::Curve>& curves, const Hung& hung, double weight) {
    auto curve = std::ranges::find(curves, hung.by, &bench::Curve::name);
    if (curve == curves.end()) curve = curves.insert(curves.end(), {hung.by, {}});
    const double stretch = 100 * hung.timing.strain.max;
    auto& points = curve->points;
    if (points.empty() || points.back().x != weight)
        points.push_back({weight, stretch, ""});
    else if (!(points.back().y <= stretch))
        points.back().y = stretch;
}

} // namespace

void bench_weights(const BenchOptions& options) {
    std::vector<std::vector<std::string>> rows{
        {"weight, in ropes", "by", "substeps x iterations", "ms a step", "most stretch", "at the end"}};
    std::vector<bench::Curve> curves;
    for (const int weight : weights)
        for (const auto& hung : hang_all(weight, int(options.steps.value_or(usual_steps)))) {
            const auto& timing = hung.timing;
            if (options.as_json)
                print(to_line(json::Object{{"case", fmt::format("heavy-{}", weight)},
                                           {"by", hung.by},
                                           {"effort", hung.effort},
                                           {"steps", timing.steps},
                                           {"ms_per_step", timing.milliseconds},
                                           {"stretch_max", timing.strain.max},
                                           {"stretch_last", timing.strain.last}}));
            else
                rows.push_back({std::to_string(weight / 100), hung.by, hung.effort,
                                fmt::format("{:.4f}", timing.milliseconds), stretch_text(timing.strain.max),
                                stretch_text(timing.strain.last)});
            add(curves, hung, weight / 100.0);
        }
    std::ranges::rotate(curves, curves.end() - 1); // the engine first, as in other plots
    if (!options.as_json) print(bench_table(rows, options));
    if (!options.plot.empty())
        write_plot(options.plot, {"A rope of 100 links under a weight on its end, five seconds",
                                  "weight, in weights of the rope",
                                  {{"stretch of the worst link, %", std::move(curves)}}});
}

std::string weights_details() {
    return "weights: a rope of 100 links hanging for five seconds with 1 to 1000 times its weight on the end, by "
           "everyone,\n"
           "10 substeps of 1 iteration; and by the engine with its default settings. --plot draws it.\n";
}

} // namespace sinew::cli
