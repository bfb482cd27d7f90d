#include "sinew/solver/workers.h"

#include "apps/cli/bench_text.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/stepping.h"
#include "bench/contender.h"
#include "canvas/progress.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

/// `sinew bench CASE...`: the engine, the textbook and the peers on the same work in the same run.
namespace sinew::cli {
namespace {

using bench::Case;
using bench::Effort;
using bench::Measured;
using bench::Timing;
using bench::Work;

/// Result of a contender other than the engine.
struct Rival {
    std::string name;
    Timing timing;
};

/// Progress bar of a measurement.
class Watching {
  public:
    Watching(const Case& chosen, std::string_view who) : progress_(fmt::format("{}, {}", chosen.name, who), parts) {}
    bench::Watch watch() {
        return [this](double share) {
            progress_.update(std::size_t(share * parts));
            give_up_if_interrupted();
        };
    }

  private:
    static constexpr std::size_t parts = 1000;
    canvas::Progress progress_;
};

/// Measures all rivals on a case. The first is the textbook in list order, the unit of speed; the others alternate with
/// the textbook and stop after `patience` seconds.
std::vector<Rival> measure_rivals(const Case& chosen, const Work& work, int steps) {
    constexpr double patience = 3; // seconds
    std::vector<Rival> all;
    const auto rivals = bench::rivals(work);
    for (const auto& rival : rivals) {
        Watching watching(chosen, rival.name);
        const auto pace = all.empty() ? nullptr : rivals.front().make(Effort{});
        const auto make = [&] { return rival.make(Effort{}); };
        const bench::Extent extent{.steps = steps, .seconds = pace ? patience : 1e9};
        all.push_back({rival.name, time_and_look(make, work, extent, watching.watch(), pace.get())});
    }
    all.front().timing.ratio = 1;
    return all;
}

double projections_per_second(const Work& work, double milliseconds) {
    return double(work.constraints()) * Effort{}.substeps * Effort{}.iterations / (milliseconds / 1000);
}

/// Name as a JSON key: "textbook, shuffled" becomes textbook_shuffled.
std::string key_of(std::string_view name) {
    std::string key;
    for (const char c : name)
        if (c != ',') key += c == ' ' ? '_' : c;
    return key;
}

/// Result of the engine with one configuration.
struct Ours {
    bench::Engine engine;
    Measured measured;
};

json::Object in_json(const Case& chosen, const Work& work, const Ours& ours, const std::vector<Rival>& rivals) {
    const auto& [engine, measured] = ours;
    json::Object line{{"case", chosen.name},
                      {"steps", measured.steps},
                      {"threads", engine.threads},
                      {"precision", engine.single ? "float" : "double"},
                      {"simd", std::string(bench::simd())},
                      {"particles", work.positions.size()},
                      {"constraints", work.constraints()},
                      {"ms_per_step", measured.milliseconds},
                      {"ms_percentile_99", measured.percentile_99},
                      {"ms_worst", measured.worst}};
    // A direct solve has no number of projections.
    if (!chosen.direct) line.push_back({"projections_per_s", projections_per_second(work, measured.milliseconds)});
    for (json::Member& more : json::Object{{"ratio", measured.ratio},
                                           {"stretch_max", measured.strain.max},
                                           {"stretch_last", measured.strain.last},
                                           {"stretch_mean", measured.strain.mean},
                                           {"build_ms", measured.build_ms},
                                           {"prepare_ms", measured.prepare_ms}})
        line.push_back(std::move(more));
    if (measured.bytes_per_constraint > 0) line.push_back({"bytes_per_constraint", measured.bytes_per_constraint});
    json::Object others;
    for (const auto& [name, timing] : rivals)
        others.push_back({key_of(name), json::Object{{"ms_per_step", timing.milliseconds},
                                                     {"ms_percentile_99", timing.percentile_99},
                                                     {"ms_worst", timing.worst},
                                                     {"ratio", timing.ratio},
                                                     {"steps", timing.steps},
                                                     {"stretch_max", timing.strain.max},
                                                     {"stretch_mean", timing.strain.mean}}});
    line.push_back({"rivals", std::move(others)});
    return line;
}

std::vector<std::string> row(const std::string& name, const std::string& who, const Work& work, const Timing& timing,
                             bool projects = true) {
    return {name,
            who,
            fmt::format("{:.3f}", timing.milliseconds),
            fmt::format("{:.3f}", timing.percentile_99),
            fmt::format("{:.3f}", timing.worst),
            projects ? fmt::format("{:.3f}", projections_per_second(work, timing.milliseconds) / 1e9) : "",
            fmt::format("{:.2f}", timing.ratio),
            stretch_text(timing.strain.max),
            stretch_text(timing.strain.mean),
            "",
            ""};
}

std::vector<std::string> row(const std::string& name, const Case& chosen, const Work& work, const Ours& ours) {
    const auto& [engine, measured] = ours;
    const auto who = fmt::format("sinew, {}, {} thread{}", engine.single ? "float" : "double", engine.threads,
                                 engine.threads == 1 ? "" : "s");
    auto cells = row(name, who, work, measured, !chosen.direct);
    cells[9] = fmt::format("{:.0f} ms", measured.build_ms);
    if (const double bytes = measured.bytes_per_constraint; bytes > 0) cells[10] = fmt::format("{:.0f}", bytes);
    return cells;
}

/// Configurations to measure: float on 1, 2 and 4 threads and double on 1; for large cases float on 1 and on most
/// threads only; or the configuration given by the options.
std::vector<bench::Engine> engines(const BenchOptions& options, const Work& work) {
    constexpr std::size_t large = 1'000'000; // constraints: building the world takes longer than stepping
    const bool few = work.constraints() >= large;
    std::vector<int> counts;
    for (const int n : {1, 2, 4})
        if (n <= hardware_threads()) counts.push_back(n);
    if (few && counts.size() > 2) counts.erase(counts.begin() + 1, counts.end() - 1);
    if (options.threads) counts = {int(*options.threads)};
    std::vector<bench::Engine> all;
    for (const int n : counts) all.push_back({n, options.precision != "double"});
    if (options.precision.empty() && !options.threads && !few) all.push_back({1, false});
    return all;
}

int steps_of(const BenchOptions& options, const Work& work) {
    return options.steps ? int(*options.steps) : bench::usual_steps(work);
}

/// Measures the engine on a case in all configurations.
std::vector<Ours> measure_engines(const BenchOptions& options, const Case& chosen, const Work& work) {
    std::vector<Ours> all;
    for (const auto& engine : engines(options, work)) {
        Watching watching(chosen, "sinew");
        all.push_back({engine, measure(chosen, work, engine, steps_of(options, work), watching.watch())});
    }
    return all;
}

void print_lines(const Case& chosen, const Work& work, const std::vector<Ours>& ours,
                 const std::vector<Rival>& rivals) {
    for (const auto& one : ours) print(to_line(in_json(chosen, work, one, rivals)));
    flush_output();
}

void add_rows(std::vector<std::vector<std::string>>& rows, const Case& chosen, const Work& work, int steps,
              const std::vector<Ours>& ours, const std::vector<Rival>& rivals) {
    auto name = fmt::format("{} ({})", chosen.name, work.constraints());
    for (const auto& one : ours) rows.push_back(row(std::exchange(name, ""), chosen, work, one));
    for (const auto& [who, timing] : rivals)
        rows.push_back(
            row("", timing.steps < steps ? fmt::format("{}, {} steps", who, timing.steps) : who, work, timing));
}

} // namespace

/// Rivals are measured after the engine, and in the table only after all cases: memory kept by a rival's heap would be
/// attributed to the engine.
void bench_cases(const BenchOptions& options, const std::vector<bench::Case>& cases) {
    if (options.as_json) {
        for (const auto& chosen : cases) {
            const auto work = work_of(chosen);
            const auto ours = measure_engines(options, chosen, work);
            print_lines(chosen, work, ours, measure_rivals(chosen, work, steps_of(options, work)));
        }
        return;
    }
    std::vector<std::vector<Ours>> ours;
    for (const auto& chosen : cases) ours.push_back(measure_engines(options, chosen, work_of(chosen)));
    std::vector<std::vector<std::string>> rows{{"case", "by", "ms a step", "99 %", "worst", "G projections/s", "ratio",
                                                "most stretch", "mean stretch", "ready in", "bytes each"}};
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto work = work_of(cases[i]);
        const int steps = steps_of(options, work);
        add_rows(rows, cases[i], work, steps, ours[i], measure_rivals(cases[i], work, steps));
    }
    if (!options.as_markdown) print(fmt::format("On this machine the engine's lanes are: {}\n", bench::simd()));
    print(bench_table(rows, options));
}

std::string case_details() {
    std::string text =
        "Every case is stepped by the engine, by the textbook's solver and by the peers that are built, each with\n"
        "the same particles, constraints, 10 substeps of 1 iteration, and 60 steps a second. Told is the median\n"
        "time of a whole step, the time that 99 of 100 steps do not exceed, and the longest of all; ratio is how\n"
        "many times the textbook's speed the median is, stepped by turns with it, so that a clock which changes\n"
        "under way changes for both; the stretch is of the worst constraint after any step, and the mean after\n"
        "the last one, as fractions of their lengths.\n"
        "With --json one line a case and number of threads: case, threads, precision, simd, particles,\n"
        "constraints, ms_per_step, ms_percentile_99, ms_worst, projections_per_s, ratio, stretch_max,\n"
        "stretch_mean, build_ms, prepare_ms, bytes_per_constraint, and what the rivals did. Cases:\n";
    for (const auto& family : bench::families()) text += fmt::format("  {}-SIZE: {}\n", family.name, family.about);
    return text +
           "ragdolls and ropes are swept, as the textbook does; SIZE-direct lets the engine solve them at once.\n";
}

} // namespace sinew::cli
