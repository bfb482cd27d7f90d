#pragma once

#include "sinew/session/level.h"

#include "bindings/c/sinew.h"
#include "bindings/c/sinew_level.h"

#include <memory>
#include <string>

namespace sinew::c {

/// The level of a shared object that stays in memory; `name` is for messages. Returns null, and the reason, for a level
/// of another ABI.
std::shared_ptr<Level> level_of(const sinew_level* given, const std::string& name, std::string& problem);

} // namespace sinew::c
