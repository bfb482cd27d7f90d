#include "sinew/simulation.h"
#include "sinew/world/measure.h"

#include "apps/cli/bench_options.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/stepping.h"
#include "bench/bodies.h"
#include "bench/measure.h"
#include "canvas/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

/// `sinew bench contact [CASE]`: figures that fall and come to rest on each other.
namespace sinew::cli {
namespace {

struct ContactResult {
    std::size_t steps = 0;
    double moving = 0, resting = 0;      ///< medians of the first and of the last third of the steps, ms
    double percentile_99 = 0, worst = 0; ///< of all steps, ms
    double longest = 0;                  ///< largest error of a link seen, a fraction
    bench::ContactState end;
    std::optional<std::uint64_t> hash; ///< of the last state of our own
};

/// Seconds: of the processor with one thread, since others may use the machine; of the clock with more.
double seconds_now(int threads) {
    if (threads == 1) return double(std::clock()) / CLOCKS_PER_SEC;
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median_of(const std::vector<double>& times, std::size_t first, std::size_t last) {
    return bench::percentile({times.begin() + std::ptrdiff_t(first), times.begin() + std::ptrdiff_t(last)}, 0.5);
}

/// An engine at work on a case.
struct Contender {
    std::string name;
    std::function<void()> step;
    std::function<bench::ContactState()> look;                 ///< after a step
    std::function<std::optional<std::uint64_t>()> hash;        ///< of a state that has one
    double patience = std::numeric_limits<double>::infinity(); ///< seconds, after which it is stopped
    std::function<void()> before_look = [] {};                 ///< called before the step after which it is looked at
};

Contender sinew_on(const bench::ContactWork& work, int threads, int substeps) {
    auto run = std::make_shared<Simulation<2, float>>(bench::contact_world(work, substeps),
                                                      Solver<2, float>({.threads = threads}));
    run->solver.prepare(run->world);
    return {.name = "sinew",
            .step = [run] { run->step(float(bench::frame)); },
            .look = [run, &work] { return look_at(work, run->world); },
            .hash = [run] { return std::optional(state_hash(run->world)); }};
}

Contender peer_on(const bench::BodySolver& peer, const bench::ContactWork& work, const bench::Bodies& bodies,
                  int substeps) {
    std::shared_ptr<bench::BodySimulation> run = peer.make(work, bodies, substeps);
    auto before = std::make_shared<std::vector<Vec<2, double>>>();
    return {.name = std::string(peer.name),
            .step = [run] { run->step(); },
            .look = [run, before, &work, &bodies] { return look_at(work, bodies, *run, *before); },
            .hash = [] { return std::optional<std::uint64_t>(); },
            .patience = 60,
            .before_look = [run, before, &work, &bodies] { *before = positions_of(work, bodies, *run); }};
}

ContactResult run_contact(const Contender& contender, int threads, std::size_t steps, canvas::Progress& progress) {
    constexpr std::size_t seldom = 20; // steps from look to look
    ContactResult result;
    std::vector<double> times;
    double left = contender.patience;
    for (std::size_t i = 1, last = steps; i <= last; ++i) {
        if (left < 0) last = i;
        const bool looks = i % seldom == 0 || i == last;
        if (looks) contender.before_look();
        const double before = seconds_now(threads);
        contender.step();
        times.push_back(1000 * (seconds_now(threads) - before));
        left -= times.back() / 1000;
        if (looks) {
            result.end = contender.look();
            result.longest = std::max(result.longest, result.end.longest);
        }
        progress.update(i);
        give_up_if_interrupted();
    }
    result.steps = times.size();
    result.moving = median_of(times, 0, (result.steps + 2) / 3);
    result.resting = median_of(times, 2 * result.steps / 3, result.steps);
    result.percentile_99 = bench::percentile(times, 0.99);
    result.worst = bench::percentile(std::move(times), 1);
    result.hash = contender.hash();
    return result;
}

std::string in_hex(const ContactResult& result) {
    return result.hash ? fmt::format("{:016x}", *result.hash) : "";
}

json::Object in_json(const bench::ContactCase& chosen, const std::string& engine, int threads,
                     const ContactResult& result) {
    return {{"case", chosen.name},
            {"engine", engine},
            {"threads", threads},
            {"steps", result.steps},
            {"ms_moving", result.moving},
            {"ms_resting", result.resting},
            {"ms_percentile_99", result.percentile_99},
            {"ms_worst", result.worst},
            {"stretch_max", result.longest},
            {"speed", result.end.speed},
            {"crossed", result.end.crossed},
            {"hash", in_hex(result)}};
}

std::vector<std::string> in_row(const bench::ContactCase& chosen, const std::string& engine, int threads,
                                const ContactResult& result) {
    return {chosen.name,
            engine,
            fmt::format("{}", threads),
            fmt::format("{}", result.steps),
            fmt::format("{:.3f}", result.moving),
            fmt::format("{:.3f}", result.resting),
            fmt::format("{:.3f}", result.percentile_99),
            fmt::format("{:.3f}", result.worst),
            fmt::format("{:.2g} %", 100 * result.longest),
            fmt::format("{:.2g}", 1000 * result.end.speed),
            fmt::format("{}", result.end.crossed),
            in_hex(result)};
}

} // namespace

void bench_contacts(const BenchOptions& options, const std::vector<bench::ContactCase>& cases) {
    const auto steps = std::size_t(options.steps.value_or(std::round(60 * options.seconds.value_or(10))));
    std::vector<std::vector<std::string>> rows{{"case", "engine", "threads", "steps", "ms moving", "ms resting", "99 %",
                                                "worst", "longest link", "mm/s at the end", "crossed", "hash"}};
    constexpr std::size_t max_bodies = 50'000; // of more, other engines take minutes to begin
    const int all_threads = int(options.threads.value_or(1));
    for (const auto& chosen : cases) {
        const auto work = chosen.family->build(chosen.size);
        const auto tell = [&](const Contender& contender, int threads) {
            canvas::Progress progress(chosen.name + ", " + contender.name, steps);
            const auto result = run_contact(contender, threads, steps, progress);
            if (options.as_json)
                print(to_line(in_json(chosen, contender.name, threads, result)));
            else
                rows.push_back(in_row(chosen, contender.name, threads, result));
        };
        tell(sinew_on(work, all_threads, int(options.substeps.value_or(0))), all_threads);
        if (bench::body_peers().empty()) continue;
        const auto bodies = bodies_of(work);
        if (bodies.bodies.size() > max_bodies) continue;
        for (const auto& peer : bench::body_peers())
            tell(peer_on(peer, work, bodies, int(options.substeps.value_or(1))), 1);
    }
    if (!options.as_json) print(table(rows));
}

std::string contact_details() {
    std::string families;
    for (const auto& family : bench::contact_families())
        families += fmt::format("  {}-SIZE: {}\n", family.name, family.about);
    return "contact: figures in a plane that touch each other, 10 s at 60 steps a second in floats. Told are the\n"
           "median time of a step in the first third of the steps, while all is in motion, and in the last third, at\n"
           "rest, that of 99 of 100 steps and of all (of the processor with one thread, else of the clock), the "
           "largest\n"
           "error of a link, the mean speed at the end, and the pairs of limbs of different figures that cross there.\n"
           "Built with other engines beside it (./dev bench), it measures these as well, with up to 50,000 bodies: "
           "the\n"
           "same figures as rigid bodies and joints, one step a frame or --substeps, each with its own iterations, "
           "one\n"
           "thread, no sleep, stopped after a minute; the error is the largest gap of a joint, as a part of the "
           "shortest\n"
           "link there.\n"
           "With --json one line a case and engine: case, engine, threads, steps, ms_moving, ms_resting,\n"
           "ms_percentile_99, ms_worst, stretch_max (a fraction), speed (m/s), crossed, hash.\n"
           "Cases of contact:\n" +
           families;
}

} // namespace sinew::cli
