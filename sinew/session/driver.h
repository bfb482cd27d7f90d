#pragma once

#include "sinew/scene/driver_section.h"

namespace sinew {

/// Where a driver has its pin at a time. `rest` is where the pin is held without it; `up` is -1 where y points down.
Point driven_to(const Driver& driver, const Point& rest, double time, int up);

} // namespace sinew
