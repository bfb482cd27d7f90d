#pragma once

#include "sinew/prefab/obj.h"
#include "sinew/scene/limits.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace sinew {

/// A model, or the reason why the file cannot be read.
struct ReadModel {
    std::shared_ptr<const MeshModel> model;
    std::string problem, help;
};

/// Reads the OBJ file that a scene names. The caller supplies this function: `sinew/` reads no files. The function may
/// read at most `limits.bytes` and return at most `limits.particles` points.
using ModelReader = std::function<ReadModel(const std::string& name, const Limits& limits)>;

/// Reads a model from the text of a file; messages call the file `name`: "sail.obj:12: ..."
ReadModel read_model(std::string_view text, std::string_view name, const Limits& limits);

} // namespace sinew
