// Files of the player (player/files.h), of exports (files/out/) and of pictures (canvas/) where there are none: on a
// page, and in the C face.
#include "canvas/formats.h"
#include "files/out/export_formats.h"
#include "player/files.h"

namespace sinew {
namespace {

constexpr const char* no_files = "there are no files here";

} // namespace

namespace play {

std::filesystem::file_time_type time_written(const std::filesystem::path&) {
    return {};
}

canvas::Failure write_file(const std::filesystem::path&, const std::string&) {
    return no_files;
}

std::function<canvas::Failure(std::span<const std::byte>)> append_to(const std::filesystem::path&) {
    return [](std::span<const std::byte>) { return canvas::Failure(no_files); };
}

std::filesystem::path new_file_in(const std::filesystem::path&, const std::string&, const std::string&, std::size_t) {
    return {};
}

void remove_file(const std::filesystem::path&) {}

std::filesystem::path free_path(const std::filesystem::path& wanted) {
    return wanted;
}

std::optional<std::string> read_file(const std::filesystem::path&, std::size_t) {
    return std::nullopt;
}

std::string full_path(const std::filesystem::path& path) {
    return path.string();
}

} // namespace play

namespace files {

Failure write_file(const std::filesystem::path&, std::string_view) {
    return no_files;
}

std::unique_ptr<Exporter> open_alpha_film(const ExportRequest&) {
    return nullptr;
}

std::unique_ptr<Exporter> open_pictures(const ExportRequest&) {
    return nullptr;
}

} // namespace files

namespace canvas {

Opened open(const std::filesystem::path&, const FrameFormat&) {
    return {nullptr, no_files};
}

Failure Writer::frame(const Picture&) {
    return no_files;
}

Failure Writer::finish() {
    return no_files;
}

void PartialFile::discard() {}

} // namespace canvas
} // namespace sinew
