#include "bindings/c/reading.h"

#include "sinew/scene/text.h"

#include "bindings/c/failure.h"
#include "bindings/c/native/sized.h"

#include <algorithm>

namespace sinew::c {
namespace {

constexpr std::uint32_t longest_side = 16384; // pixels

template <class Files> auto find_named(const Files& files, const std::string& name) {
    return std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.first == name; });
}

sinew_status read_files(const sinew_open_options& options, SceneFile& file) {
    for (std::size_t i = 0; i < options.image_count; ++i) {
        const auto& image = options.images[i];
        if (!image.name) return null_argument();
        if (image.width == 0 || image.height == 0 || image.width > longest_side || image.height > longest_side)
            return fail(SINEW_BAD_ARGUMENT, concat("image ", in_quotes(image.name), " has no possible size"));
        file.images.push_back({image.name, {int(image.width), int(image.height)}});
    }
    for (std::size_t i = 0; i < options.model_count; ++i) {
        const auto& model = options.models[i];
        if (!model.name || !model.text) return null_argument();
        file.models.emplace_back(model.name, model.text);
    }
    return SINEW_OK;
}

} // namespace

sinew_status SceneFile::read(const char* text, const sinew_open_options* given, SceneFile& file) {
    if (!text) return null_argument();
    sinew_open_options options{};
    if (given)
        if (const auto status = take(given, options)) return status;
    file.text = text;
    file.name = options.name ? options.name : "scene.json";
    const bool missing = (options.override_count && !options.overrides) || (options.image_count && !options.images) ||
                         (options.model_count && !options.models);
    if (missing) return null_argument();
    for (std::size_t i = 0; i < options.override_count; ++i) {
        if (!options.overrides[i]) return null_argument();
        file.overrides.push_back({options.overrides[i]});
    }
    return read_files(options, file);
}

/// Images have sizes only: whoever paints has the pixels. A missing one is drawn as a plain shape of its aspect.
std::optional<Opened> SceneFile::open(std::span<const Override> with) const {
    auto document = load(text, name, with);
    const auto image = [&](const std::string& wanted, const Limits&) -> ReadImage {
        const auto known = find_named(images, wanted);
        Image sized{.width = 1, .height = 1, .pixels = {}};
        if (known != images.end()) sized.width = known->second[0], sized.height = known->second[1];
        return {std::make_shared<const Image>(std::move(sized)), "", ""};
    };
    const auto model = [&](const std::string& wanted, const Limits& limits) -> ReadModel {
        const auto known = find_named(models, wanted);
        if (known == models.end()) return {nullptr, "no model called " + in_quotes(wanted), "give its text as a model"};
        return read_model(known->second, wanted, limits);
    };
    auto opened = open_scene(document, images.empty() ? ImageReader() : image, model);
    keep_diagnostics(document.diagnostics);
    return opened;
}

} // namespace sinew::c
