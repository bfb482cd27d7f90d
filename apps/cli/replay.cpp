#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/json_line.h"
#include "apps/cli/recording_file.h"
#include "apps/cli/stepping.h"
#include "canvas/interrupt.h"
#include "canvas/progress.h"

#include <fmt/format.h>

namespace sinew::cli {
namespace {

std::string position_text(const Vec3<double>& position) {
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", position[0], position[1], position[2]);
}

std::string text_of(const play::Divergence& divergence) {
    auto text = fmt::format("step {} ends elsewhere: hash ...{:08x}, recorded ...{:08x}", divergence.step,
                            divergence.found, divergence.recorded);
    if (const auto& place = divergence.place)
        text += fmt::format("; at step {} particle {}{} is at {}, recorded at {}", place->step, place->particle,
                            place->name.empty() ? "" : " (" + place->name + ")", position_text(place->found),
                            position_text(place->recorded));
    return text;
}

json::Object json_of(const play::Divergence& divergence) {
    json::Object object{{"step", divergence.step},
                        {"hash", fmt::format("{:08x}", divergence.found)},
                        {"recorded", fmt::format("{:08x}", divergence.recorded)}};
    if (const auto& place = divergence.place) {
        const auto list = [](const Vec3<double>& at) { return json::Array{at[0], at[1], at[2]}; };
        object.push_back({"particle", json::Object{{"step", place->step},
                                                   {"row", std::uint64_t(place->particle)},
                                                   {"name", place->name},
                                                   {"position", list(place->found)},
                                                   {"recorded", list(place->recorded)}}});
    }
    return object;
}

class ReplayCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "replay",
            .usage = "FILE [--threads N] [--json]",
            .about = "plays a recording without drawing it, and compares every step",
            .details =
                "Exit code 0 if every step ends in the recorded state, to the last bit. Otherwise 1: the first\n"
                "step that does not is told, with both hashes (their lower halves), and the first particle that\n"
                "is elsewhere in the positions that were recorded next. The recording of a program that was\n"
                "killed is played up to its last complete step; a damaged one is refused, with the place.\n",
            .examples = "sinew replay fall.rec\n"
                        "sinew replay fall.rec --json | jq .divergence.step\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_scene(parser, words);
        declare_whole(parser, "--threads", threads, {1, 1024}, "N", "how many work on a step; else one for each core");
        declare_flag(parser, "--json", as_json, "ends with one line of JSON");
    }

    int run() override {
        if (!words.overrides.empty()) usage_error("key=value is for scenes: a recording goes on as it was recorded");
        auto file = read_recording_file(words.scene);
        auto& replay = file.replay;
        replay.session().set_options({.threads = threads.value_or(0)});
        canvas::catch_interrupts();
        canvas::Progress progress("replay", std::size_t(file.steps));
        while (replay.step()) {
            give_up_if_interrupted();
            progress.update(std::size_t(replay.steps()));
        }
        tell(file);
        return replay.divergence() ? bad_input : done;
    }

    void tell(const RecordingFile& file) const {
        const auto& divergence = file.replay.divergence();
        if (file.cut_short)
            print_error(fmt::format("{}: ends within an entry, at byte {}: played up to step {}\n", words.scene,
                                    *file.cut_short, file.steps));
        if (as_json) {
            json::Object object{{"file", words.scene},
                                {"steps", file.replay.steps()},
                                {"hash", fmt::format("{:016x}", file.replay.session().report().hash)},
                                {"cut_short", file.cut_short.has_value()},
                                {"same", !divergence}};
            if (divergence) object.push_back({"divergence", json_of(*divergence)});
            print(to_line(object));
        } else if (divergence) {
            print_error(fmt::format("{}: {}\n", words.scene, text_of(*divergence)));
        } else {
            print(fmt::format("{}: {} steps, all as recorded\n", words.scene, file.replay.steps()));
        }
    }

    SceneWords words;
    std::optional<int> threads;
    bool as_json = false;
};

} // namespace

std::unique_ptr<Command> command::replay() {
    return std::make_unique<ReplayCommand>();
}

} // namespace sinew::cli
