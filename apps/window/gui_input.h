#pragma once

#include "apps/window/screen.h"

#include <vector>

namespace sinew::window {

/// Input of ImGui, corrected where ImGui's back-end for SDL errs.
class GuiInput {
  public:
    /// Begins a frame of the window.
    void begin();
    /// Passes an event on. ImGui samples keys once per frame: if press and release fall into one frame, the release is
    /// passed on in the next.
    void take(const SDL_Event& event);
    /// Sets size and pointer in pixels, after the back-end began a frame. The back-end asks the display server for the
    /// pointer, which on X11 returns an old position after a button was pressed; and the back-end counts in units of
    /// the window, the panel in pixels.
    static void measure(const Screen& screen);

  private:
    std::vector<SDL_Scancode> new_keys_; ///< pressed in this frame
    std::vector<SDL_Event> late_releases_;
};

} // namespace sinew::window
