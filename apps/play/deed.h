#pragma once

#include "sinew/session/session.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

/// What a player can do to a session, as data: done again at the same step of the same session, it leads to the same
/// bits. Particles are told by their rows: ids are given out anew when a step is done again, rows are the same.
namespace sinew::play {

struct PointAt {
    std::optional<Point> place;
}; ///< for pins that follow the pointer
struct Grab {
    std::vector<Row> members; ///< one, or several with the place between them
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
    Row particle = 0;
    std::optional<Point> position, velocity;
    std::optional<double> mass;
};

using Deed = std::variant<PointAt, Grab, Drag, LetGo, Slash, Become, Return, Restart, Quicken, Tweak>;

/// The rows of particles now; of one that is gone, none that there is.
std::vector<Row> rows_of(const AnyWorld& world, std::span<const ParticleId> particles);

void carry_out(const Deed& deed, Session& session);

} // namespace sinew::play
