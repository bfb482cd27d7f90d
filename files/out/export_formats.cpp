#include "files/out/export_formats.h"

#include "files/out/frame_name.h"

#include <algorithm>
#include <array>

namespace sinew::files {
namespace {

using enum FramesPerFile;

constexpr std::array<ExportFormat, 15> formats{{
    {"glb", ".glb", all, false, false, 30, "glTF 2.0: nodes and meshes that move: Blender, three.js, engines",
     open_glb},
    {"pc2", ".pc2", all, false, false, 24, "a point cache, and its mesh (.obj): Blender, 3ds Max", open_pc2},
    {"mdd", ".mdd", all, false, false, 24, "a point cache, and its mesh (.obj): Blender, Maya, Houdini", open_mdd},
    {"obj", ".obj", one, false, false, 24, "a mesh with lines, and its colours (.mtl)", open_obj},
    {"ply", ".ply", one, false, false, 24, "a mesh with lines and points, coloured", open_ply},
    {"svg", ".svg", all, false, true, 30, "vectors that move (SMIL), in a loop: browsers", open_animated_svg},
    {"svg", ".svg", one, true, true, 30, "vectors", open_pictures},
    {"lottie", ".json", all, false, true, 30, "Lottie: vectors that move: web pages, apps", open_lottie},
    {"csv", ".csv", all, false, false, 30, "a table: time, particle, position, velocity", open_trace_table},
    {"trace", ".jsonl", all, false, false, 30, "the same, a JSON object a line", open_trace_lines},
    {"png", ".png", one, true, true, 30, "a picture; --background none: transparent", open_pictures},
    {"jpeg", ".jpg", one, true, true, 30, "a picture, lossy and never transparent", open_pictures},
    {"apng", ".apng", all, true, true, 30, "a looping film that may be transparent", open_alpha_film},
    {"webm", ".webm", all, true, true, 30, "a film that may be transparent (VP9): browsers", open_alpha_film},
    {"mov", ".mov", all, true, true, 30, "a film that may be transparent (ProRes 4444): editors", open_alpha_film},
}};

std::string ending_of(const std::filesystem::path& path) {
    auto ending = path.extension().string();
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return ending;
}

} // namespace

std::span<const ExportFormat> export_formats() {
    return formats;
}

const ExportFormat* export_format_of(const std::filesystem::path& path, std::string_view name) {
    const auto ending = ending_of(path);
    const auto preferred = has_frame_number(path) ? one : all;
    const ExportFormat* found = nullptr;
    for (const auto& format : formats)
        if (name.empty() ? format.ending == ending : format.name == name)
            if (!found || format.frames == preferred) found = &format;
    return found;
}

} // namespace sinew::files
