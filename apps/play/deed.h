#pragma once

#include "sinew/session/session.h"

#include <array>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

/// What a player can do to a session, as data: done again at the same step of the same session, it leads to the same
/// bits.
namespace sinew::play {

struct PointAt {
    std::optional<Point> place;
}; ///< for pins that follow the pointer
struct Grab {
    std::vector<ParticleId> members; ///< one, or several with the place between them
    Point place;
};
struct Drag {
    Point place;
};
struct LetGo {};
/// As seen in a view.
struct Slash {
    std::array<Point, 2> line;
    View view;
};
struct Become {
    std::shared_ptr<const Scene> scene;
}; ///< an edit: another scene, that goes on where it can
struct Return {
    std::shared_ptr<const Session> to;
}; ///< to what it was then
struct Restart {};
struct Quicken {
    double by = 0;
}; ///< time passes faster or slower
/// Sets what is said of one particle.
struct Tweak {
    ParticleId particle;
    std::optional<Point> position, velocity;
    std::optional<double> mass;
};

using Deed = std::variant<PointAt, Grab, Drag, LetGo, Slash, Become, Return, Restart, Quicken, Tweak>;

void carry_out(const Deed& deed, Session& session);

} // namespace sinew::play
