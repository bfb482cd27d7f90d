#pragma once

#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include "tests/stepped.h"

#include <string_view>
#include <variant>

/// Where a session's particles are, in a world in the plane.
namespace sinew {

inline const World<2, double>& world_of(const Session& session) {
    return std::get<World<2, double>>(session.world());
}
inline Vec2<double> position(const Session& session, std::string_view name) {
    return *position_of(world_of(session), *find_particle(world_of(session), name));
}

} // namespace sinew
