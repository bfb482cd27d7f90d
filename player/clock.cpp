#include "player/clock.h"

#include <algorithm>
#include <cmath>

namespace sinew::play {
namespace {

/// Tolerance as a fraction of a step: a frame as long as a step is one step in spite of rounding errors.
constexpr double rounding = 1e-6;

} // namespace

int Clock::advance(double seconds) {
    if (paused_ || !(seconds > 0)) return 0;
    left_ += std::min(seconds, longest_stall) * scale_;
    const double whole = std::floor(left_ / step_ + rounding);
    left_ = std::max(left_ - whole * step_, 0.0);
    return int(whole);
}

double Clock::share() const {
    return std::clamp(left_ / step_, 0.0, 1.0);
}

void Clock::forget() {
    left_ = 0;
}

void Clock::pause(bool on) {
    paused_ = on;
    left_ = 0;
}

void Clock::set_scale(double scale) {
    scale_ = std::isfinite(scale) ? std::clamp(scale, slowest, fastest) : 1;
}

} // namespace sinew::play
