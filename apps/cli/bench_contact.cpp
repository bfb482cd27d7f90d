#include "sinew/simulation.h"
#include "sinew/world/measure.h"

#include "apps/cli/bench_options.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/stepping.h"
#include "bench/contact.h"
#include "bench/measure.h"
#include "canvas/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fmt/format.h>

/// `sinew bench contact [CASE]`: figures that fall and come to rest on each other.
namespace sinew::cli {
namespace {

struct ContactResult {
    double moving = 0, resting = 0;      ///< medians of the first and of the last third of the steps, ms
    double percentile_99 = 0, worst = 0; ///< of all steps, ms
    double longest = 0;                  ///< largest error of a link seen, a fraction
    bench::ContactState end;
    std::uint64_t hash = 0;
};

/// Seconds: of the processor with one thread, since others may use the machine; of the clock with more.
double seconds_now(int threads) {
    if (threads == 1) return double(std::clock()) / CLOCKS_PER_SEC;
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median_of(const std::vector<double>& times, std::size_t first, std::size_t last) {
    return bench::percentile({times.begin() + std::ptrdiff_t(first), times.begin() + std::ptrdiff_t(last)}, 0.5);
}

ContactResult run_contact(const bench::ContactWork& work, int threads, int substeps, std::size_t steps,
                          canvas::Progress& progress) {
    constexpr std::size_t seldom = 20; // steps from look to look
    Simulation<2, float> simulation{bench::contact_world(work, substeps), Solver<2, float>({.threads = threads})};
    simulation.solver.prepare(simulation.world);
    ContactResult result;
    std::vector<double> times;
    for (std::size_t i = 1; i <= steps; ++i) {
        const double before = seconds_now(threads);
        simulation.step(float(bench::frame));
        times.push_back(1000 * (seconds_now(threads) - before));
        if (i % seldom == 0 || i == steps) {
            result.end = look_at(work, simulation.world);
            result.longest = std::max(result.longest, result.end.longest);
        }
        progress.update(i);
        give_up_if_interrupted();
    }
    result.moving = median_of(times, 0, (steps + 2) / 3);
    result.resting = median_of(times, 2 * steps / 3, steps);
    result.percentile_99 = bench::percentile(times, 0.99);
    result.worst = bench::percentile(std::move(times), 1);
    result.hash = state_hash(simulation.world);
    return result;
}

json::Object in_json(const bench::ContactCase& chosen, int threads, const ContactResult& result) {
    return {{"case", chosen.name},
            {"threads", threads},
            {"ms_moving", result.moving},
            {"ms_resting", result.resting},
            {"ms_percentile_99", result.percentile_99},
            {"ms_worst", result.worst},
            {"stretch_max", result.longest},
            {"speed", result.end.speed},
            {"crossed", result.end.crossed},
            {"hash", fmt::format("{:016x}", result.hash)}};
}

std::vector<std::string> in_row(const bench::ContactCase& chosen, int threads, const ContactResult& result) {
    return {chosen.name,
            fmt::format("{}", threads),
            fmt::format("{:.3f}", result.moving),
            fmt::format("{:.3f}", result.resting),
            fmt::format("{:.3f}", result.percentile_99),
            fmt::format("{:.3f}", result.worst),
            fmt::format("{:.2g} %", 100 * result.longest),
            fmt::format("{:.2g}", 1000 * result.end.speed),
            fmt::format("{}", result.end.crossed),
            fmt::format("{:016x}", result.hash)};
}

} // namespace

void bench_contacts(const BenchOptions& options, const std::vector<bench::ContactCase>& cases) {
    const auto steps = std::size_t(options.steps.value_or(std::round(60 * options.seconds.value_or(10))));
    std::vector<std::vector<std::string>> rows{{"case", "threads", "ms moving", "ms resting", "99 %", "worst",
                                                "longest link", "mm/s at the end", "crossed", "hash"}};
    for (const auto& chosen : cases) {
        const auto work = chosen.family->build(chosen.size);
        const int threads = int(options.threads.value_or(1));
        canvas::Progress progress(chosen.name, steps);
        const auto result = run_contact(work, threads, int(options.substeps.value_or(0)), steps, progress);
        if (options.as_json)
            print(to_line(in_json(chosen, threads, result)));
        else
            rows.push_back(in_row(chosen, threads, result));
    }
    if (!options.as_json) print(table(rows));
}

std::string contact_details() {
    std::string families;
    for (const auto& family : bench::contact_families())
        families += fmt::format("  {}-SIZE: {}\n", family.name, family.about);
    return "contact: figures in a plane that touch each other, 10 s at 60 steps a second in floats. Told are the "
           "median\n"
           "time of a step in the first third of the steps, while all is in motion, and in the last third, at rest,\n"
           "that of 99 of 100 steps and of all (of the processor with one thread, else of the clock), the largest "
           "error\n"
           "of a link, the mean speed at the end, and the pairs of limbs of different figures that cross there.\n"
           "With --json one line a case: case, threads, ms_moving, ms_resting, ms_percentile_99, ms_worst, "
           "stretch_max\n"
           "(a fraction), speed (m/s), crossed, hash.\n"
           "Cases of contact:\n" +
           families;
}

} // namespace sinew::cli
