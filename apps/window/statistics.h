#pragma once

#include "sinew/solver/profile.h"

#include "apps/window/look.h"
#include "player/play.h"

#include <deque>
#include <string>
#include <vector>

namespace sinew::window {

/// "20 distance, 4 angle": number of constraints of each kind, by the kind's own name.
std::string kinds_of(const AnyWorld& world);

/// Counts, times and energies of the running session.
class Statistics {
  public:
    void frame(double seconds) { frame_ += (seconds * 1000 - frame_) * 0.1; }
    /// Records `count` steps that took `seconds` together, and the times of the phases.
    void steps(double seconds, std::uint64_t count, const PhaseTimes& phases);
    /// Samples the world at most ten times per second.
    void sample(play::Play& play);
    void show(play::Play& play, const Look& look, const Fonts& fonts, float scale);
    /// Curves of chosen quantities over the last samples.
    void plots(play::Play& play, const Look& look, const Fonts& fonts, float scale);
    std::size_t samples() const { return energies_.size(); }
    const Report& report() const { return report_; }

  private:
    /// A quantity, and its values at the samples.
    struct Plot {
        std::string quantity;
        std::deque<float> values;
    };
    void numbers(play::Play& play, const Look& look) const;
    void hash(play::Play& play, const Look& look, const Fonts& fonts) const;
    void times(const Look& look, float scale) const;
    void energies(const Look& look, float scale) const;

    static constexpr std::size_t max = 240;

    struct Energies {
        float kinetic, potential, stored; ///< joules
    };

    double frame_ = 16, step_ = 0; ///< milliseconds, smoothed
    /// Milliseconds per step to the end of each phase; last, the whole step with the scene's drivers.
    using StepTimes = std::array<float, phase_names.size() + 1>;
    std::deque<StepTimes> step_times_;
    std::deque<Energies> energies_;
    Report report_;
    double largest_tension_ = 0;
    std::vector<Plot> plots_;
    std::string scene_;
    std::uint64_t sampled_ = ~0ULL; ///< revision of the timeline at the last sample
    double since_ = 0;
};

} // namespace sinew::window
