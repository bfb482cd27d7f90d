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

    /// A window of that size in nominal pixels, as much larger as letters are, as far as the display has room. What
    /// went wrong, or nothing.
    std::optional<std::string> open(const std::string& title, int width, int height);
    /// Units of SDL's window size that a nominal pixel has.
    double size_scale() const { return density() / pointer_scale(); }
    /// Whether the context was lost, as when a graphics driver starts anew: nothing more will be seen of it.
    bool lost() const;
    /// A new context in the same window. What was in the old one is gone.
    std::optional<std::string> renew();

    SDL_Window* window() const { return window_; }
    SDL_GLContext context() const { return context_; }

    int width() const;  ///< pixels
    int height() const; ///< pixels
    /// Pixels that a unit of SDL's pointer has: 2 on some dense displays.
    double pointer_scale() const;
    /// How much larger than usual letters should be.
    double density() const;
    bool minimized() const;
    void show() const { SDL_GL_SwapWindow(window_); }
    /// Whether showing waits for the display.
    void wait_for_display(bool on);

  private:
    void fit(int width, int height);

    bool started_ = false, can_tell_ = false, waits_ = true;
    SDL_Window* window_ = nullptr;
    SDL_GLContext context_ = nullptr;
};

} // namespace sinew::window
