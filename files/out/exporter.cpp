#include "files/out/exporter.h"

#include "sinew/world/edit.h"

namespace sinew::files {

std::vector<std::string> figures_named(const ExportRequest& request) {
    auto names = request.figures;
    if (!request.follow.empty()) names.push_back(request.follow);
    return names;
}

bool has_figure(const Session& session, const std::string& name) {
    return std::visit([&](const auto& world) { return find_figure(world, name).has_value(); }, session.world());
}

} // namespace sinew::files
