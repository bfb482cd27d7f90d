#pragma once

#include <SDL.h>
#include <optional>
#include <string>

namespace sinew::window {

/// An SDL window with an OpenGL context.
class Screen {
  public:
    Screen() = default;
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;
    ~Screen();

    /// Opens a window of nominal pixels, scaled like the letters as far as the display has room; returns the reason of
    /// failure, or nothing.
    std::optional<std::string> open(const std::string& title, int width, int height);
    /// Units of SDL's window size per nominal pixel.
    double size_scale() const { return density() / pointer_scale(); }
    /// True if the context was lost, as after a restart of the graphics driver; nothing is displayed any more.
    bool lost() const;
    /// Creates a new context in the same window, without the old one's objects; returns the reason of failure, or
    /// nothing.
    std::optional<std::string> renew();

    SDL_Window* window() const { return window_; }
    SDL_GLContext context() const { return context_; }

    int width() const;  ///< pixels
    int height() const; ///< pixels
    /// Pixels per unit of SDL's pointer: 2 on some dense displays.
    double pointer_scale() const;
    /// Magnification of letters, 1 on a usual display.
    double density() const;
    bool minimized() const;
    void show() const { SDL_GL_SwapWindow(window_); }
    /// Switches vertical synchronisation.
    void wait_for_display(bool on);

  private:
    void fit(int width, int height);

    bool started_ = false, can_tell_ = false, waits_ = true;
    SDL_Window* window_ = nullptr;
    SDL_GLContext context_ = nullptr;
};

} // namespace sinew::window
