#pragma once

#include "sinew/session/session.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

/// What a player can do to a session, as data: done again at the same step of the same session, it leads to the same
/// bits. Particles are told by their rows: ids are given out anew when a step is done again, rows are the same.
namespace sinew::play {

/// A moment in the log of actions (action_log.h): the last action before it, and how many steps the session has taken.
struct Branch {
    std::uint32_t last = 0; ///< index of the action
    std::uint64_t step = 0; ///< since the action at the branch's root
};

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
/// How a player looks at a scene, as data: the same numbers are the same view.
struct Look {
    ViewSection section;
    std::array<Point, 2> focus{}; ///< two corners around what the scene shows at its start
    int width = 1, height = 1;    ///< of the picture, pixels

    View view(const Scene& scene) const { return View(scene, section, focus, width, height); }
};

/// A cut along a line, as seen in a view.
struct Slash {
    std::array<Point, 2> line;
    Look look;
};
struct Become {
    std::shared_ptr<const Scene> scene;
}; ///< an edit: another scene, that goes on where it can
struct Return {
    std::shared_ptr<const Session> to;
    Branch at{}; ///< of the log, what led there
};               ///< to what it was then
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

/// Id of the particle in a row; none where there is no such row.
ParticleId id_at(const AnyWorld& world, Row row);

/// The rows of particles now; of one that is gone, none that there is.
std::vector<Row> rows_of(const AnyWorld& world, std::span<const ParticleId> particles);

void carry_out(const Deed& deed, Session& session);

} // namespace sinew::play
