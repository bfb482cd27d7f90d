#include "files/out/obj_text.h"

#include "sinew/math/format.h"

#include <algorithm>
#include <string>

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
        for (int i = 2; std::ranges::find(names, name) != names.end(); ++i) name = format_text("{}_{}", plain, i);
        names.push_back(name);
    }
    return names;
}

std::string obj_text(const SceneMesh& mesh, const std::string& materials) {
    auto text = format_text("# Sinew: metres, y upwards\nmtllib {}\no sinew\n", materials);
    // Nine digits parse back to the same float.
    for (const auto& p : mesh.vertices)
        text += format_text("v {:9} {:9} {:9}\n", float(p[0]), float(p[1]), float(p[2]));
    const auto names = material_names(mesh.groups);
    auto used = ~std::uint32_t(0);
    for (const auto& element : mesh.elements) {
        if (element.group != used) text += format_text("usemtl {}\n", names[used = element.group]);
        text += element.kind == ElementKind::face ? 'f' : 'l';
        for (const auto corner : mesh.corners_of(element)) text += ' ' + std::to_string(corner + 1);
        text += '\n';
    }
    return text;
}

std::string mtl_text(const std::vector<MeshGroup>& groups) {
    std::string text;
    const auto names = material_names(groups);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const auto& color = groups[i].color;
        text += format_text("newmtl {}\nKd {:4} {:4} {:4}\nd {:4}\n", names[i], color.red, color.green, color.blue,
                            color.alpha);
    }
    return text;
}

} // namespace sinew::files
