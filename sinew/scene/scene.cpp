#include "sinew/scene/scene.h"

#include "sinew/scene/check_rest.h"
#include "sinew/scene/key_paths.h"
#include "sinew/scene/layout.h"
#include "sinew/scene/read_images.h"
#include "sinew/scene/read_models.h"
#include "sinew/scene/reader.h"

namespace sinew {
namespace {

/// Dimension and units, which the other sections need.
struct Header {
    int dimension = 2;
    UnitsSection units;

    Header(const Document& document, Diagnostics& heard_again) {
        const Reading in{.diagnostics = heard_again};
        const auto* members = document.root.as<json::Object>();
        if (!members) return;
        Scene::fields(scene_, [&](auto& member, const Field& field) {
            using T = std::remove_cvref_t<decltype(member)>;
            const auto* found = json::find(*members, field.name);
            if (!found) return;
            if constexpr (std::is_same_v<T, UnitsSection>) read(found->value, units, field, Path{}, in);
            if constexpr (std::is_same_v<T, int>)
                if (field.name == "dimension") read(found->value, dimension, field, Path{}, in);
        });
    }

  private:
    Scene scene_;
};

Units measures(const UnitsSection& section) {
    Units units;
    if (section.length == "px") units = {.length = "px", .per_metre = 100};
    if (section.length == "cm") units = {.length = "cm", .per_metre = 100};
    if (section.length == "mm") units = {.length = "mm", .per_metre = 1000};
    if (section.time == "frame") {
        units.time = "frame";
        units.per_second = 60;
    }
    return units;
}

/// Reports a file of a later format version. No other part of such a file is read, because its meaning is unknown.
bool is_of_later_version(Document& document) {
    const auto* version = json::find(document.root, "/sinew");
    const auto* number = version ? version->as<json::Number>() : nullptr;
    if (!number || !number->integer || *number->integer <= Scene{}.version) return false;
    document.error(
        "/sinew",
        concat("this file is of version ", *number->integer, " of the scene format, which a later Sinew reads"),
        concat("this one reads version ", Scene{}.version));
    return true;
}

/// Reports a file without a version, and reads on as if the present one were stated.
void check_version(Document& document) {
    auto* members = document.root.as<json::Object>();
    if (!members || json::find(*members, "sinew")) return;
    document.error("", "missing property \"sinew\", the version of the format",
                   concat("begin the file with {\"sinew\": ", Scene{}.version, ", ..."));
    json::Value version(Scene{}.version);
    version.span = document.root.span;
    members->push_back({"sinew", std::move(version), document.root.span});
}

} // namespace

Units Scene::measures() const {
    return sinew::measures(units);
}

double step_length(const Scene& scene) {
    return scene.measures().per_second / scene.solver.rate;
}

std::optional<Opened> open_scene(Document& document, const ImageReader& images, const ModelReader& models) {
    const bool unreadable = document.root.as<json::Object>()->empty() && !document.diagnostics.ok();
    if (unreadable || is_of_later_version(document)) return std::nullopt;
    check_version(document);
    const auto without_version = document.diagnostics.count();
    Diagnostics heard_again = document.diagnostics; // errors in the header are reported by the full reading
    const Header header(document, heard_again);
    Opened opened;
    std::optional<Layout> layout; // built on the first error
    read(document.root, opened.scene,
         Reading{.diagnostics = document.diagnostics,
                 .dimension = header.dimension,
                 .units = measures(header.units),
                 .memory = document.limits.memory,
                 .elsewhere =
                     [&](std::string_view key) {
                         if (!layout) layout = scene_layout();
                         return key_paths(*layout, document.root, key);
                     },
                 .in_sections =
                     [&](std::string_view key) {
                         if (!layout) layout = scene_layout();
                         return exact_key_paths(*layout, json::Object{}, key);
                     },
                 .around =
                     [&](std::string_view place, std::string_view key) {
                         if (!layout) layout = scene_layout();
                         return key_paths_around(*layout, document.root, place, key);
                     }});
    const bool is_read = document.diagnostics.count() == without_version;
    if (models) read_models(opened.scene, models, document);
    const bool has_models = document.diagnostics.count() == without_version;
    if (!is_read || !check_values(opened.scene, document) || !has_models) {
        CheckRest(opened.scene, document).run();
        return std::nullopt;
    }
    check_names(opened.scene, document);
    opened.world = instantiate(opened.scene);
    check_references(opened.scene, opened.world, document);
    if (images) opened.images = read_images(opened, images, document);
    if (!document.diagnostics.ok()) return std::nullopt;
    warn_of_traps(opened.scene, opened.world, document);
    return opened;
}

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

} // namespace sinew
