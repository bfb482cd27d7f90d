#pragma once

#include "sinew/scene/json.h"
#include "sinew/scene/layout.h"
#include "sinew/scene/units.h"

namespace sinew::play {

/// Multiplies every length in a record by a factor, areas and volumes by its powers, those with default values too.
/// Speeds and forces stay, and so does the record's own place, "at".
void grow(json::Value& record, const Layout& layout, double factor, const Units& units);

} // namespace sinew::play
