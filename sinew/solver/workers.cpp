#include "sinew/solver/workers.h"

#if !defined(__wasm__) // workers_page.cpp, workers_single.cpp

#include "sinew/solver/program_threads.h"
#include "sinew/solver/worker_pool.h"

#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace sinew {
namespace {

class Pool {
  public:
    ~Pool() {
        pool_.stop();
        for (auto& thread : threads_) thread.join();
    }

    bool run(const SharedWork& work) {
        return pool_.run(work, [this](int threads) {
            start(threads);
            return int(threads_.size()) + 1;
        });
    }

  private:
    detail::WorkerPool pool_;
    std::vector<std::thread> threads_;

    /// Starts threads up to a total of `threads`, the caller's included.
    void start(int threads) {
        threads_.reserve(std::size_t(threads - 1));
        while (int(threads_.size()) < threads - 1 && start_one()) {
        }
    }

    /// False where the system has no more threads; compiled without exceptions, the program then ends.
    bool start_one() {
#ifdef __cpp_exceptions
        try {
#endif
            threads_.emplace_back(
                [this, number = int(threads_.size()) + 1, seen = pool_.calls()] { pool_.serve(number, seen); });
            return true;
#ifdef __cpp_exceptions
        } catch (const std::system_error&) {
            return false;
        }
#endif
    }
};

ProgramThreads& program_threads() {
    static ProgramThreads threads;
    return threads;
}

/// Threads of the step that the calling thread takes.
ProgramThreads& threads_of_steps() {
    static thread_local ProgramThreads threads;
    return threads;
}

/// Does the work on threads of the program, which take parts until none is left.
void run_on(const ProgramThreads& threads, const SharedWork& work) {
    struct Share {
        const SharedWork& work;
        std::atomic<int> next = 0;
    } share{work};
    const auto task = [](void* context, std::uint32_t) {
        auto& mine = *static_cast<Share*>(context);
        for (int part = mine.next++; part < mine.work.parts; part = mine.next++)
            mine.work.call(mine.work.context, part);
    };
    threads.run(threads.context, task, &share, std::uint32_t(std::min(work.threads, work.parts)));
}

} // namespace

namespace detail {

void yield_thread() {
    std::this_thread::yield();
}

void wait_while(std::atomic<int>& number, int old) {
    number.wait(old);
}

void wait_serving(std::atomic<int>& number, int old) {
    number.wait(old);
}

void wake_all(std::atomic<int>& number) {
    number.notify_all();
}

} // namespace detail

int hardware_threads() {
    return std::max(1, int(std::thread::hardware_concurrency()));
}

void set_program_threads(const ProgramThreads& threads) {
    program_threads() = threads;
}

ThreadsOfSteps::ThreadsOfSteps(const ProgramThreads& threads) : before_(std::exchange(threads_of_steps(), threads)) {}

ThreadsOfSteps::~ThreadsOfSteps() {
    threads_of_steps() = before_;
}

void Workers::share_out(const SharedWork& work) {
    const auto& own = threads_of_steps().run ? threads_of_steps() : program_threads();
    if (own.run) return run_on(own, work);
    static Pool pool;
    if (!pool.run(work))
        for (int part = 0; part < work.parts; ++part) work.call(work.context, part);
}

} // namespace sinew

#endif
