#pragma once

#include "player/action.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace sinew::play {

/// An action carried out after `step` steps.
struct LoggedAction {
    std::uint64_t step = 0;
    Action action;
};

/// A scene and all actions since the start, in order: sufficient to replay a session.
struct Recipe {
    std::shared_ptr<const Scene> scene;
    std::vector<LoggedAction> actions;
    std::uint64_t steps = 0;
};

/// All actions carried out on a session. Undo returns to an earlier moment, from which other actions follow: the log is
/// a tree, and every moment of the session is a branch. Nodes are never removed.
class ActionLog {
  public:
    explicit ActionLog(const Session& session) { plant(session); }

    Branch now() const { return now_; }
    void step() { ++now_.step; }
    /// Records an action just carried out on the session.
    void note(const Action& action, const Session& session);
    /// Continues from an earlier moment.
    void go_to(const Branch& branch) { now_ = branch; }

    /// The recipe of the current moment.
    Recipe recipe() const;

  private:
    struct Node {
        std::uint32_t before = 0; ///< index of the preceding action; its own index at a root
        std::uint64_t step = 0;   ///< steps since the root
        Action action;            ///< at a root: Become, with the scene that starts there
    };

    /// Adds a root: the session is at the start of a scene.
    void plant(const Session& session);

    std::vector<Node> nodes_;
    Branch now_;
    PointAt pointer_; ///< last position of the pointer, kept by a restart
};

} // namespace sinew::play
