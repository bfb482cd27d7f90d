#pragma once

#include "apps/play/deed.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace sinew::play {

/// An action and the step at which it was done.
struct LoggedAction {
    std::uint64_t step = 0;
    Deed deed;
};

/// A scene, and all that was done to it since its start, in order: together the recipe of a session.
struct Recipe {
    std::shared_ptr<const Scene> scene;
    std::vector<LoggedAction> actions;
    std::uint64_t steps = 0;
};

/// Everything done to a session since its start. An undo returns to an earlier moment, from which other actions lead
/// elsewhere: the log is a tree, and every moment of the session is a branch of it. Nothing is ever removed.
class ActionLog {
  public:
    explicit ActionLog(const Session& session) { plant(session); }

    Branch now() const { return now_; }
    void step() { ++now_.step; }
    /// Notes an action that was just carried out on the session.
    void note(const Deed& deed, const Session& session);
    /// Goes on from a moment of the past.
    void go_to(const Branch& branch) { now_ = branch; }

    /// The recipe of the present moment.
    Recipe recipe() const;

  private:
    struct Node {
        std::uint32_t before = 0; ///< index of the action before it; itself at a root
        std::uint64_t step = 0;   ///< since the root
        Deed deed;                ///< of a root: Become, the scene that starts there
    };

    /// A root: the session is at its scene's start.
    void plant(const Session& session);

    std::vector<Node> nodes_;
    Branch now_;
    PointAt pointer_; ///< the last; a restart keeps it
};

} // namespace sinew::play
