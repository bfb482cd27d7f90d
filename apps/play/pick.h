#pragma once

#include "sinew/session/pick.h"

namespace sinew::play {

using sinew::name_of;
using sinew::pick;
using sinew::Picked;
using sinew::place_of;

} // namespace sinew::play
