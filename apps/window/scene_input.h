#pragma once

#include "apps/window/panel.h"
#include "apps/window/screen.h"
#include "player/touch.h"

namespace sinew::window {

/// Pointer, wheel, fingers and keys of the window, as input to the player of the scene.
class SceneInput {
  public:
    /// Keeps references to all arguments.
    SceneInput(play::Play& play, const Screen& screen, Panel& panel)
        : play_(play), touch_(play), screen_(screen), panel_(panel) {}

    /// Passes an event on if the scene is meant, not the panel; ignores all other events.
    void take(const SDL_Event& event);

  private:
    void take_motion(const SDL_MouseMotionEvent& motion);
    void take_press(const SDL_MouseButtonEvent& pressed);
    void take_release(const SDL_MouseButtonEvent& released);
    void take_wheel(const SDL_MouseWheelEvent& wheel);
    void take_key(const SDL_Keysym& key);
    void take_finger(const SDL_TouchFingerEvent& finger);

    bool is_free(int x, int y) const;
    bool is_scene(Vec2<double> at) const;
    Vec2<double> in_scene(int x, int y) const;
    Vec2<double> in_scene(const SDL_TouchFingerEvent& finger) const;

    play::Play& play_;
    play::Touch touch_;
    const Screen& screen_;
    Panel& panel_;
    bool dragging_ = false; ///< a button pressed over the scene is still down
};

} // namespace sinew::window
