#include "apps/cli/index.h"

#include "sinew/scene/scene.h"

#include "apps/cli/catalogue.h"
#include "apps/cli/console.h"
#include "apps/cli/scene_file.h"

#include <algorithm>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

IndexEntry entry_of(const std::string& name) {
    IndexEntry entry{name, "", std::string(Scene::categories.back()), catalogue_path(name).string()};
    try {
        const auto document = open_document(entry.file);
        const auto text = [&](std::string_view path) -> const std::string* {
            const auto* value = json::find(document.root, path);
            return value ? value->as<std::string>() : nullptr;
        };
        if (const auto* about = text("/about"))
            entry.about = *about;
        else if (!document.diagnostics.ok())
            entry.about = fmt::format("broken: see `sinew check {}`", entry.file);
        const auto* category = text("/category");
        if (category && std::ranges::count(Scene::categories, *category) > 0) entry.category = *category;
    } catch (const CommandError&) {
        entry.about = "cannot be read";
    }
    return entry;
}

} // namespace

std::vector<IndexEntry> catalogue_index() {
    std::vector<IndexEntry> entries;
    for (const auto& name : catalogue_names()) entries.push_back(entry_of(name));
    std::ranges::stable_sort(entries, {}, [](const IndexEntry& entry) {
        return std::ranges::find(Scene::categories, entry.category) - Scene::categories.begin();
    });
    return entries;
}

} // namespace sinew::cli
