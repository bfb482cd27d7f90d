#pragma once

#include "sinew/prefab/obj.h"
#include "sinew/scene/limits.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace sinew {

/// A model that was read, or why there is none.
struct ReadModel {
    std::shared_ptr<const MeshModel> model;
    std::string problem, help;
};

/// Finds and reads the OBJ file that a scene names. Who opens a scene knows where its files are: `sinew/` reads none.
/// At most `limits.bytes` of it may be read, and at most `limits.particles` be made of it.
using ModelReader = std::function<ReadModel(const std::string& name, const Limits& limits)>;

/// From the text of a file that messages call `name`: "sail.obj:12: ..."
ReadModel read_model(std::string_view text, std::string_view name, const Limits& limits);

} // namespace sinew
