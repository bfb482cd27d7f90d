#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string_view>

/// Where the time of a step goes.
namespace sinew {

enum class Phase : std::uint8_t {
    prepare, ///< forces of the moment, what is out of limits, plans that are no longer true
    blocks,  ///< what is solved at once
    sweep,   ///< what is projected one after the other; all of classic mode
    finish   ///< what tears
};
inline constexpr std::array<std::string_view, 4> phase_names = {"prepare", "blocks", "sweep", "finish"};

/// Seconds that the steps of a while spent in each phase.
struct PhaseTimes {
    std::array<double, phase_names.size()> seconds{};
    std::uint64_t steps = 0;
};

/// While it lives, the steps of this thread add their times to `times`; without one no clock is read.
class Profile {
  public:
    explicit Profile(PhaseTimes& times) : outer_(current) { current = &times; }
    Profile(const Profile&) = delete;
    Profile& operator=(const Profile&) = delete;
    ~Profile() { current = outer_; }

    static inline thread_local PhaseTimes* current = nullptr;

  private:
    PhaseTimes* outer_;
};

namespace detail {

/// One step, phase after phase.
class Laps {
  public:
    Laps() : times_(Profile::current) {
        if (!times_) return;
        ++times_->steps;
        last_ = Clock::now();
    }
    /// The phase that ends now.
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
