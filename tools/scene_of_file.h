#pragma once

#include "sinew/session/session.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

/// Scenes of files for tools that need the library alone.
namespace sinew::tools {

inline std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Scene of a file with its models; images are one point, for they do not affect the motion. Nothing where a mistake is
/// found, which standard error is told.
inline auto scene_of_file(const std::filesystem::path& path, std::span<const Override> overrides = {}) {
    auto document = load(text_of(path), path.string(), overrides);
    const auto any_image = [](const std::string&, const Limits&) {
        return ReadImage{with_halves({1, 1, {0xffffffff}}), "", ""};
    };
    const auto model = [&](const std::string& name, const Limits& limits) {
        return read_model(text_of(path.parent_path() / name), name, limits);
    };
    auto opened = open_scene(document, any_image, model);
    if (!opened) std::fputs(to_text(document.diagnostics).c_str(), stderr);
    return opened;
}

} // namespace sinew::tools
