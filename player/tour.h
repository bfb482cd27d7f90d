#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sinew::play {

/// A tour of a minute for a new player: a line at a time, until the player has done so or ten seconds have
/// passed.
class Tour {
  public:
    static constexpr double each = 10; ///< seconds

    void begin() { step_ = 0, age_ = 0; }
    void end() { step_ = count(); }
    bool is_on() const { return step_ < count(); }
    void advance(double seconds);
    /// An event of the player (Play::tell).
    void hear(std::string_view what);

    /// The present line, with its number; empty after the end.
    std::string text() const;
    static std::size_t count();

  private:
    std::size_t step_ = count();
    double age_ = 0; ///< seconds of the present line
};

} // namespace sinew::play
