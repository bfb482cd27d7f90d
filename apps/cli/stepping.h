#pragma once

#include "sinew/session/session.h"

#include "apps/cli/pointer_file.h"
#include "canvas/progress.h"
#include "player/action.h"

#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

namespace sinew::cli {

/// Number of steps of the scene's rate completed by `seconds`.
std::uint64_t steps_before(const Scene& scene, double seconds);
/// Number of steps until at least `seconds` are simulated.
std::uint64_t steps_until(const Scene& scene, double seconds);

/// Told of all that happens to a run's session, just after it.
class Witness {
  public:
    virtual ~Witness() = default;
    virtual void act(const play::Action& action, const Session& session) = 0;
    virtual void step(const Session& session) = 0;
};

/// A session with a count of steps.
class Run {
  public:
    /// Prepares a large world at once, with a progress bar. `threads` 0: one for each core.
    explicit Run(Opened opened, int threads = 0) : Run(Session(std::move(opened)), threads) {}
    /// Goes on from a session's present step.
    explicit Run(Session begun, int threads = 0);

    /// Steps until `steps` are taken in all. Throws CommandError after Ctrl-C.
    void advance(std::uint64_t steps);
    /// As above, with a progress bar at `others` plus the steps taken.
    void advance(std::uint64_t steps, canvas::Progress& progress, std::uint64_t others = 0);

    std::uint64_t steps() const { return taken; }
    /// Throws CommandError if the time that an option asks for, in seconds since the scene's start, has passed already.
    void expect_ahead(std::string_view option, double seconds) const;

    Session session;
    std::optional<PointerPath> pointer; ///< drives the session's pointer
    std::shared_ptr<Witness> witness;

  private:
    std::uint64_t taken = 0;

    void step();
};

/// Throws CommandError if Ctrl-C was pressed.
void give_up_if_interrupted();

} // namespace sinew::cli
