#pragma once

#include <functional>
#include <utility>

/// Getting a large world ready for its first step takes a while (prepare, step.h).
namespace sinew {

/// While it lives, worlds of this thread tell how far they are with it: shares from 0 to 1 that never fall.
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
