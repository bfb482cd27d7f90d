#include "files/in/formats.h"

#include "sinew/scene/text.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace sinew::files {
namespace {

const std::array all = {
    &reader::svg, &reader::png, &reader::obj, &reader::glb, &reader::gltf, &reader::tiled, &reader::points_and_sticks};

std::string small(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

bool has_ending(const ImportFormat& format, std::string_view name) {
    const auto endings = concat(" ", format.endings, " ");
    const auto dot = name.rfind('.');
    return dot != name.npos && endings.find(concat(" ", small(std::string(name.substr(dot + 1))), " ")) != endings.npos;
}

std::string all_endings() {
    std::string text;
    for (const auto* format : all) text += concat(text.empty() ? "" : ", ", format->name, " (", format->endings, ")");
    return text;
}

/// Null if there is none.
const ImportFormat* find_format(const ImportFile& file) {
    for (const auto* format : all)
        if (format->sniff(file.bytes)) return format;
    for (const auto* format : all)
        if (has_ending(*format, file.name)) return format;
    return nullptr;
}

const ImportFormat& format_of(const ImportFile& file) {
    if (const auto* const format = find_format(file)) return *format;
    throw ImportError{"", "neither its content nor its ending is of a format that can be imported",
                      concat("formats: ", all_endings())};
}

} // namespace

std::span<const ImportFormat* const> import_formats() {
    return all;
}

bool is_foreign(const ImportFile& file) {
    const auto* const format = find_format(file);
    return format && (format->sniff(file.bytes) || !small(file.name).ends_with(".json"));
}

std::string title_of(std::string_view file_name) {
    file_name.remove_prefix(file_name.find_last_of("/\\") + 1); // npos + 1 is 0
    const auto dot = file_name.rfind('.');
    constexpr std::size_t longest = 40;
    std::string title;
    for (const char c : file_name.substr(0, dot == 0 ? file_name.npos : dot).substr(0, longest))
        title += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
    return title.empty() ? "scene" : title;
}

Imported import_file(const ImportFile& file, const ImportOptions& options) {
    if (file.bytes.empty()) throw ImportError{"", "the file is empty"};
    if (file.bytes.size() > ImportLimits::bytes)
        throw ImportError{"", concat("it has more than ", ImportLimits::bytes, " bytes, the most that is imported")};
    return format_of(file).read(file, options);
}

} // namespace sinew::files
