#pragma once

#include "sinew/scene/document.h"

#include <string>
#include <string_view>

namespace sinew {

/// Whether a file that a scene names at `place` lies in its folder; else that is reported. A scene must not look
/// elsewhere on the machine it is opened on.
bool in_its_folder(std::string_view name, const std::string& place, std::string_view example, Document& document);

} // namespace sinew
