#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string_view>

/// Time of a step by phase.
namespace sinew {

enum class Phase : std::uint8_t {
    prepare, ///< random forces, limits, planning
    blocks,  ///< direct blocks
    sweep,   ///< projection of the other constraints; all of classic mode
    finish   ///< tearing
};
inline constexpr std::array<std::string_view, 4> phase_names = {"prepare", "blocks", "sweep", "finish"};

/// Seconds spent in each phase, summed over steps.
struct PhaseTimes {
    std::array<double, phase_names.size()> seconds{};
    std::uint64_t steps = 0;
};

namespace detail {

/// Stopwatch for the phases of a step.
class Laps {
  public:
    /// `times` may be null: then no clock is read.
    explicit Laps(PhaseTimes* times) : times_(times) {
        if (!times_) return;
        ++times_->steps;
        last_ = Clock::now();
    }
    /// Ends the current phase.
    void end(Phase phase) {
        if (!times_) return;
        const auto now = Clock::now();
        times_->seconds[std::size_t(phase)] += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

  private:
    using Clock = std::chrono::steady_clock;
    PhaseTimes* times_;
    Clock::time_point last_;
};

} // namespace detail
} // namespace sinew
