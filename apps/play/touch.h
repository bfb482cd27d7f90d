#pragma once

#include "apps/play/play.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sinew::play {

/// Fingers on a screen, and pens that report as such. One is the pointer with its left button down; two move and
/// scale what is seen, and what the first held is let go. Whatever is left of two fingers does nothing until all are
/// lifted.
class Touch {
  public:
    explicit Touch(Play& play) : play_(play) {}

    void down(std::int64_t finger, Vec2<double> at); ///< pixels of the picture
    void move(std::int64_t finger, Vec2<double> to);
    void up(std::int64_t finger);

    /// Where the finger is, if it is down.
    std::optional<Vec2<double>> place_of(std::int64_t finger) const;

  private:
    struct Finger {
        std::int64_t id = 0;
        Vec2<double> at;
    };
    Play& play_;
    std::vector<Finger> fingers_; ///< in the order in which they came down
    bool points_ = false;         ///< the first is the pointer
};

} // namespace sinew::play
