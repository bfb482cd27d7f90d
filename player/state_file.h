#pragma once

#include "player/action_log.h"
#include "player/scene_library.h"
#include "player/timeline.h"

#include <functional>
#include <optional>
#include <string>

/// A running session as a file: the initial scene, every action with its step, the number of steps and the hash of the
/// final state. Loading replays the actions, which gives the same bits on every machine.
namespace sinew::play {

/// Text of a state file. `from`: the scene's file, to which the paths of pictures and models are relative; may be
/// empty.
std::string state_text(const Recipe& recipe, const std::string& from, const std::string& hash);

/// True if the text looks like a state file.
bool is_state(const std::string& text);

/// A replay from the start of a scene to the saved moment.
class Restoration {
  public:
    /// Parses a file's text; on failure problem() gives the reason.
    Restoration(const std::string& text, const std::string& name, const SceneLibrary& library);

    const std::string& problem() const { return problem_; }
    bool done() const { return !problem_.empty() || (session_ && taken_ >= steps_ && next_ == actions_.size()); }
    /// Steps until done, or until `enough` returns true.
    void advance(const std::function<bool()>& enough = {});
    /// Fraction of the steps taken, 0 to 1.
    double share() const { return steps_ > 0 ? double(taken_) / double(steps_) : 1; }
    const std::string& from() const { return from_; }

    /// The restored session, once done; nothing if the hash differs (problem() gives the reason).
    std::optional<Timeline> finish();

  private:
    void act_now();

    std::string name_, from_, hash_, problem_;
    std::optional<Session> session_;
    std::optional<ActionLog> log_;
    std::vector<LoggedAction> actions_;
    std::size_t next_ = 0; ///< index of the next action
    std::uint64_t taken_ = 0, steps_ = 0;
};

} // namespace sinew::play
