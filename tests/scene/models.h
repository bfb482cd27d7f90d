#pragma once

#include "sinew/scene/model.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace sinew {

/// Reads the models of a scene file from the folder it lies in.
inline ModelReader models_beside(const std::filesystem::path& scene) {
    return [folder = scene.parent_path()](const std::string& name, const Limits& limits) {
        std::ifstream file(folder / name, std::ios::binary);
        return read_model(std::string(std::istreambuf_iterator<char>(file), {}), name, limits);
    };
}

} // namespace sinew
