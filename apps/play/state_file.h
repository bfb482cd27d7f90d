#pragma once

#include "apps/play/action_log.h"
#include "apps/play/shelf.h"
#include "apps/play/tape.h"

#include <functional>
#include <optional>
#include <string>

/// A running session as a file: the scene it began with, every action with its step, the number of steps, and the hash
/// that these lead to. It is restored by doing the same again, which gives the same bits on every machine.
namespace sinew::play {

/// The text of a file. `from`: the file of the scene, beside which its pictures and models are looked for; may be
/// empty.
std::string state_text(const Recipe& recipe, const std::string& from, const std::string& hash);

/// Whether a text claims to be such a file.
bool is_state(const std::string& text);

/// A session on its way from the start of its scene to the moment that was saved.
class Restoration {
  public:
    /// Reads a file's text; problem() says what is wrong with it.
    Restoration(const std::string& text, const std::string& name, const Shelf& shelf);

    const std::string& problem() const { return problem_; }
    bool done() const { return !problem_.empty() || (session_ && taken_ >= steps_ && next_ == actions_.size()); }
    /// Steps on until it is done, or `enough` says so.
    void advance(const std::function<bool()>& enough = {});
    /// How much of the way is behind it, 0 to 1.
    double share() const { return steps_ > 0 ? double(taken_) / double(steps_) : 1; }
    const std::string& from() const { return from_; }

    /// The session as it was, once done; nothing where it is not the same (then problem() says so).
    std::optional<Tape> finish();

  private:
    void act_now();

    std::string name_, from_, hash_, problem_;
    std::optional<Session> session_;
    std::optional<ActionLog> log_;
    std::vector<LoggedAction> actions_;
    std::size_t next_ = 0; ///< of the actions
    std::uint64_t taken_ = 0, steps_ = 0;
};

} // namespace sinew::play
