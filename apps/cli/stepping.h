#pragma once

#include "sinew/session/session.h"

#include "apps/cli/pointer_file.h"
#include "canvas/progress.h"

#include <cstdint>
#include <utility>

namespace sinew::cli {

/// How many steps of the scene's rate are over when it is so late.
std::uint64_t steps_before(const Scene& scene, double seconds);
/// How many it takes until at least so many seconds are simulated.
std::uint64_t steps_until(const Scene& scene, double seconds);

/// A session and how many steps it took.
class Run {
  public:
    /// With a progress bar where getting the world ready takes a while.
    explicit Run(Opened opened);

    /// Steps on until `steps` are taken in all. Gives up on Ctrl-C.
    void advance(std::uint64_t steps);
    /// With a progress bar, which also counts `others`.
    void advance(std::uint64_t steps, canvas::Progress& progress, std::uint64_t others = 0);

    std::uint64_t steps() const { return taken; }

    Session session;
    std::optional<PointerPath> pointer; ///< leads the session's pointer

  private:
    std::uint64_t taken = 0;

    void step();
};

/// Throws what ends a command after Ctrl-C, if that was pressed.
void give_up_if_interrupted();

} // namespace sinew::cli
