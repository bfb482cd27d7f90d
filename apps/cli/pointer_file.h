#pragma once

#include "sinew/session/session.h"

#include <cstddef>
#include <filesystem>
#include <vector>

/// A pointer's path from a file, in place of somebody's hand: `--pointer FILE`.
namespace sinew::cli {

/// One line: from this time on the button is up or down; the pointer goes straight to the next line's place.
struct PointerSample {
    double time = 0; ///< in the scene's time unit
    double x = 0;    ///< 2D: in the scene's unit of length; 3D: pixels of the scene's own picture
    double y = 0;
    bool pressed = false;
};

class PointerPath {
  public:
    /// Throws GiveUp with the number of a line that is not TIME, X, Y, BUTTON.
    static PointerPath read(const std::filesystem::path& path);

    /// Moves the session's pointer to its place at the end of the step that comes next, and presses or lets go. A
    /// press takes hold of what is nearest, as in the window. Before the first line there is no pointer.
    void lead(Session& session);

  private:
    std::vector<PointerSample> samples_; ///< in the order of time
    std::size_t next_ = 0;               ///< of the samples: the first that is still ahead
    double depth_ = 1;                   ///< 3D: of what is held, from the eye
    bool pressed_ = false;

    PointerSample now(double time);
    void press(Session& session, const View& view, Vec2<double> pixel);
};

} // namespace sinew::cli
