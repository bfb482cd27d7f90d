#pragma once

#include "sinew/session/session.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

/// Actions of a player on a session, as data. Replayed at the same step of the same session, an action gives the same
/// bits. Particles are identified by rows: a replay gives out new ids, but the same rows.
namespace sinew::play {

/// A moment in the log of actions (action_log.h): the preceding action and the number of steps.
struct Branch {
    std::uint32_t last = 0; ///< index of the action
    std::uint64_t step = 0; ///< steps since the action at the branch's root
};

struct PointAt {
    std::optional<Point> position;
}; ///< position for pins that follow the pointer
struct Grab {
    std::vector<Row> members; ///< a particle, or several around the position
    Point position;
};
struct Drag {
    Point position;
};
struct LetGo {};
/// A view of a scene as data: equal numbers give equal views.
struct Look {
    ViewSection section;
    std::array<Point, 2> focus{}; ///< two corners of a box around the scene at its start
    int width = 1, height = 1;    ///< size of the picture, pixels

    View view(const Scene& scene) const { return View(scene, section, focus, width, height); }
};

/// A cut along a line as seen in a view.
struct Slash {
    std::array<Point, 2> line;
    Look look;
};
struct Become {
    std::shared_ptr<const Scene> scene;
}; ///< an edit: continues as another scene, keeping the state that both share
struct Return {
    std::shared_ptr<const Session> to;
    Branch at{}; ///< moment of the log at which `to` was copied
};               ///< restores an earlier session
struct Restart {};
struct Quicken {
    double by = 0;
}; ///< changes the time scale
/// Sets the state of one particle.
struct Tweak {
    Row particle = 0;
    std::optional<Point> position, velocity;
    std::optional<double> mass;
};

/// Controls of characters and cars by the player's keys.
struct Steer {
    Controls controls;
};

using Action = std::variant<PointAt, Grab, Drag, LetGo, Slash, Become, Return, Restart, Quicken, Tweak, Steer>;

/// Id of the particle in a row; an invalid id where the row does not exist.
ParticleId id_at(const AnyWorld& world, Row row);

/// Current rows of particles; the largest Row for a missing particle.
std::vector<Row> rows_of(const AnyWorld& world, std::span<const ParticleId> particles);

/// Returns the reason why an edit of the scene has lost something (Session::become); empty if all goes on.
std::string carry_out(const Action& action, Session& session);

} // namespace sinew::play
