#include "sinew/assert/assert.h"
#include "sinew/scene/text.h"
#include "sinew/solver/program_threads.h"
#include "sinew/solver/simd/kernel.h"

#include "bindings/c/simulation.h"

#include <algorithm>
#include <array>

/// Functions of the caller in place of the library's own.
using namespace sinew;
using namespace sinew::c;

namespace {

/// Tasks of the caller, of whose handles each step needs as many as there are threads.
struct TaskSystem {
    sinew_enqueue enqueue = nullptr;
    sinew_finish finish = nullptr;
    void* context = nullptr;
} tasks;

/// The caller's function that runs tasks.
struct Parallel {
    sinew_parallel run = nullptr;
    void* context = nullptr;
} parallel_of_caller;

/// Exceptions of the caller's end here, before the engine, which knows none.
void run_parallel(void*, void (*task)(void*, std::uint32_t), void* task_context, std::uint32_t count) noexcept {
    parallel_of_caller.run(parallel_of_caller.context, task, task_context, count);
}

void run_tasks(void*, void (*task)(void*, std::uint32_t), void* task_context, std::uint32_t count) noexcept {
    constexpr std::uint32_t at_once = 64;
    std::array<void*, at_once> handles{};
    for (std::uint32_t first = 0; first < count; first += at_once) {
        const auto end = std::min(count, first + at_once);
        for (auto i = first + 1; i < end; ++i) handles[i - first] = tasks.enqueue(tasks.context, task, task_context, i);
        task(task_context, first); // meanwhile
        for (auto i = first + 1; i < end; ++i)
            if (auto* handle = handles[i - first]) tasks.finish(tasks.context, handle);
    }
}

} // namespace

extern "C" {

void sinew_set_log(sinew_log log, void* context) {
    failure_log() = {log, context};
}

void sinew_set_assertion_handler(sinew_assertion_handler handler) {
    set_assertion_handler(handler);
}

void sinew_set_parallel(sinew_parallel parallel, void* context) {
    parallel_of_caller = {parallel, context};
    set_program_threads({parallel ? run_parallel : nullptr, nullptr});
}

sinew_status sinew_set_task_system(sinew_enqueue enqueue, sinew_finish finish, void* context) {
    if (!enqueue != !finish) return null_argument();
    tasks = {enqueue, finish, context};
    set_program_threads({enqueue ? run_tasks : nullptr, nullptr});
    return SINEW_OK;
}

sinew_status sinew_world_set_simd(sinew_world simulation, const char* name) {
    const auto simd = name ? simd_called(name) : best_simd();
    if (!simd)
        return fail(SINEW_NOT_FOUND, concat("this machine or this library has no instruction set ", in_quotes(name)));
    return change_own(simulation, [&](Session& session) {
        auto options = session.options();
        options.simd = *simd;
        session.set_options(options);
        return SINEW_OK;
    });
}

sinew_status sinew_world_set_threads(sinew_world simulation, uint32_t threads) {
    constexpr std::uint32_t most = 1024;
    return change_own(simulation, [&](Session& session) {
        auto options = session.options();
        options.threads = int(std::min(threads, most));
        session.set_options(options);
        return SINEW_OK;
    });
}

} // extern "C"
