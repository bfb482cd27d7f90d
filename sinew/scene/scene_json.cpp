#include "sinew/scene/reader.h"
#include "sinew/scene/scene.h"

/// Conversion of scenes to JSON. The templates that write sections are instantiated only here.
namespace sinew {
namespace {

Writing in_units_of(const Scene& scene) {
    return {.dimension = scene.dimension, .units = scene.measures()};
}

} // namespace

json::Value to_json(const Scene& scene) {
    return write(scene, in_units_of(scene));
}

json::Value to_json(const Scene& scene, const FigureSection& figure) {
    return write(figure, in_units_of(scene));
}

} // namespace sinew
