#include "sinew/solver/profile.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/report_text.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/stepping.h"
#include "canvas/interrupt.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

/// Times of the last steps: as many as make a good median.
class StepTimes {
  public:
    void add(double milliseconds) {
        if (times.size() < most)
            times.push_back(milliseconds);
        else
            times[count % most] = milliseconds;
        ++count;
    }

    /// Zero where there was no step.
    double median() const {
        if (times.empty()) return 0;
        auto sorted = times;
        const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
        std::ranges::nth_element(sorted, middle);
        return *middle;
    }

  private:
    static constexpr std::size_t most = 1 << 16;
    std::vector<double> times;
    std::size_t count = 0;
};

StepTimes timed(Run& run, std::uint64_t steps, const std::string& label) {
    using Clock = std::chrono::steady_clock;
    StepTimes times;
    canvas::Progress progress(label, std::size_t(steps));
    for (auto begin = Clock::now(); run.steps() < steps;) {
        run.advance(run.steps() + 1, progress);
        const auto end = Clock::now();
        times.add(std::chrono::duration<double, std::milli>(end - begin).count());
        begin = end;
    }
    return times;
}

json::Array events_json(const Session& session) {
    constexpr std::size_t most = 100;
    json::Array events;
    for (const auto& [seconds, what, where, islands] : session.happenings()) {
        if (events.size() == most) break;
        json::Object event{{"seconds", seconds}, {"what", what}, {"where", where}};
        if (islands > 0) event.push_back({"islands", islands});
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
            .usage = "SCENE [--seconds S] [--threads N] [--json] [key=value...]",
            .about = "steps a scene without drawing it and tells how it ended",
            .details = "With --json the last line is one JSON object: scene, mode, precision, dimension, units,\n"
                       "seconds, steps, particles, constraints, hash, energy {kinetic, potential, stored, total},\n"
                       "energy_lost (what ropes and figures gave up where they struck, cracked or snapped taut),\n"
                       "stretch_max, stretch_mean (of distances, as fractions of their rest length), max_speed,\n"
                       "ms_per_step (median), ms_by_phase (mean), events_count and events (the first 100): torn, cut, "
                       "parted (a figure\n"
                       "fell into so many islands), quarantined and those of the scene. Numbers are in the scene's\n"
                       "units; one that is not finite is null. The hash is the same on every machine.\n",
            .examples = "sinew run ragdoll\n"
                        "sinew run ragdoll --seconds 10 --json | jq .hash\n"
                        "sinew run ragdoll mode=classic precision=float world.gravity=[0,0.2]\n"
                        "generate-a-scene | sinew run - --json\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_scene(parser, words);
        declare_number(parser, "-s,--seconds", seconds, possible_seconds, "S", "how long; else what the scene says");
        declare_number(parser, "--threads", threads, {1, 1024}, "N", "how many work on a step; else one for each core");
        declare_flag(parser, "--json", as_json, "ends with one line of JSON");
    }

    int run() override {
        Run run(open_file(words.scene, words.overrides));
        std::visit([&](auto& world) { world.threads = int(threads.value_or(0)); }, run.session.world());
        canvas::catch_interrupts();
        const auto& scene = run.session.scene();
        const auto& name = words.scene;
        PhaseTimes phases;
        const Profile profile(phases);
        const auto times = timed(run, steps_until(scene, seconds.value_or(scene.seconds)), title_of(name));
        const auto milliseconds = times.median();
        print(as_json ? to_line(to_json(name, run.session, milliseconds, phases))
                      : summary(name, run.session, milliseconds));
        return done;
    }

    static std::string summary(const std::string& name, const Session& session, double milliseconds) {
        auto rows = report_rows(session.report(), session.scene());
        rows.push_back({"events", events_text(session)});
        rows.push_back({"time a step", fmt::format("{:.3g} ms (median)", milliseconds)});
        return fmt::format("{} {}\n{}", bold(name), scene_text(session.scene()), table(rows));
    }

    SceneWords words;
    std::optional<double> seconds, threads;
    bool as_json = false;
};

} // namespace

std::unique_ptr<Command> command::run() {
    return std::make_unique<RunCommand>();
}

} // namespace sinew::cli
