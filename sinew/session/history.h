#pragma once

#include "sinew/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sinew {

/// A trace at one moment.
struct Sample {
    std::uint64_t step = 0; ///< steps taken
    double seconds = 0;     ///< simulated
    Vec3<double> value{};   ///< of a path the place; else the value is the first component, in the scene's units
};

/// What a scene's traces have shown so far. Bounded: where a trace is full, every second sample goes.
class History {
  public:
    static constexpr std::size_t most_samples = 1024; ///< of one trace

    /// Forgets everything and notes the present.
    void restart(const Scene& scene, const AnyWorld& world);
    /// Notes the present. Samples that are not older are replaced: a session can go back in time.
    void record(const Scene& scene, const AnyWorld& world);

    /// Whether it is of the same traces.
    bool is_of(const Scene& scene) const;

    std::size_t size() const { return series_.size(); }
    /// Samples of the scene's trace of that number, oldest first; the last is the present.
    std::span<const Sample> of(std::size_t trace) const { return series_[trace].samples; }

  private:
    struct Series {
        std::string of, shows;
        std::uint64_t spacing = 1; ///< steps between two samples that stay
        std::vector<Sample> samples;
    };

    std::vector<Series> series_;
};

} // namespace sinew
