#pragma once

#include "player/action.h"

namespace sinew::play {

/// Camera controller: the view of the scene until the player moves it.
class CameraController {
  public:
    /// Size of the picture, pixels.
    void resize(int width, int height) { width_ = width, height_ = height; }

    Look look(const Session& session) const;
    View view(const Session& session) const { return look(session).view(session.scene()); }

    /// Moves the picture with the pointer, by pixels.
    void pan(const Session& session, Vec2<double> by);
    /// Enlarges by a factor above 1. In 2D the point at pixel `about` stays in place; in 3D the camera moves towards
    /// the target.
    void zoom(const Session& session, Vec2<double> about, double factor);
    /// Turns the camera about the target, by pixels; in 2D pans.
    void orbit(const Session& session, Vec2<double> by);
    /// Switches between perspective and orthographic projection; no effect in 2D.
    void switch_projection(const Session& session);
    /// Restores the scene's own view; in 2D, particles outside are then framed.
    void home(const Session& session);

  private:
    /// The moved view, copied from the current one at the first call.
    ViewSection& hold(const Session& session);

    int width_ = 1, height_ = 1;
    std::optional<ViewSection> moved_;
};

} // namespace sinew::play
