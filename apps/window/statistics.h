#pragma once

#include "apps/play/play.h"
#include "apps/window/look.h"

#include <deque>

namespace sinew::window {

/// What the world has and what it costs, over time.
class Statistics {
  public:
    void frame(double seconds) { frame_ += (seconds * 1000 - frame_) * 0.1; }
    /// So many steps took so long, together.
    void steps(double seconds, std::uint64_t count);
    /// Measures the world every now and then.
    void sample(play::Play& play);
    void show(play::Play& play, const Look& look, const Fonts& fonts, float scale);

  private:
    static constexpr std::size_t most = 240;

    struct Energies {
        float kinetic, potential, stored;
    };

    double frame_ = 16, step_ = 0; ///< milliseconds, smoothed
    std::deque<float> step_times_;
    std::deque<Energies> energies_;
    Report report_;
    double largest_tension_ = 0;
    std::string scene_;
    std::uint64_t sampled_ = 0;
    double since_ = 0;
};

} // namespace sinew::window
