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

} // namespace sinew
