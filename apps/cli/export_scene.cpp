#include "sinew/math/color.h"
#include "sinew/scene/diagnostic.h"
#include "sinew/scene/text.h"
#include "sinew/world/edit.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/export_wishes.h"
#include "apps/cli/imported_file.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/scrap.h"
#include "apps/cli/stepping.h"
#include "canvas/formats.h"
#include "canvas/interrupt.h"
#include "files/in/posed_model.h"
#include "files/out/export_formats.h"
#include "files/out/frame_name.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> words_of(const std::string& list) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin < list.size();) {
        const auto end = std::min(list.find(',', begin), list.size());
        words.push_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

std::vector<std::string> figure_names(const AnyWorld& world) {
    std::vector<std::string> names;
    std::visit(
        [&](const auto& any) {
            for (const auto& figure : any.figures)
                if (figure.in_use()) names.push_back(figure.name);
        },
        world);
    return names;
}

void check_figure(const std::string& word, const AnyWorld& world) {
    const auto known = figure_names(world);
    if (std::ranges::find(known, word) == known.end())
        refuse("sinew", fmt::format("there is no figure called {}", in_quotes(word)),
               suggest(word, {known.begin(), known.end()}));
}

std::string formats_text() {
    std::string text;
    for (const auto& format : files::export_formats())
        text += fmt::format("  {:6} {:9} {}\n", format.ending,
                            format.frames == files::FramesPerFile::one ? "a frame" : "all", format.about);
    return text;
}

std::string count_text(std::size_t frames, double first, double end) {
    if (frames == 1) return fmt::format("the moment at {:.4g} s", first);
    return fmt::format("{} frames from {:.4g} to {:.4g} s", frames, first, end);
}

class ExportCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "export",
            .usage = "SCENE -o FILE [options] [key=value...]",
            .about = "writes a scene as a file of other programs: models, vectors, film",
            .details = details,
            .examples = "sinew export cloth3d -o silk.pc2 --seconds 4 --fps 24\n"
                        "sinew export curtain -o frames/curtain-%04d.obj --seconds 4\n"
                        "sinew export rope -o rope.glb\n"
                        "sinew export human.json -o fall.glb --model human.glb\n"
                        "sinew export ragdoll -o ragdoll.json --seconds 3 --error 0.5\n"
                        "sinew export ragdoll -o ragdoll.svg --seconds 3 view.plain=true\n"
                        "sinew export ragdoll -o frames/%04d.png --background none --follow bob --scale 2\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_scene(parser, words);
        declare_text(parser, "-o,--output", path, "FILE", "file to write, replaced where it exists");
        declare_text(parser, "--format", format_name, "NAME", "in place of the file's ending, such as obj");
        declare_number(parser, "-s,--seconds", seconds, possible_seconds, "S", "how long; else what the scene says");
        declare_number(parser, "--fps", fps, {1e-3, 1000}, "F", "frames a second; else what is usual for the format");
        declare_number(parser, "--at", at, possible_seconds, "T", "the second of the first frame, or of the only one");
        declare_text(parser, "--of", figures, "A,B", "figures by name, alone; else everything");
        declare_whole(parser, "--joints", joints, {1, 1000}, "N",
                      "of a .glb: so many carry a moving mesh, for engines; else a morph target a key");
        declare_text(parser, "--model", model, "FILE",
                     "of a .glb: the glTF model whose skeleton was imported, moved with its meshes");
        declare_text(parser, "--until", until, "EVENT", "ends at the first event of this kind: torn, cut, hit ...");
        declare_pair(parser, "--size", size, "WxH", "pixels of a picture; else what the scene says");
        declare_number(parser, "--scale", scale, {0.01, 100}, "X", "of a picture: so many times the size");
        declare_text(parser, "--background", background, "COLOR", "of a picture; none: transparent");
        declare_text(parser, "--follow", follow, "FIGURE", "of a picture: keeps the figure in its middle");
        declare_text(parser, "--caption", caption, "TEXT", "of a picture: a line at the bottom");
        declare_number(
            parser, "--error", tolerance, {0, 1000}, "E",
            "by which points may be off between keys: pixels of vectors, else 0.25; mm of a .glb, else 0.01");
    }

    int run() override {
        if (path.empty()) usage_error("nothing says what to write", "such as: -o silk.pc2 (see sinew export --help)");
        const auto& format = chosen_format();
        settle(files::frame_number_problem(path));
        canvas::catch_interrupts();
        Run run(open_file(words.scene, words.overrides));
        if (!until.empty()) check_until(until, run.session.scene());
        auto request = request_for(format, run.session);
        const auto exporter = model.empty() ? format.open(request) : posed_model(format, request);
        write_frames(run, format, request.fps, *exporter);
        settle(exporter->finish());
        print(report(*exporter, unused_wishes(format, request, size || scale)));
        return done;
    }

    std::unique_ptr<files::Exporter> posed_model(const files::ExportFormat& format,
                                                 const files::ExportRequest& request) const {
        if (format.ending != ".glb") usage_error("only a .glb takes a model along", "-o FILE.glb");
        try {
            return files::open_posed_model(request, read_import(model));
        } catch (const files::ImportError& error) {
            refuse(model, error.place.empty() ? error.message : error.place + ": " + error.message, error.help);
        }
    }

    const files::ExportFormat& chosen_format() const {
        const auto* const format = files::export_format_of(path, format_name);
        if (format && format->frames == files::FramesPerFile::all && files::has_frame_number(path))
            usage_error(fmt::format("a {} holds all frames", format->ending), "leave out the number: %04d");
        if (format) return *format;
        std::vector<std::string_view> names;
        for (const auto& each : files::export_formats()) names.push_back(format_name.empty() ? each.ending : each.name);
        const auto found = format_name.empty() ? canvas::extension_of(path) : format_name;
        usage_error(fmt::format("there is no format called {}", in_quotes(found)), suggest(found, std::move(names)));
    }

    files::ExportRequest request_for(const files::ExportFormat& format, const Session& session) const {
        files::ExportRequest request{.path = path, .fps = fps.value_or(format.usual_fps)};
        request.figures = words_of(figures);
        for (const auto& figure : request.figures) check_figure(figure, session.world());
        if (!follow.empty()) check_figure(follow, session.world());
        request.size = picture_size(session.scene());
        request.background = background_color();
        request.follow = follow, request.caption = caption, request.tolerance = tolerance;
        request.joints = joints ? std::size_t(*joints) : 0;
        return request;
    }

    std::array<int, 2> picture_size(const Scene& scene) const {
        auto [width, height] = size.value_or(scene.view.size);
        const double factor = scale.value_or(1);
        const std::array scaled = {int(std::round(width * factor)), int(std::round(height * factor))};
        constexpr int longest = 16384; // pixels, as for the PNGs of `render`
        settle(canvas::size_problem("an exported picture", scaled[0], scaled[1], longest));
        return scaled;
    }

    std::optional<Color> background_color() const {
        if (background.empty()) return std::nullopt;
        const auto color = parse_color(background);
        if (!color)
            usage_error(fmt::format("{} is not a colour", in_quotes(background)), "such as none, white or #fa0");
        return color;
    }

    /// Steps the scene and hands its frames over: one at the end of the time, or all.
    void write_frames(Run& run, const files::ExportFormat& format, double rate, files::Exporter& exporter) {
        const auto& scene = run.session.scene();
        const double length = seconds.value_or(scene.seconds);
        const bool is_film = format.frames == files::FramesPerFile::all || files::has_frame_number(path);
        const double first = at.value_or(is_film ? 0 : length);
        count = is_film ? std::size_t(std::fmax(std::round(length * rate), 1)) : 1;
        begin = first, end = is_film ? first + double(count) / rate : first;
        canvas::Progress progress(path, std::size_t(steps_before(scene, first + double(count - 1) / rate)));
        if (!is_film && !until.empty()) {
            begin = end = seconds_of_event(run, steps_before(scene, first), progress);
            return settle(exporter.frame(run.session));
        }
        for (std::size_t frame = 0; frame < count; ++frame) {
            run.advance(steps_before(scene, first + double(frame) / rate), progress);
            settle(exporter.frame(run.session));
            if (!until.empty() && has_happened(run.session)) {
                count = frame + 1, end = first + double(count) / rate;
                return;
            }
        }
        if (!until.empty()) refuse_until();
    }

    /// Steps to the first event asked for; the moment of it.
    double seconds_of_event(Run& run, std::uint64_t last, canvas::Progress& progress) {
        for (std::uint64_t step = 0; step <= last; ++step) {
            run.advance(step, progress);
            if (has_happened(run.session)) return run.session.seconds();
        }
        refuse_until();
    }

    [[noreturn]] void refuse_until() const {
        refuse("sinew", fmt::format("no event {} happens until {:.4g} s", in_quotes(until), end));
    }

    bool has_happened(const Session& session) const {
        return std::ranges::find(session.happenings(), until, &SessionEvent::what) != session.happenings().end();
    }

    std::string report(const files::Exporter& exporter, const std::vector<std::string>& unused) const {
        const auto& written = exporter.written();
        std::uintmax_t bytes = 0;
        std::error_code unknown;
        for (const auto& file : written) bytes += fs::file_size(file, unknown);
        auto text = fmt::format("{}: {}, {} kB", path, count_text(count, begin, end), (bytes + 999) / 1000);
        if (written.size() > 1) text += fmt::format(" in {} files", written.size());
        text += '\n';
        for (const auto* const notes : {&exporter.notes(), &unused})
            for (const auto& note : *notes) text += fmt::format("  note: {}\n", note);
        return text;
    }

    std::string details =
        "The file's ending says what is written, and whether a file holds a frame or all of them:\n\n" +
        formats_text() +
        "\nOf formats with a frame a file, a name with a number is a sequence, counted from 1:\n"
        "cloth-%04d.obj. Without a number it is the moment at --at, or at --seconds.\n"
        "Models are in metres with y upwards, whatever the scene's units are.\n"
        "A file appears under its name when it is complete, or not at all.\n";
    SceneWords words;
    std::string path, format_name, figures, model, until, background, follow, caption;
    std::optional<double> seconds, fps, at, scale, tolerance;
    std::optional<int> joints;
    std::optional<std::array<int, 2>> size;
    std::size_t count = 0; ///< frames written
    double begin = 0, end = 0;
};

} // namespace

std::unique_ptr<Command> command::export_scene() {
    return std::make_unique<ExportCommand>();
}

} // namespace sinew::cli
