#include "sinew/solver/workers_page.h"

#if defined(__wasm_atomics__)

#include "sinew/solver/worker_pool.h"

namespace sinew {
namespace {

std::atomic<int> serving = 0; ///< threads that serve

detail::WorkerPool& pool() {
    static detail::WorkerPool all;
    return all;
}

/// Made with the module's other variables, by the page's thread: those that serve come later.
[[maybe_unused]] const auto& made = pool();

} // namespace

namespace detail {

void yield_thread() {}

/// The page's own thread may not sleep: it polls.
void wait_while(std::atomic<int>&, int) {}

/// Alone in its function: the first compiler of V8 11.3 forgets variables at the instruction.
[[gnu::noinline]] void wait_serving(std::atomic<int>& number, int old) {
    constexpr std::int64_t for_ever = -1; // nanoseconds
    __builtin_wasm_memory_atomic_wait32(reinterpret_cast<int*>(&number), old, for_ever);
}

void wake_all(std::atomic<int>& number) {
    __builtin_wasm_memory_atomic_notify(reinterpret_cast<int*>(&number), ~0U);
}

} // namespace detail

int hardware_threads() {
    return 1 + serving;
}

void Workers::share_out(const SharedWork& work) {
    const bool done = pool().run(work, [](int) { return hardware_threads(); });
    if (!done)
        for (int part = 0; part < work.parts; ++part) work.call(work.context, part);
}

void serve_page(int number) {
    const int seen = pool().calls();
    ++serving;
    for (;;) pool().serve(number, seen);
}

} // namespace sinew

#endif
