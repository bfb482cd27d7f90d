#pragma once

#include "player/play.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sinew::play {

/// Fingers on a screen, and pens reported as fingers. A single finger is the pointer with its left button down; a
/// second finger releases the button, and both together pan and zoom. After a gesture of two fingers, a remaining
/// finger has no effect until all are lifted.
class Touch {
  public:
    explicit Touch(Play& play) : play_(play) {}

    void down(std::int64_t finger, Vec2<double> at); ///< pixels of the picture
    void move(std::int64_t finger, Vec2<double> to);
    void up(std::int64_t finger);

    /// Position of the finger, if down.
    std::optional<Vec2<double>> position_of(std::int64_t finger) const;

  private:
    struct Finger {
        std::int64_t id = 0;
        Vec2<double> at;
    };
    Play& play_;
    std::vector<Finger> fingers_; ///< in the order of touching down
    bool points_ = false;         ///< the first finger is the pointer
};

} // namespace sinew::play
