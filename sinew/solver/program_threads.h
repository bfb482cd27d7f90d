#pragma once

#include <cstdint>

namespace sinew {

/// Threads of the program in place of the engine's: calls task(task_context, i) for each i below `count` once, on any
/// threads, and returns when all calls have. Null: the engine's own (workers.h).
struct ProgramThreads {
    void (*run)(void* context, void (*task)(void* task_context, std::uint32_t index), void* task_context,
                std::uint32_t count) = nullptr;
    void* context = nullptr;
};

/// For every world, from the next step on; called while no step runs. Results do not depend on the threads.
void set_program_threads(const ProgramThreads& threads);

/// Scope in which the steps of the calling thread use these threads; none: the ones for every world.
#if defined(__wasm__)
struct ThreadsOfSteps {
    explicit ThreadsOfSteps(const ProgramThreads&) {}
};
#else
class ThreadsOfSteps {
  public:
    explicit ThreadsOfSteps(const ProgramThreads& threads);
    ThreadsOfSteps(const ThreadsOfSteps&) = delete;
    ThreadsOfSteps& operator=(const ThreadsOfSteps&) = delete;
    ~ThreadsOfSteps();

  private:
    ProgramThreads before_;
};
#endif

} // namespace sinew
