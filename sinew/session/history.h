#pragma once

#include "sinew/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sinew {

/// Value of a trace at one step.
struct Sample {
    std::uint64_t step = 0; ///< steps taken
    double seconds = 0;     ///< simulated time
    Vec3<double> value{};   ///< position of a path; other quantities in the first component, in the scene's units

    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [step, seconds, value] = self;
        visit(step, seconds, value);
    }
};

/// Samples of a scene's traces. Memory is bounded: a full trace drops every second sample.
class History {
  public:
    static constexpr std::size_t max_samples = 1024; ///< per trace

    /// Clears all samples and records the present state.
    void restart(const Scene& scene, const AnyWorld& world);
    /// Records the present state. Samples at or after the present step are replaced: a session can go back in time.
    void record(const Scene& scene, const AnyWorld& world);

    /// True if the series match the scene's traces.
    bool is_of(const Scene& scene) const;
    /// State of a snapshot; is_sound() says whether record() could have left it.
    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [series] = self;
        visit(series);
    }
    bool is_sound() const;

    std::size_t size() const { return series_.size(); }
    /// Samples of the trace with index `trace`, oldest first; the last is the present.
    std::span<const Sample> of(std::size_t trace) const { return series_[trace].samples; }

  private:
    struct Series {
        std::string of, shows;
        std::uint64_t spacing = 1; ///< steps between two permanent samples
        std::vector<Sample> samples;

        template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
            auto& [of, shows, spacing, samples] = self;
            visit(of, shows, spacing, samples);
        }
    };

    std::vector<Series> series_;
};

} // namespace sinew
