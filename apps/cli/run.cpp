#include "sinew/session/event_json.h"
#include "sinew/solver/profile.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/report_text.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/session_file.h"
#include "apps/cli/stepping.h"
#include "apps/cli/trace.h"
#include "canvas/interrupt.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

/// Times of the latest steps, at most 65536, for the median.
class StepTimes {
  public:
    void add(double milliseconds) {
        if (times.size() < max)
            times.push_back(milliseconds);
        else
            times[count % max] = milliseconds;
        ++count;
    }

    void add(const StepTimes& others) {
        for (const double time : others.times) add(time);
    }

    /// Milliseconds; 0 without a step.
    double median() const {
        if (times.empty()) return 0;
        auto sorted = times;
        const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
        std::ranges::nth_element(sorted, middle);
        return *middle;
    }

  private:
    static constexpr std::size_t max = 1 << 16;
    std::vector<double> times;
    std::size_t count = 0;
};

/// Frames of a trace: the initial state and every `every`-th step.
struct Tracing {
    Trace& trace;
    std::uint64_t every = 1;
    bool has_begun = false; ///< the present state is written

    Tracing going_on() const { return {trace, every, true}; }
};

StepTimes timed(Run& run, std::uint64_t steps, const std::string& label, std::optional<Tracing> tracing) {
    using Clock = std::chrono::steady_clock;
    StepTimes times;
    canvas::Progress progress(label, std::size_t(steps));
    if (tracing && !tracing->has_begun) tracing->trace.write(run.session);
    while (run.steps() < steps) {
        const auto begin = Clock::now();
        run.advance(run.steps() + 1, progress);
        times.add(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
        if (tracing && run.steps() % tracing->every == 0) tracing->trace.write(run.session);
    }
    return times;
}

json::Array events_json(const Session& session) {
    constexpr std::size_t max = 100;
    json::Array events;
    for (const auto& happening : session.happenings()) {
        if (events.size() == max) break;
        json::Object event{{"what", happening.what}};
        for (auto& detail : event_details(happening)) event.push_back(std::move(detail));
        events.push_back(std::move(event));
    }
    return events;
}

json::Object phases_json(const PhaseTimes& times) {
    json::Object object;
    for (std::size_t i = 0; i < phase_names.size(); ++i)
        object.push_back(
            {std::string(phase_names[i]), 1000 * times.seconds[i] / double(std::max(times.steps, std::uint64_t(1)))});
    return object;
}

json::Object to_json(const std::string& name, const Session& session, double milliseconds, const PhaseTimes& phases) {
    auto object = scene_json(name, session.scene());
    for (auto& member : report_json(session.report())) object.push_back(std::move(member));
    object.push_back({"ms_per_step", milliseconds});
    object.push_back({"ms_by_phase", phases_json(phases)});
    object.push_back({"events_count", session.happening_count()});
    object.push_back({"events", events_json(session)});
    return object;
}

std::string events_text(const Session& session) {
    std::vector<std::pair<std::string, std::size_t>> counts;
    for (const auto& happening : session.happenings()) {
        const auto known = std::ranges::find(counts, happening.what, &std::pair<std::string, std::size_t>::first);
        if (known == counts.end())
            counts.emplace_back(happening.what, 1);
        else
            ++known->second;
    }
    std::string text;
    for (const auto& [what, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
    return text.empty() ? "none" : text;
}

class RunCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "run",
            .usage = "SCENE [--seconds S] [--save FILE [--at S]] [--trace FILE] [--pointer FILE] [--threads N]\n"
                     "          [--json] [key=value...]",
            .about = "steps a scene without drawing it and tells how it ended",
            .details =
                "With --json the last line is one JSON object: scene, mode, precision, dimension, units,\n"
                "seconds, steps, particles, constraints, hash, energy {kinetic, potential, stored, total},\n"
                "energy_lost (what direct blocks gave up where they struck, cracked or snapped taut),\n"
                "stretch_max, stretch_mean (of distances, as fractions of their rest length), max_speed,\n"
                "ms_per_step (median), ms_by_phase (mean), events_count and events (the first 100). An event has\n"
                "what, seconds, where: torn, cut, parted (a figure fell into so many islands), quarantined, those\n"
                "of the scene, and begin, persist, end and hit of contacts for which the scene waits (with: the\n"
                "other side, impulse). Numbers are in the scene's units; one that is not finite is null. The hash\n"
                "is the same on every machine.\n"
                "\n"
                "A trace holds a row for each particle of each frame, the start among them: time, name,\n"
                "position and velocity in the scene's own units, as CSV with a heading where the file ends in\n"
                ".csv, otherwise as a JSON object a line. With --trace - the rows go to standard output, and\n"
                "what run has to tell to standard error.\n"
                "\n"
                "With --save the running scene is written to a file, and `sinew run FILE` goes on from there, to\n"
                "the same second: on any machine, every later hash is that of the run that never stopped.\n"
                "\n"
                "A pointer file has a line TIME, X, Y, BUTTON for each turn of a pointer's path, in the\n"
                "scene's units (in 3D X and Y are pixels of its picture). The pointer goes straight from one\n"
                "place to the next; while BUTTON is not 0 it holds what it was pressed on.\n",
            .examples = "sinew run ragdoll\n"
                        "sinew run ragdoll --seconds 10 --json | jq .hash\n"
                        "sinew run ragdoll mode=classic precision=float world.gravity=[0,0.2]\n"
                        "sinew run ragdoll --trace ragdoll.csv --every 6 --of bob/head,bob/left_foot\n"
                        "sinew run chains mode=classic --pointer mouse.csv --trace - | jq .position\n"
                        "generate-a-scene | sinew run - --json\n"
                        "sinew run ragdoll --save at.sinew --at 5; sinew run at.sinew --json\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_scene(parser, words);
        declare_number(parser, "-s,--seconds", seconds, possible_seconds, "S",
                       "until when, from the scene's start; else what the scene says");
        declare_whole(parser, "--threads", threads, {1, 1024}, "N", "how many work on a step; else one for each core");
        declare_flag(parser, "--json", as_json, "ends with one line of JSON");
        declare_text(parser, "--trace", trace_path, "FILE", "writes positions and velocities, frame by frame");
        declare_whole(parser, "--every", every, {1, 1e9}, "N", "of a trace: each Nth step only");
        declare_text(parser, "--of", names, "A,B", "of a trace: these particles and figures; else all");
        declare_text(parser, "--save", save_path, "FILE", "saves the running scene, to go on from: sinew run FILE");
        declare_number(parser, "--at", save_at, possible_seconds, "S",
                       "of --save: when, from the scene's start; else at the end");
        declare_text(parser, "--pointer", pointer_path, "FILE", "plays a pointer's path: time, x, y, button a line");
    }

    int run() override {
        if (save_at && save_path.empty()) usage_error("--at is of --save", "--save FILE saves the running scene");
        if (save_path == "-") usage_error("a running scene is saved in a file, not in a pipe", "--save FILE");
        auto opened = open_session(words);
        Run run(std::move(opened.session), threads.value_or(0));
        if (!pointer_path.empty()) run.pointer = PointerPath::read(pointer_path);
        auto trace = begin_trace(run.session);
        canvas::catch_interrupts();
        const auto& scene = run.session.scene();
        const auto& name = words.scene;
        const auto phases = std::make_shared<PhaseTimes>();
        run.session.set_reports({.times = phases, .preparing = {}});
        const auto tracing = trace ? std::optional(Tracing{*trace, std::uint64_t(every.value_or(1))}) : std::nullopt;
        if (seconds) run.expect_ahead("--seconds", *seconds);
        if (save_at) run.expect_ahead("--at", *save_at);
        const auto last = steps_until(scene, seconds.value_or(save_at.value_or(scene.seconds)));
        const auto saved = save_at ? steps_until(scene, *save_at) : last;
        if (!save_path.empty() && saved > last) usage_error("--at is after the end", "--seconds S runs longer");
        auto times = timed(run, save_path.empty() ? last : saved, title_of(name), tracing);
        if (!save_path.empty()) {
            save_session(run.session, opened.from, save_path);
            times.add(timed(run, last, title_of(name), tracing ? std::optional(tracing->going_on()) : std::nullopt));
        }
        if (trace) trace->close();
        const auto milliseconds = times.median();
        const auto text = as_json ? to_line(to_json(name, run.session, milliseconds, *phases))
                                  : summary(name, run.session, milliseconds);
        trace_path == "-" ? print_error(text) : print(text);
        return done;
    }

    std::optional<Trace> begin_trace(const Session& session) const {
        if (!trace_path.empty()) return Trace(trace_path, names, session);
        if (every || !names.empty()) usage_error("--every and --of are of a trace", "--trace FILE writes one");
        return std::nullopt;
    }

    static std::string summary(const std::string& name, const Session& session, double milliseconds) {
        auto rows = report_rows(session.report(), session.scene());
        rows.push_back({"events", events_text(session)});
        rows.push_back({"time a step", fmt::format("{:.3g} ms (median)", milliseconds)});
        return fmt::format("{} {}\n{}", bold(name), scene_text(session.scene()), table(rows));
    }

    SceneWords words;
    std::optional<double> seconds;
    std::optional<int> threads, every;
    std::optional<double> save_at;
    std::string trace_path, names, pointer_path, save_path;
    bool as_json = false;
};

} // namespace

std::unique_ptr<Command> command::run() {
    return std::make_unique<RunCommand>();
}

} // namespace sinew::cli
