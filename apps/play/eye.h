#pragma once

#include "apps/play/deed.h"

namespace sinew::play {

/// How a player looks at a scene: as it says, until the view is moved.
class Eye {
  public:
    /// The size of the picture, in pixels.
    void resize(int width, int height) { width_ = width, height_ = height; }

    Look look(const Session& session) const;
    View view(const Session& session) const { return look(session).view(session.scene()); }

    /// Moves what is seen along with the pointer. Pixels.
    void pan(const Session& session, Vec2<double> by);
    /// What is at the pixel stays there. A factor above 1 shows it larger.
    void zoom(const Session& session, Vec2<double> about, double factor);
    /// Around what a 3D scene is looked at; in 2D the same as panning. Pixels.
    void orbit(const Session& session, Vec2<double> by);
    /// Between perspective and orthographic; nothing in 2D.
    void switch_projection(const Session& session);
    /// As the scene says; what is out of sight then is framed.
    void home(const Session& session);

  private:
    /// The view as it is, in numbers.
    ViewSection& hold(const Session& session);

    int width_ = 1, height_ = 1;
    std::optional<ViewSection> moved_;
};

} // namespace sinew::play
