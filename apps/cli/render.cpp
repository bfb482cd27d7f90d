#include "sinew/scene/diagnostic.h"
#include "sinew/scene/text.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/scrap.h"
#include "apps/cli/shooting.h"
#include "canvas/formats.h"
#include "canvas/interrupt.h"

#include <algorithm>
#include <fmt/format.h>
#include <unistd.h>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

/// Overlays named in a list like "strain,names".
OverlaySet overlay_of(const std::string& list) {
    OverlaySet set;
    for (std::size_t begin = 0; begin < list.size();) {
        const auto end = std::min(list.find(',', begin), list.size());
        const auto word = list.substr(begin, end - begin);
        const auto found = std::ranges::find(overlays, word, &Overlay::name);
        if (found == overlays.end()) {
            std::vector<std::string_view> names;
            for (const auto& overlay : overlays) names.push_back(overlay.name);
            usage_error(fmt::format("there is no overlay called {}", in_quotes(word)), suggest(word, std::move(names)));
        }
        set.set(std::size_t(found - overlays.begin()));
        begin = end + 1;
    }
    return set;
}

std::string overlays_text() {
    std::string text;
    for (const auto& [name, about] : overlays) text += fmt::format("  {:8} {}\n", name, about);
    return text;
}

std::string kinds_text() {
    std::string text;
    for (const auto& format : canvas::formats()) text += fmt::format("  {:6} {}\n", format.extension, format.about);
    return text;
}

class RenderCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "render",
            .usage = "SCENE [-o FILE] [options] [key=value...]",
            .about = "draws a scene into a picture or a film",
            .details = details,
            .examples = "sinew render ragdoll -o ragdoll.mp4\n"
                        "sinew render ragdoll -o ragdoll.gif --seconds 4 --fps 25 --size 320x240\n"
                        "sinew render ragdoll -o ragdoll.svg --at 1.5\n"
                        "sinew render ragdoll -o ragdoll.png --sheet 4x3 --seconds 6\n"
                        "sinew render rope -o rope.png --overlay tension,names\n"
                        "sinew render chains -o both.mp4 --beside classic,physical\n"
                        "sinew render mine.json -o mine.png --watch\n"
                        "sinew render ragdoll -o - --format gif > ragdoll.gif\n"
                        "sinew render ragdoll -o slow.mp4 --fps 60 solver.rate=240 mode=classic view.theme=dark\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_scene(parser, words);
        declare_text(parser, "-o,--output", path, "FILE",
                     "file to write, replaced where it exists; - is standard output; else out/NAME.png");
        declare_text(parser, "--format", format, "KIND", "of standard output, such as gif; else png");
        declare_number(parser, "-s,--seconds", wishes.seconds, possible_seconds, "S",
                       "how long; else what the scene says");
        declare_number(parser, "--fps", wishes.fps, {1e-3, 1000}, "F", "frames a second of a film");
        declare_pair(parser, "--size", wishes.size, "WxH", "pixels of a frame; else what the scene says");
        declare_number(parser, "--at", wishes.at, possible_seconds, "T",
                       "the second that a picture shows, or that a film or sheet begins at");
        declare_pair(parser, "--sheet", wishes.sheet, "CxR", "columns and rows of frames on one picture");
        declare_text(parser, "--pointer", pointer_path, "FILE", "plays a pointer's path: time, x, y, button a line");
        declare_text(parser, "--overlay", overlays_wanted, "A,B", "what to lay over it to see into the world");
        declare_text(parser, "--beside", beside, "A,B", "variants beside each other: modes, or key=value");
        declare_flag(parser, "--watch", watch, "draw again whenever a file of the scene changes; Ctrl+C ends");
    }

    int run() override {
        overlay = overlay_of(overlays_wanted);
        if (!beside.empty()) variants = variants_in(beside);
        check_output();
        if (path.empty()) path = fmt::format("out/{}.png", title_of(words.scene));
        canvas::catch_interrupts();
        if (watch) return draw_again_and_again();
        if (path == "-")
            draw_into_pipe();
        else
            print(draw_into_file(nullptr));
        return done;
    }

    void check_output() const {
        if (watch && (path == "-" || words.scene == "-"))
            usage_error("--watch needs files, not standard input or output");
        if (path != "-" && !format.empty())
            usage_error("--format is for standard output", "of a file the extension says what is written");
        if (path == "-" && isatty(STDOUT_FILENO))
            refuse("sinew", "standard output is a terminal", "lead it into a file or a pipe: ... -o - > picture.png");
    }

    Stage begin_stage(WatchedFiles* read) const {
        Stage stage(words, variants, read);
        if (!pointer_path.empty()) stage.lead_pointer(PointerPath::read(pointer_path));
        return stage;
    }

    /// Renders into the file at path; returns the message for the user.
    std::string draw_into_file(WatchedFiles* read) {
        auto stage = begin_stage(read);
        auto shooting = begin_file(path, path, wishes, stage);
        write_frames(shooting, stage, overlay, path);
        std::error_code unknown;
        return written_text(path, shooting, fs::file_size(path, unknown));
    }

    /// Renders into a scrap file first: standard output receives a complete file or nothing.
    void draw_into_pipe() {
        const std::string called = "standard output";
        const auto kind = fmt::format(".{}", format.empty() ? "png" : format.substr(format.starts_with('.')));
        if (!canvas::format_of("a" + kind)) settle(canvas::check(called + kind, {}));
        auto stage = begin_stage(nullptr);
        const Scrap scrap(fs::temp_directory_path() / "sinew", kind, called);
        auto shooting = begin_file(scrap.path(), called, wishes, stage);
        write_frames(shooting, stage, overlay, called);
        const auto bytes = scrap.bytes();
        print(bytes);
        flush_output();
        print_error(written_text(called, shooting, bytes.size()));
    }

    /// Renders after every change of a file. Errors in the scene or in writing are printed, and watching continues.
    int draw_again_and_again() {
        const auto scene = scene_path(words.scene); // throws if missing
        while (!canvas::interrupted()) {
            WatchedFiles read;
            read.add(scene);
            try {
                print(draw_into_file(&read));
            } catch (const CommandError& problem) {
                if (canvas::interrupted()) break;
                if (problem.code != bad_input) throw;
                print_error(problem.message);
            }
            print(fmt::format("watching {}; Ctrl+C ends\n", words.scene));
            flush_output();
            read.wait_for_change();
        }
        return done;
    }

    std::string details = "The extension says what is written:\n\n" + kinds_text() +
                          "\nAn overlay is one or more of these:\n\n" + overlays_text() +
                          "\nThe scene moves at its own rate; a frame shows the last step before it is due. A picture\n"
                          "without --at is taken at --seconds, or else after a fifth of the scene's time.\n"
                          "--beside draws up to four variants of the scene in one frame, each under its name, in the\n"
                          "same scale (unless a mode has a view of its own) and at the same time: classic,physical or\n"
                          "solver.substeps=1,solver.substeps=16. --size then is that of each.\n"
                          "A pointer's path is explained by `sinew help run`.\n"
                          "Films need ffmpeg. A file appears under its name when it is complete, or not at all.\n";
    SceneWords words;
    std::string path, format, overlays_wanted, beside, pointer_path;
    bool watch = false;
    Wishes wishes;
    OverlaySet overlay;
    std::vector<std::string> variants;
};

} // namespace

std::unique_ptr<Command> command::render() {
    return std::make_unique<RenderCommand>();
}

} // namespace sinew::cli
