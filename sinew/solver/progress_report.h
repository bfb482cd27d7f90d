#pragma once

#include <functional>
#include <utility>

/// Progress of preparing a large world for the first step (prepare, step.h).
namespace sinew {

/// Scope guard: `told` receives the progress of worlds prepared on this thread, from 0 to 1, never decreasing.
class Waiting {
  public:
    using Told = std::function<void(double share)>;

    explicit Waiting(Told told) : told_(std::move(told)), outer_(current) { current = this; }
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;
    ~Waiting() { current = outer_; }

    static void tell(double share) {
        if (current) current->told_(share);
    }

  private:
    static inline thread_local Waiting* current = nullptr;
    Told told_;
    Waiting* outer_;
};

} // namespace sinew
