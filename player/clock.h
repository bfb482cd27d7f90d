#pragma once

namespace sinew::play {

/// Converts real time into steps of a fixed length, with the remainder of a step as share().
class Clock {
  public:
    /// Longest stall to catch up with, seconds; the rest of a longer one is dropped.
    static constexpr double longest_stall = 0.1;
    static constexpr double slowest = 0.01, fastest = 8;

    /// `rate`: steps per second, above 0.
    explicit Clock(double rate) : step_(1 / rate) {}

    /// Number of steps due after `seconds` more of real time; 0 while paused.
    int advance(double seconds);

    /// Elapsed fraction of the step in progress, 0 to 1.
    double share() const;

    /// Drops the remainder, for a machine too slow to take all steps due.
    void forget();

    bool paused() const { return paused_; }
    void pause(bool on);

    /// Simulated seconds per real second: 1 is real time, 0.25 slow motion. Clamped to [slowest, fastest].
    void set_scale(double scale);
    double scale() const { return scale_; }
    /// Steps per second, above 0.
    void set_rate(double rate) { step_ = 1 / rate; }

  private:
    double step_;     // seconds
    double left_ = 0; // simulated seconds, remainder of less than a step
    double scale_ = 1;
    bool paused_ = false;
};

} // namespace sinew::play
