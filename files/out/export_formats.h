#pragma once

#include "files/out/exporter.h"

#include <memory>
#include <span>
#include <string_view>

namespace sinew::files {

/// Number of frames in a file.
enum class FramesPerFile : unsigned char { one, all };

struct ExportFormat {
    std::string_view name;   ///< word for --format
    std::string_view ending; ///< of the file's name, with the dot, in lower case
    FramesPerFile frames;
    bool is_painted; ///< by canvas/, and written to disk; else made of the scene, as bytes
    bool is_drawn;   ///< as the scene looks: a picture, vectors or a film; else a model or a trace
    double usual_fps;
    std::string_view about; ///< a line of help
    std::unique_ptr<Exporter> (*open)(const ExportRequest&);
};

/// THE list of formats for export. A new one takes a file with its opener, declared below, and a line in the list.
std::span<const ExportFormat> export_formats();

/// The format of a path: by name where one is given, otherwise by the path's ending. With the number of a frame in the
/// name (%04d) a format of one frame per file goes first, otherwise one that holds all frames. Null if there is none.
const ExportFormat* export_format_of(const std::filesystem::path& path, std::string_view name = {});

/// Openers of the formats.
std::unique_ptr<Exporter> open_alpha_film(const ExportRequest&);
std::unique_ptr<Exporter> open_animated_svg(const ExportRequest&);
std::unique_ptr<Exporter> open_glb(const ExportRequest&);
std::unique_ptr<Exporter> open_obj(const ExportRequest&);
std::unique_ptr<Exporter> open_ply(const ExportRequest&);
std::unique_ptr<Exporter> open_pc2(const ExportRequest&);
std::unique_ptr<Exporter> open_mdd(const ExportRequest&);
std::unique_ptr<Exporter> open_lottie(const ExportRequest&);
std::unique_ptr<Exporter> open_pictures(const ExportRequest&);
std::unique_ptr<Exporter> open_trace_table(const ExportRequest&);
std::unique_ptr<Exporter> open_trace_lines(const ExportRequest&);

} // namespace sinew::files
