#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/scrap.h"
#include "apps/cli/session_file.h"
#include "apps/cli/stepping.h"
#include "canvas/interrupt.h"
#include "player/files.h"
#include "player/recording.h"

#include <fmt/format.h>

namespace sinew::cli {
namespace {

/// Writes the session's log to a file.
class RecordingWitness final : public Witness {
  public:
    RecordingWitness(const std::string& path, const Session& session, const std::string& from)
        : recorder_(play::append_to(path), session, from) {
        check();
    }
    void act(const play::Action& action, const Session& session) override {
        recorder_.act(action, session);
        check();
    }
    void step(const Session& session) override {
        recorder_.step(session);
        check();
    }

  private:
    play::Recorder recorder_;

    void check() const { settle(recorder_.failure()); }
};

class RecordCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "record",
            .usage = "SCENE -o FILE [--seconds S] [--pointer FILE] [--threads N] [key=value...]",
            .about = "steps a scene and records it: the scene, all input, and a hash of every step",
            .details = "The file grows with each step, and holds all up to the last one whatever ends the program.\n"
                       "`sinew replay` plays it anywhere, and tells the first step that comes out otherwise;\n"
                       "`sinew play` shows it. A scene can be a snapshot (sinew run --save).\n",
            .examples = "sinew record ragdoll -o fall.rec --seconds 10\n"
                        "sinew record chains mode=classic --pointer mouse.csv -o chains.rec\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_scene(parser, words);
        declare_text(parser, "-o,--output", output, "FILE", "where to");
        declare_number(parser, "-s,--seconds", seconds, possible_seconds, "S",
                       "until when, from the scene's start; else what the scene says");
        declare_whole(parser, "--threads", threads, {1, 1024}, "N", "how many work on a step; else one for each core");
        declare_text(parser, "--pointer", pointer_path, "FILE", "plays a pointer's path: time, x, y, button a line");
    }

    int run() override {
        if (output.empty()) usage_error("no file to record to", "-o FILE");
        if (output == "-") usage_error("a recording grows in a file, not in a pipe", "-o FILE");
        auto opened = open_session(words);
        std::error_code unknown;
        const auto input = is_snapshot_file(words.scene) ? std::filesystem::path(words.scene) : scene_path(words.scene);
        if (std::filesystem::equivalent(input, output, unknown))
            refuse(output, "this is the file that is recorded", "-o with another name");
        Run run(std::move(opened.session), threads.value_or(0));
        if (seconds) run.expect_ahead("--seconds", *seconds);
        if (!pointer_path.empty()) run.pointer = PointerPath::read(pointer_path);
        canvas::catch_interrupts();
        run.witness = std::make_shared<RecordingWitness>(output, run.session, opened.from);
        const auto& scene = run.session.scene();
        const auto begun = run.steps(), last = steps_until(scene, seconds.value_or(scene.seconds));
        canvas::Progress progress(title_of(words.scene), std::size_t(last));
        run.advance(last, progress);
        const auto size = std::filesystem::file_size(output);
        print(fmt::format("{}: {} steps, {} bytes\n", output, run.steps() - begun, size));
        return done;
    }

    SceneWords words;
    std::optional<double> seconds;
    std::optional<int> threads;
    std::string output, pointer_path;
};

} // namespace

std::unique_ptr<Command> command::record() {
    return std::make_unique<RecordCommand>();
}

} // namespace sinew::cli
