#include "files/out/obj_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace sinew::files {
namespace {

std::string word(std::string text) {
    for (char& c : text)
        if (c <= ' ' || c == '#') c = '_';
    return text;
}

} // namespace

std::vector<std::string> material_names(const std::vector<MeshGroup>& groups) {
    std::vector<std::string> names;
    for (const auto& group : groups) {
        const auto plain = word(group.figure + "_" + group.part);
        auto name = plain;
        for (int i = 2; std::ranges::find(names, name) != names.end(); ++i) name = fmt::format("{}_{}", plain, i);
        names.push_back(name);
    }
    return names;
}

std::string obj_text(const SceneMesh& mesh, const std::string& materials) {
    auto text = fmt::format("# Sinew: metres, y upwards\nmtllib {}\no sinew\n", materials);
    auto end = std::back_inserter(text);
    for (const auto& p : mesh.vertices) fmt::format_to(end, "v {} {} {}\n", float(p[0]), float(p[1]), float(p[2]));
    const auto names = material_names(mesh.groups);
    auto used = ~std::uint32_t(0);
    for (const auto& element : mesh.elements) {
        if (element.group != used) fmt::format_to(end, "usemtl {}\n", names[used = element.group]);
        text += element.kind == ElementKind::face ? 'f' : 'l';
        for (const auto corner : mesh.corners_of(element)) fmt::format_to(end, " {}", corner + 1);
        text += '\n';
    }
    return text;
}

std::string mtl_text(const std::vector<MeshGroup>& groups) {
    std::string text;
    const auto names = material_names(groups);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const auto& color = groups[i].color;
        fmt::format_to(std::back_inserter(text), "newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nd {:.4f}\n", names[i], color.red,
                       color.green, color.blue, color.alpha);
    }
    return text;
}

} // namespace sinew::files
