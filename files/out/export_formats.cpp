#include "files/out/export_formats.h"

#include "canvas/formats.h"
#include "files/out/frame_name.h"

#include <algorithm>
#include <array>

namespace sinew::files {
namespace {

using enum FramesPerFile;

constexpr std::array<ExportFormat, 5> list{{
    {"glb", ".glb", all, 30, "glTF 2.0: nodes and meshes that move: Blender, three.js, engines", open_glb},
    {"obj", ".obj", one, 24, "a mesh with lines, and its colours (.mtl)", open_obj},
    {"ply", ".ply", one, 24, "a mesh with lines and points, coloured", open_ply},
    {"pc2", ".pc2", all, 24, "a point cache, and its mesh (.obj): Blender, 3ds Max", open_pc2},
    {"mdd", ".mdd", all, 24, "a point cache, and its mesh (.obj): Blender, Maya, Houdini", open_mdd},
}};

} // namespace

std::span<const ExportFormat> export_formats() {
    return list;
}

const ExportFormat* export_format_of(const std::filesystem::path& path, std::string_view name) {
    const auto ending = canvas::extension_of(path);
    const auto preferred = has_frame_number(path) ? one : all;
    const ExportFormat* found = nullptr;
    for (const auto& format : list)
        if (name.empty() ? format.ending == ending : format.name == name)
            if (!found || format.frames == preferred) found = &format;
    return found;
}

} // namespace sinew::files
