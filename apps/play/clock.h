#pragma once

namespace sinew::play {

/// Turns the time that passes outside into steps of a fixed length. Frames fall between steps: share() says where.
class Clock {
  public:
    /// A stall longer than this is forgotten instead of caught up with. Seconds.
    static constexpr double longest_stall = 0.1;
    static constexpr double slowest = 0.01, fastest = 8;

    /// `rate`: steps a second, more than 0.
    explicit Clock(double rate) : step_(1 / rate) {}

    /// So many seconds passed outside: how many steps are due. None while paused.
    int advance(double seconds);

    /// How much of the step after the last one has passed, 0 to 1.
    double share() const;

    /// Steps that are due and were not taken (the machine is too slow) are forgotten.
    void forget();

    bool paused() const { return paused_; }
    void pause(bool on);

    /// Simulated seconds a second: 1 is as it should be, 0.25 slow motion. Held within what is possible.
    void set_scale(double scale);
    double scale() const { return scale_; }
    /// Steps a second, more than 0.
    void set_rate(double rate) { step_ = 1 / rate; }

  private:
    double step_;     // seconds
    double left_ = 0; // simulated seconds that are not a whole step yet
    double scale_ = 1;
    bool paused_ = false;
};

} // namespace sinew::play
