#include "sinew/solver/workers.h"

#include "apps/cli/bench_options.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/stepping.h"
#include "bench/measure.h"
#include "bench/textbook.h"
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

/// Who else did it.
struct Rival {
    std::string_view name;
    Timing timing;
};

/// The rivals' results on a case; the first is the textbook in list order, by which speed is told.
class Rivals {
  public:
    Rivals(const Case& chosen, const Work& work, int steps) : chosen_(chosen), work_(work) {
        using Order = bench::Textbook::Order;
        const int few = std::min(steps, 5); // at random it takes long
        run("textbook", bench::Textbook(work, {}, Order::listed), steps);
        run("textbook, shuffled", bench::Textbook(work, {}, Order::shuffled),
            work.sticks.size() > most_shuffled ? few : steps);
        for (const auto& peer : bench::peers())
            if (peer.takes(work)) run(peer.name, *peer.make(work, Effort{}), steps);
    }

    const std::vector<Rival>& all() const { return all_; }
    const Timing& textbook() const { return all_.front().timing; }

  private:
    static constexpr std::size_t most_shuffled = 1'000'000;
    const Case& chosen_;
    const Work& work_;
    std::vector<Rival> all_;

    void run(std::string_view name, bench::Simulation&& simulation, int steps) { run(name, simulation, steps); }
    void run(std::string_view name, bench::Simulation& simulation, int steps);
};

/// Watches a measurement on the terminal.
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

void Rivals::run(std::string_view name, bench::Simulation& simulation, int steps) {
    Watching watching(chosen_, name);
    all_.push_back({name, time(simulation, work_, steps, watching.watch())});
}

double projections_per_second(const Work& work, double milliseconds) {
    return double(work.constraints()) * Effort{}.substeps * Effort{}.iterations / (milliseconds / 1000);
}

/// "textbook, shuffled" as a key: textbook_shuffled.
std::string key_of(std::string_view name) {
    std::string key;
    for (const char c : name)
        if (c != ',') key += c == ' ' ? '_' : c;
    return key;
}

struct Line {
    const Case& chosen;
    const Work& work;
    const bench::Engine& engine;
    const Measured& measured;
    const Rivals& rivals;

    double ratio() const { return rivals.textbook().milliseconds / measured.milliseconds; }

    json::Object in_json() const {
        json::Object line{{"case", chosen.name},
                          {"threads", engine.threads},
                          {"precision", engine.single ? "float" : "double"},
                          {"simd", std::string(bench::simd())},
                          {"particles", work.places.size()},
                          {"constraints", work.constraints()},
                          {"ms_per_step", measured.milliseconds}};
        // At once there is no telling how often a constraint is projected.
        if (!chosen.direct) line.push_back({"projections_per_s", projections_per_second(work, measured.milliseconds)});
        for (json::Member& more : json::Object{{"ratio", ratio()},
                                               {"stretch_max", measured.strain.max},
                                               {"stretch_mean", measured.strain.mean},
                                               {"build_ms", measured.build_ms},
                                               {"prepare_ms", measured.prepare_ms}})
            line.push_back(std::move(more));
        if (measured.bytes_per_constraint > 0) line.push_back({"bytes_per_constraint", measured.bytes_per_constraint});
        json::Object others;
        for (const auto& [name, timing] : rivals.all())
            others.push_back({key_of(name), json::Object{{"ms_per_step", timing.milliseconds},
                                                         {"stretch_max", timing.strain.max},
                                                         {"stretch_mean", timing.strain.mean}}});
        line.push_back({"rivals", std::move(others)});
        return line;
    }
};

std::string fraction(double value) {
    return std::isfinite(value) ? fmt::format("{:.2g} %", 100 * value) : "lost";
}

std::vector<std::string> row(const std::string& name, const std::string& who, const Work& work, const Timing& timing,
                             double unit, bool projects = true) {
    return {name,
            who,
            fmt::format("{:.3f}", timing.milliseconds),
            projects ? fmt::format("{:.3f}", projections_per_second(work, timing.milliseconds) / 1e9) : "",
            fmt::format("{:.2f}", unit / timing.milliseconds),
            fraction(timing.strain.max),
            fraction(timing.strain.mean)};
}

std::vector<int> thread_counts(const BenchOptions& options) {
    if (options.threads) return {int(*options.threads)};
    std::vector<int> counts;
    for (const int n : {1, 2, 4})
        if (n <= hardware_threads()) counts.push_back(n);
    return counts;
}

} // namespace

void bench_cases(const BenchOptions& options, const std::vector<bench::Case>& cases) {
    std::vector<std::vector<std::string>> rows{
        {"case", "by", "ms a step", "G projections/s", "ratio", "most stretch", "mean stretch"}};
    for (const auto& chosen : cases) {
        const auto work = work_of(chosen);
        const int steps = options.steps ? int(*options.steps) : bench::usual_steps(work);
        const Rivals rivals(chosen, work, steps);
        const double unit = rivals.textbook().milliseconds;
        auto name = fmt::format("{} ({})", chosen.name, work.constraints());
        for (const int threads : thread_counts(options)) {
            const bench::Engine engine{threads, options.precision != "double"};
            const auto who = fmt::format("sinew, {}, {} thread{}", engine.single ? "float" : "double", threads,
                                         threads == 1 ? "" : "s");
            Watching watching(chosen, who);
            const auto measured = measure(chosen, work, engine, steps, watching.watch());
            if (options.as_json) {
                print(to_line(Line{chosen, work, engine, measured, rivals}.in_json()));
                flush_output();
            }
            rows.push_back(row(std::exchange(name, ""), who, work, measured, unit, !chosen.direct));
        }
        for (const auto& [who, timing] : rivals.all()) rows.push_back(row("", std::string(who), work, timing, unit));
    }
    if (!options.as_json)
        print(fmt::format("On this machine the engine's lanes are: {}\n{}", bench::simd(), table(rows)));
}

std::string case_details() {
    std::string text =
        "Every case is stepped by the engine, by the textbook's solver and by the peers that are built, each with\n"
        "the same particles, constraints, 10 substeps of 1 iteration, and 60 steps a second. Told is the median\n"
        "time of a whole step; ratio is how many times the textbook's speed that is; the stretch is of the worst\n"
        "constraint after any step looked at, and the mean after the last one, as fractions of their lengths.\n"
        "With --json one line a case and number of threads: case, threads, precision, simd, particles,\n"
        "constraints, ms_per_step, projections_per_s, ratio, stretch_max, stretch_mean, build_ms, prepare_ms,\n"
        "bytes_per_constraint, and what the rivals did. Cases:\n";
    for (const auto& family : bench::families()) text += fmt::format("  {}-SIZE: {}\n", family.name, family.about);
    return text +
           "ragdolls and ropes are swept, as the textbook does; SIZE-direct lets the engine solve them at once.\n";
}

} // namespace sinew::cli
