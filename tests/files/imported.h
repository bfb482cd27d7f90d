#pragma once

#include "sinew/scene/read_models.h"
#include "sinew/scene/scene.h"

#include "canvas/png.h"
#include "files/in/import.h"
#include "tests/paths.h"
#include "tests/text_of.h"

#include <algorithm>
#include <optional>
#include <span>

/// Imported files as worlds, without writing anything.
namespace sinew::test {

inline files::Imported import_text(const std::string& name, std::string bytes,
                                   const files::ImportOptions& options = {}) {
    return files::import_file({name, "it", std::move(bytes)}, options);
}

/// A file of tests/files: "svg/logo.svg".
inline files::Imported import_sample(const std::string& name, const files::ImportOptions& options = {}) {
    const std::filesystem::path path = std::filesystem::path(source_dir()) / "tests/files" / name;
    return files::import_file({path.filename().string(), "it", text_of(path), path.parent_path()}, options);
}

/// The message of a refused file, after its place: "2:1 | ...".
inline std::string refusal(const std::string& name, std::string bytes, const files::ImportOptions& options = {}) {
    try {
        import_text(name, std::move(bytes), options);
    } catch (const files::ImportError& error) {
        return error.place + " | " + error.message;
    }
    return "accepted";
}

/// The scene as `sinew check` opens it; empty, with the errors in `why`, where it is refused.
inline std::optional<Opened> open_imported(const files::Imported& imported, std::string* why = nullptr) {
    auto document = load(json::to_text(imported.scene), "imported.json");
    const auto bytes_of = [&](const std::string& name) {
        const auto found = std::ranges::find(imported.beside, name, &files::SideFile::name);
        return found == imported.beside.end() ? std::string() : found->bytes;
    };
    const auto image = [&](const std::string& name, const Limits& limits) {
        const auto bytes = bytes_of(name);
        return canvas::read_png(std::as_bytes(std::span(bytes)), name, limits);
    };
    const auto model = [&](const std::string& name, const Limits& limits) {
        return read_model(bytes_of(name), name, limits);
    };
    auto opened = open_scene(document, image, model);
    if (why) *why = to_text(document.diagnostics);
    return opened;
}

inline const json::Value& at(const files::Imported& imported, const std::string& pointer) {
    static json::Value root;
    root = imported.scene;
    const auto* const found = json::find(root, pointer);
    static const json::Value none;
    return found ? *found : none;
}
inline double number_at(const files::Imported& imported, const std::string& pointer) {
    const auto* const number = at(imported, pointer).as<json::Number>();
    return number ? number->value : -1e300;
}
inline std::size_t count_at(const files::Imported& imported, const std::string& pointer) {
    const auto* const list = at(imported, pointer).as<json::Array>();
    return list ? list->size() : 0;
}

inline bool has_note(const files::Imported& imported, std::string_view place, std::string_view part) {
    return std::ranges::any_of(imported.notes, [&](const files::Note& note) {
        return note.place.starts_with(place) && note.message.find(part) != std::string::npos;
    });
}

} // namespace sinew::test
