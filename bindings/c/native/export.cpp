#include "sinew/math/color.h"
#include "sinew/scene/text.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"
#include "files/out/export_formats.h"
#include "files/out/frame_name.h"

#include <cmath>

/// Files of other programs, kept in memory.
using namespace sinew;
using namespace sinew::c;

namespace {

struct Export {
    const files::ExportFormat* format = nullptr;
    files::ExportRequest request{};
    std::unique_ptr<files::Exporter> exporter{};              ///< from the first frame on
    std::vector<std::pair<std::string, std::string>> files{}; ///< name and bytes
    std::uint32_t world = 0;                                  ///< handle of the simulation of the first frame
    bool is_finished = false;
};

Handles<Export>& exports() {
    static Handles<Export> open;
    return open;
}

/// Calls work(export) and returns its status; fails for an unknown handle.
template <class Work> sinew_status with(sinew_export handle, const Work& work) {
    auto* known = exports().find(handle.id);
    return known ? work(*known) : bad_handle();
}

sinew_status fail_argument(std::string message) {
    return fail(SINEW_BAD_ARGUMENT, std::move(message));
}

/// A format of bytes; null for one of pictures, which nothing here paints.
const files::ExportFormat* format_called(const std::filesystem::path& path) {
    const auto* const format = files::export_format_of(path);
    return format && !format->is_painted ? format : nullptr;
}

std::string endings() {
    std::string text;
    for (const auto& format : files::export_formats())
        if (!format.is_painted) text += concat(text.empty() ? "" : ", ", format.ending);
    return text;
}

sinew_status take_format(const char* name, Export& made) {
    const std::filesystem::path path(name);
    made.format = format_called(path);
    if (!made.format) return fail_argument(concat("the ending of ", in_quotes(name), " is none of ", endings()));
    if (auto problem = files::frame_number_problem(path)) return fail_argument(*problem);
    if (made.format->frames == files::FramesPerFile::all && files::has_frame_number(path))
        return fail_argument(concat("a ", made.format->ending, " holds all frames: leave out the number"));
    made.request.path = path;
    made.request.fps = made.format->usual_fps;
    made.request.size = {};
    return SINEW_OK;
}

sinew_status take_numbers(const sinew_export_spec& spec, files::ExportRequest& request) {
    if (!std::isfinite(spec.fps) || spec.fps < 0 || spec.fps > 1000) return fail_argument("fps is 0 to 1000");
    if (!std::isfinite(spec.error) || spec.error < 0) return fail_argument("an error is finite and not negative");
    if (spec.width > 16384 || spec.height > 16384) return fail_argument("the sides of a picture are 1 to 16384 pixels");
    if (spec.fps > 0) request.fps = spec.fps;
    if (spec.error > 0) request.tolerance = spec.error;
    request.size = {int(spec.width), int(spec.height)};
    return SINEW_OK;
}

sinew_status take_words(const sinew_export_spec& spec, files::ExportRequest& request) {
    if (spec.figure_count > 0 && !spec.figures) return null_argument();
    for (std::uint32_t i = 0; i < spec.figure_count; ++i) {
        if (!spec.figures[i]) return null_argument();
        request.figures.emplace_back(spec.figures[i]);
    }
    if (spec.background) {
        request.background = parse_color(spec.background);
        if (!request.background) return fail_argument(concat(in_quotes(spec.background), " is not a colour"));
    }
    if (spec.follow) request.follow = spec.follow;
    if (spec.caption) request.caption = spec.caption;
    return SINEW_OK;
}

/// Opens the exporter for the simulation of the first frame.
sinew_status open(Export& made, const Session& session) {
    auto& request = made.request;
    for (const auto& name : files::figures_named(request))
        if (!files::has_figure(session, name))
            return fail(SINEW_NOT_FOUND, concat("there is no figure called ", in_quotes(name)));
    for (std::size_t axis = 0; axis < 2; ++axis)
        if (request.size[axis] == 0) request.size[axis] = session.scene().view.size[axis];
    request.take = [&made](const std::filesystem::path& path, std::string_view bytes) -> files::Failure {
        made.files.emplace_back(path.string(), bytes);
        return {};
    };
    made.exporter = made.format->open(request);
    return SINEW_OK;
}

} // namespace

extern "C" {

sinew_status sinew_export_begin(const char* name, const sinew_export_spec* given, sinew_export* handle) {
    if (!name || !handle) return null_argument();
    sinew_export_spec spec{};
    if (given)
        if (const auto status = take(given, spec)) return status;
    auto made = std::make_unique<Export>();
    if (const auto status = take_format(name, *made)) return status;
    if (const auto status = take_numbers(spec, made->request)) return status;
    if (const auto status = take_words(spec, made->request)) return status;
    const auto id = exports().add(std::move(made));
    if (id == 0) return fail(SINEW_FULL, "too many open exports");
    handle->id = id;
    return SINEW_OK;
}

sinew_status sinew_export_frame(sinew_export handle, sinew_world simulation) {
    return with(handle, [&](Export& made) {
        return read(simulation, [&](const Simulation&, const Session& session) {
            if (made.is_finished) return fail_argument("the export is finished");
            if (!made.exporter) {
                if (const auto status = open(made, session)) return status;
                made.world = simulation.id;
            }
            if (made.world != simulation.id) return fail_argument("the frames before are of another world");
            if (auto failure = made.exporter->frame(session)) return fail_argument(*failure);
            return SINEW_OK;
        });
    });
}

sinew_status sinew_export_finish(sinew_export handle, uint32_t* count) {
    if (!count) return null_argument();
    return with(handle, [&](Export& made) {
        if (!made.exporter) return fail_argument("the export has no frame");
        if (!made.is_finished)
            if (auto failure = made.exporter->finish()) return fail_argument(*failure);
        made.is_finished = true;
        *count = std::uint32_t(made.files.size());
        return SINEW_OK;
    });
}

sinew_status sinew_export_file(sinew_export handle, uint32_t index, const char** name, const uint8_t** bytes,
                               size_t* size) {
    if (!name || !bytes || !size) return null_argument();
    return with(handle, [&](const Export& made) {
        if (!made.is_finished || index >= made.files.size())
            return fail(SINEW_NOT_FOUND, "there are fewer finished files");
        const auto& [path, content] = made.files[index];
        *name = path.c_str();
        *bytes = reinterpret_cast<const uint8_t*>(content.data());
        *size = content.size();
        return SINEW_OK;
    });
}

sinew_status sinew_export_note(sinew_export handle, uint32_t index, const char** note) {
    if (!note) return null_argument();
    return with(handle, [&](const Export& made) {
        if (!made.exporter || index >= made.exporter->notes().size())
            return fail(SINEW_NOT_FOUND, "there are fewer notes");
        *note = made.exporter->notes()[index].c_str();
        return SINEW_OK;
    });
}

sinew_status sinew_export_close(sinew_export handle) {
    return exports().remove(handle.id) ? SINEW_OK : bad_handle();
}

} // extern "C"
