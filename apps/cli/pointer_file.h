#pragma once

#include "sinew/session/session.h"

#include "player/action.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

/// A pointer's path from a file, in place of a user's hand: `--pointer FILE`.
namespace sinew::cli {

/// A line of the file: from `time` on the button is up or down; the pointer moves straight to the next line's position.
struct PointerSample {
    double time = 0; ///< in the scene's unit of time
    double x = 0;    ///< 2D: in the scene's unit of length; 3D: pixels of the scene's own picture
    double y = 0;
    bool pressed = false;
};

class PointerPath {
  public:
    /// Throws CommandError with the number of a line other than TIME, X, Y, BUTTON.
    static PointerPath read(const std::filesystem::path& path);

    /// Actions that move the session's pointer to the position at the end of the next step, and press or release. A
    /// press grabs the nearest candidate, as in the window. Before the first line there is no pointer.
    std::vector<play::Action> moves(const Session& session);

  private:
    std::vector<PointerSample> samples_; ///< in the order of time
    std::size_t next_ = 0;               ///< index of the first future sample
    double depth_ = 1;                   ///< 3D: depth of the grabbed point (View::Seen)
    bool pressed_ = false;

    PointerSample now(double time);
    std::optional<play::Grab> press(const Session& session, const View& view, Vec2<double> pixel);
};

} // namespace sinew::cli
