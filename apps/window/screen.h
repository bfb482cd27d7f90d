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

    /// What went wrong, or nothing.
    std::optional<std::string> open(const std::string& title, int width, int height);

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

  private:
    bool started_ = false;
    SDL_Window* window_ = nullptr;
    SDL_GLContext context_ = nullptr;
};

} // namespace sinew::window
