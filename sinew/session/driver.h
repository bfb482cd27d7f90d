#pragma once

#include "sinew/scene/driver_section.h"

namespace sinew {

/// Position of a driven pin at `time`, in the scene's units. `rest`: the pin's position without the driver; `up`: -1 if
/// y points down, else 1.
Point driven_to(const Driver& driver, const Point& rest, double time, int up);

} // namespace sinew
