#pragma once

#include "sinew/scene/document.h"

#include <string>
#include <string_view>

namespace sinew {

/// True if the file that a scene names at `place` lies in the scene's folder; otherwise an error is reported. A scene
/// must not access other files of the machine.
bool in_its_folder(std::string_view name, const std::string& place, std::string_view example, Document& document);

} // namespace sinew
