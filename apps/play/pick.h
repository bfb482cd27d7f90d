#pragma once

#include "sinew/session/pick.h"

namespace sinew::play {

using sinew::name_of;
using sinew::pick;
using sinew::Picked;
using sinew::place_of;

/// The particles of the same names in another world; nothing where one has no name or is not there.
std::optional<std::vector<ParticleId>> namesakes(const AnyWorld& from, std::span<const ParticleId> members,
                                                 const AnyWorld& to);

/// What was picked in one world, as the other has it: held as far from its middle.
std::optional<Picked> counterpart(const AnyWorld& from, const Picked& picked, const AnyWorld& to, const View& view);

} // namespace sinew::play
