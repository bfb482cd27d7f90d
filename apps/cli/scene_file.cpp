#include "apps/cli/scene_file.h"

#include "sinew/scene/text.h"
#include "sinew/snapshot/snapshot.h"

#include "apps/cli/catalogue.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "canvas/png.h"
#include "player/recording_format.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

/// True for bare words; a word with a dot or a slash is a path.
bool is_name(const std::string& word) {
    return word.find_first_of("./") == std::string::npos;
}

[[noreturn]] void refuse_name(const std::string& word) {
    const auto names = catalogue_names();
    const auto message = fmt::format("no scene is called {}", in_quotes(word));
    if (names.empty())
        refuse(
            "sinew", message,
            fmt::format("the catalogue, {}, is empty; SINEW_SCENES=FOLDER names another", catalogue_folder().string()));
    refuse("sinew", message, suggest(word, {names.begin(), names.end()}));
}

/// Path of a scene; a name in the catalogue precedes a file of the same name.
fs::path path_of(const std::string& word) {
    if (!is_name(word)) return word;
    std::error_code unknown;
    if (const auto path = catalogue_path(word); fs::exists(path, unknown)) return path;
    if (fs::exists(word, unknown)) return word;
    refuse_name(word);
}

struct ReadText {
    std::string text, problem, help;
};

/// Reads at most `max` bytes, and one more to detect a longer file.
ReadText read_bytes(std::FILE* file, std::size_t max) {
    std::string text;
    while (text.size() <= max) {
        char block[16384];
        const auto wanted = std::min(sizeof block, max + 1 - text.size());
        const auto read = std::fread(block, 1, wanted, file);
        text.append(block, read);
        if (std::ferror(file)) return {"", std::strerror(errno), ""};
        if (read < wanted) return {std::move(text), "", ""};
    }
    return {"", fmt::format("more than {} bytes", max), "limits.bytes=N allows more"};
}

std::string read_at_most(std::FILE* file, const std::string& name, std::size_t max) {
    auto [text, problem, help] = read_bytes(file, max);
    if (!problem.empty()) refuse(name, problem, help);
    return std::move(text);
}

/// Reads the OBJ file at `path`, called `name` in messages.
ReadModel read_model_at(const fs::path& path, const std::string& name, const Limits& limits) {
    const auto refused = [&](std::string_view problem, std::string help = {}) {
        return ReadModel{nullptr, fmt::format("{}: {}", printable(name), problem), std::move(help)};
    };
    std::error_code unknown;
    if (fs::is_directory(path, unknown)) return refused("a folder, not an OBJ file");
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) return refused(std::strerror(errno));
    const auto [text, problem, help] = read_bytes(file.get(), std::size_t(limits.bytes));
    if (!problem.empty()) return refused(problem, help);
    return read_model(text, name, limits);
}

[[noreturn]] void refuse_path(const fs::path& path, int reason) {
    const auto names = catalogue_names();
    const std::vector<std::string_view> views(names.begin(), names.end());
    const auto meant = reason == ENOENT ? nearest(path.stem().string(), views) : std::string_view();
    refuse(path.string(), std::strerror(reason), meant.empty() ? "" : fmt::format("the catalogue has {}", meant));
}

std::string read_path(const fs::path& path, std::size_t max) {
    std::error_code unknown;
    if (fs::is_directory(path, unknown)) refuse(path.string(), "a folder, not a scene file");
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) refuse_path(path, errno);
    return read_at_most(file.get(), path.string(), max);
}

/// Standard input can be read only once: later calls return the same text.
const std::string& standard_input(std::size_t max) {
    static const std::string text = read_at_most(stdin, "<stdin>", max);
    return text;
}

/// Limit of a scene file's bytes, from the overrides alone.
std::size_t bytes_allowed(std::span<const Override> overrides) {
    return std::size_t(load("{}", {}, overrides).limits.bytes);
}

void refuse_other_files(const std::string& text, const std::string& name) {
    const auto bytes = std::as_bytes(std::span(text));
    if (is_snapshot(bytes))
        refuse(name, "a snapshot, not a scene", "sinew run FILE goes on from it; sinew diff compares it with another");
    if (play::is_recording(bytes))
        refuse(name, "a recording, not a scene", "sinew replay FILE plays it; sinew play FILE shows it");
}

} // namespace

Document open_document(const std::string& word, std::span<const Override> overrides) {
    const auto max = bytes_allowed(overrides);
    const auto name = word == "-" ? "<stdin>" : path_of(word).string();
    const auto text = word == "-" ? standard_input(max) : read_path(name, max);
    refuse_other_files(text, name);
    return load(text, name, overrides);
}

namespace {

/// Builds the scene of a document. Images and models are looked up in `folder` and noted in `read`.
Opened open_in(const fs::path& folder, Document document, WatchedFiles* read = nullptr) {
    const auto note = [&](const fs::path& path) {
        if (read) read->add(path);
    };
    const auto read_image = [&](const std::string& name, const Limits& limits) {
        note(folder / name);
        return canvas::read_png(folder / name, name, limits);
    };
    const auto read_obj_file = [&](const std::string& name, const Limits& limits) {
        note(folder / name);
        return read_model_at(folder / name, name, limits);
    };
    auto opened = open_scene(document, read_image, read_obj_file);
    const PrintStyle style{.color = has_color(stderr), .max = std::size_t(document.limits.errors)};
    print_error(warnings_text(document.diagnostics, style));
    if (opened) return std::move(*opened);
    throw CommandError{bad_input, to_text(document.diagnostics, style)};
}

} // namespace

Opened open_file(const std::string& word, std::span<const Override> overrides, WatchedFiles* read) {
    if (word != "-" && read) read->add(path_of(word));
    return open_in(word == "-" ? fs::path(".") : path_of(word).parent_path(), open_document(word, overrides), read);
}

Opened open_text(const std::string& text, const std::string& name, const fs::path& folder,
                 std::span<const Override> overrides) {
    return open_in(folder, load(text, name, overrides));
}

fs::path scene_path(const std::string& word) {
    return word == "-" ? fs::path() : path_of(word);
}

std::string read_text(const fs::path& path, std::size_t max) {
    std::error_code unknown;
    if (fs::is_directory(path, unknown)) refuse(path.string(), "a folder, not a file");
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) refuse(path.string(), std::strerror(errno));
    auto read = read_bytes(file.get(), max);
    if (!read.problem.empty()) refuse(path.string(), read.problem);
    return std::move(read.text);
}

std::string title_of(const std::string& word) {
    const auto stem = fs::path(word).stem().string();
    return word == "-" || stem.empty() ? "scene" : stem;
}

} // namespace sinew::cli
