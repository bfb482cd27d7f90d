#pragma once

#include "sinew/scene/json.h"
#include "sinew/session/session.h"

namespace sinew {

/// Members of an entry of the log beside `what`: `seconds` and `where`; `islands`, `with` and `impulse` where the entry
/// has them. Every command that tells events as JSON tells these.
json::Object event_details(const SessionEvent& event);

} // namespace sinew
