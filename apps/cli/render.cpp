#include "sinew/scene/diagnostic.h"
#include "sinew/scene/text.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/stepping.h"
#include "canvas/formats.h"
#include "canvas/interrupt.h"
#include "canvas/sheet.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

/// Times, in seconds, of the frames of a file.
struct Frames {
    double first = 0;
    double between = 0;
    std::size_t count = 1;
    double end = first;

    double time(std::size_t frame) const { return first + between * double(frame); }
};

/// What is asked for, as far as options say it.
struct Wishes {
    std::optional<double> seconds, fps, at;
    std::optional<std::array<int, 2>> size, sheet;
    std::string overlay;
};

/// A picture of a scene that says nothing else shows it at this part of its time: something has happened, and it is
/// not over.
constexpr double telling_moment = 0.2;

double duration(const Wishes& wishes, const Scene& scene) {
    return wishes.seconds.value_or(scene.seconds);
}

Frames still_frame(const Wishes& wishes, const Scene& scene) {
    return {.first = wishes.at.value_or(wishes.seconds.value_or(telling_moment * scene.seconds))};
}

Frames film_frames(const Wishes& wishes, const Scene& scene, double fps) {
    const auto count = std::fmax(std::round(duration(wishes, scene) * fps), 1);
    const auto first = wishes.at.value_or(0);
    return {first, 1 / fps, std::size_t(count), first + count / fps};
}

/// The last frame is the end.
Frames sheet_frames(const Wishes& wishes, const Scene& scene) {
    const auto count = std::size_t((*wishes.sheet)[0]) * std::size_t((*wishes.sheet)[1]);
    const auto first = wishes.at.value_or(0), length = duration(wishes, scene);
    return {first, count > 1 ? length / double(count - 1) : 0, count, first + length};
}

/// A file that was begun, and what goes into it.
struct Job {
    std::unique_ptr<canvas::Writer> writer;
    Frames frames;
    std::array<int, 2> size{};
};

/// What an interruption made fail is not told as a failure.
void settle(const canvas::Failure& failure) {
    give_up_if_interrupted();
    if (failure) refuse("sinew", *failure);
}

std::unique_ptr<canvas::Writer> checked(canvas::Opened opened) {
    settle(opened.failure);
    return std::move(opened.writer);
}

Job begin_sheet(const std::string& path, const Wishes& wishes, const Scene& scene) {
    constexpr double usual_width = 320;
    const auto [width, height] = scene.view.size;
    const auto usual_height = int(std::fmax(std::round(usual_width * height / width), 1));
    const auto size = wishes.size.value_or(std::array{int(usual_width), usual_height});
    const auto [columns, rows] = *wishes.sheet;
    const auto frames = sheet_frames(wishes, scene);
    const canvas::SheetFormat format{columns, rows, size[0], size[1], frames.first, frames.between};
    return {checked(canvas::open_sheet(path, format)), frames, size};
}

Job begin_file(const std::string& path, const Wishes& wishes, const Scene& scene) {
    if (wishes.sheet) return begin_sheet(path, wishes, scene);
    const auto size = wishes.size.value_or(scene.view.size);
    const auto* kind = canvas::format_of(path);
    const double fps = wishes.fps.value_or(kind ? kind->usual_fps : 60);
    auto writer = checked(canvas::open(path, {size[0], size[1], fps})); // refuses a kind that it does not know
    return {std::move(writer), kind->moves ? film_frames(wishes, scene, fps) : still_frame(wishes, scene), size};
}

/// The overlays that a list like "strain,names" asks for.
OverlaySet overlay_of(const std::string& list) {
    OverlaySet set;
    for (std::size_t begin = 0; begin < list.size();) {
        const auto end = std::min(list.find(',', begin), list.size());
        const auto word = list.substr(begin, end - begin);
        const auto found = std::ranges::find(overlays, word, &Overlay::name);
        if (found == overlays.end()) {
            std::vector<std::string_view> names;
            for (const auto& overlay : overlays) names.push_back(overlay.name);
            misused(fmt::format("there is no overlay called {}", in_quotes(word)), suggest(word, std::move(names)));
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

void write_frames(Job& job, Run& run, OverlaySet overlay, const std::string& label) {
    Picture picture;
    picture.width = job.size[0];
    picture.height = job.size[1];
    const auto steps_at = [&](std::size_t frame) { return steps_before(run.session.scene(), job.frames.time(frame)); };
    canvas::Progress progress(label, std::size_t(steps_at(job.frames.count - 1)));
    for (std::size_t frame = 0; frame < job.frames.count; ++frame) {
        run.advance(steps_at(frame), progress);
        run.session.draw(picture, overlay);
        settle(job.writer->frame(picture));
    }
    settle(job.writer->finish());
}

std::string bytes_text(std::uintmax_t bytes) {
    if (bytes < 1000) return fmt::format("{} bytes", bytes);
    if (bytes < 1000 * 1000) return fmt::format("{:.0f} kB", double(bytes) / 1e3);
    return fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

std::string written_text(const std::string& path, const Job& job) {
    const auto& frames = job.frames;
    std::error_code unknown;
    const auto bytes = bytes_text(std::filesystem::file_size(path, unknown));
    const auto size = fmt::format("{}x{}", job.size[0], job.size[1]);
    if (frames.count == 1) return fmt::format("{}: {} at {:.4g} s, {}\n", path, size, frames.first, bytes);
    return fmt::format("{}: {} frames of {} from {:.4g} to {:.4g} s, {}\n", path, frames.count, size, frames.first,
                       frames.end, bytes);
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
                        "sinew render ragdoll -o slow.mp4 --fps 60 solver.rate=240 mode=classic view.theme=dark\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_scene(parser, words);
        declare_text(parser, "-o,--output", path, "FILE", "file to write, replaced where it exists; else out/NAME.png");
        declare_number(parser, "-s,--seconds", wishes.seconds, possible_seconds, "S",
                       "how long; else what the scene says");
        declare_number(parser, "--fps", wishes.fps, {1e-3, 1000}, "F", "frames a second of a film");
        declare_pair(parser, "--size", wishes.size, "WxH", "pixels of a frame; else what the scene says");
        declare_number(parser, "--at", wishes.at, possible_seconds, "T",
                       "the second that a picture shows, or that a film or sheet begins at");
        declare_pair(parser, "--sheet", wishes.sheet, "CxR", "columns and rows of frames on one picture");
        declare_text(parser, "--pointer", pointer_path, "FILE", "plays a pointer's path: time, x, y, button a line");
        declare_text(parser, "--overlay", wishes.overlay, "A,B", "what to lay over it to see into the world");
    }

    int run() override {
        const auto overlay = overlay_of(wishes.overlay);
        Run run(open_file(words.scene, words.overrides));
        if (!pointer_path.empty()) run.pointer = PointerPath::read(pointer_path);
        if (path.empty()) path = fmt::format("out/{}.png", title_of(words.scene));
        canvas::catch_interrupts();
        auto job = begin_file(path, wishes, run.session.scene());
        write_frames(job, run, overlay, path);
        print(written_text(path, job));
        return done;
    }

    std::string details = "The extension says what is written:\n\n" + kinds_text() +
                          "\nAn overlay is one or more of these:\n\n" + overlays_text() +
                          "\nThe scene moves at its own rate; a frame shows the last step before it is due. A picture\n"
                          "without --at is taken at --seconds, or else after a fifth of the scene's time.\n"
                          "A pointer's path is explained by `sinew help run`.\n"
                          "Films need ffmpeg. A file appears under its name when it is complete, or not at all.\n";
    SceneWords words;
    std::string path, pointer_path;
    Wishes wishes;
};

} // namespace

std::unique_ptr<Command> command::render() {
    return std::make_unique<RenderCommand>();
}

} // namespace sinew::cli
