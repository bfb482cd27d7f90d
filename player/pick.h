#pragma once

#include "sinew/session/pick.h"

namespace sinew::play {

using sinew::name_of;
using sinew::pick;
using sinew::Picked;
using sinew::position_of;

/// Particles of the same names in another world; nothing if a particle has no name or no counterpart.
std::optional<std::vector<ParticleId>> namesakes(const AnyWorld& from, std::span<const ParticleId> members,
                                                 const AnyWorld& to);

/// Counterpart of a picked item in another world, with the same offset from the particles' middle.
std::optional<Picked> counterpart(const AnyWorld& from, const Picked& picked, const AnyWorld& to, const View& view);

} // namespace sinew::play
