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

Tasks& tasks_of_program() {
    static Tasks tasks;
    return tasks;
}

/// Exceptions of the caller's end here, before the engine, which knows none.
void run_parallel(void* own, void (*task)(void*, std::uint32_t), void* task_context, std::uint32_t count) noexcept {
    const auto& tasks = *static_cast<const Tasks*>(own);
    tasks.parallel(tasks.context, task, task_context, count);
}

/// A step needs as many handles as there are threads.
void run_tasks(void* own, void (*task)(void*, std::uint32_t), void* task_context, std::uint32_t count) noexcept {
    constexpr std::uint32_t at_once = 64;
    const auto& tasks = *static_cast<const Tasks*>(own);
    std::array<void*, at_once> handles{};
    for (std::uint32_t first = 0; first < count; first += at_once) {
        const auto end = std::min(count, first + at_once);
        for (auto i = first + 1; i < end; ++i) handles[i - first] = tasks.enqueue(tasks.context, task, task_context, i);
        task(task_context, first); // meanwhile
        for (auto i = first + 1; i < end; ++i)
            if (auto* handle = handles[i - first]) tasks.finish(tasks.context, handle);
    }
}

/// Threads of the engine's that are the caller's; `tasks` outlive them.
ProgramThreads threads_of(Tasks& tasks) {
    if (tasks.parallel) return {run_parallel, &tasks};
    if (tasks.enqueue) return {run_tasks, &tasks};
    return {};
}

void set_tasks(const Tasks& tasks) {
    tasks_of_program() = tasks;
    set_program_threads(threads_of(tasks_of_program()));
}

sinew_status set_tasks(sinew_world simulation, const Tasks& tasks) {
    return change_own(simulation, [&](Session& session) {
        auto& known = *simulations().find(simulation.id);
        known.tasks = tasks;
        auto options = session.options();
        options.program_threads = threads_of(known.tasks);
        session.set_options(options);
        return SINEW_OK;
    });
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
    set_tasks({parallel, nullptr, nullptr, context});
}

sinew_status sinew_set_task_system(sinew_enqueue enqueue, sinew_finish finish, void* context) {
    if (!enqueue != !finish) return null_argument();
    set_tasks({nullptr, enqueue, finish, context});
    return SINEW_OK;
}

sinew_status sinew_world_set_parallel(sinew_world simulation, sinew_parallel parallel, void* context) {
    return set_tasks(simulation, {parallel, nullptr, nullptr, context});
}

sinew_status sinew_world_set_task_system(sinew_world simulation, sinew_enqueue enqueue, sinew_finish finish,
                                         void* context) {
    if (!enqueue != !finish) return null_argument();
    return set_tasks(simulation, {nullptr, enqueue, finish, context});
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
