#include "sinew/solver/workers.h"

#if !defined(__wasm__) // workers_page.cpp, workers_single.cpp

#include "sinew/solver/worker_pool.h"

#include <system_error>
#include <thread>
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
        while (int(threads_.size()) < threads - 1) {
            try {
                threads_.emplace_back(
                    [this, number = int(threads_.size()) + 1, seen = pool_.calls()] { pool_.serve(number, seen); });
            } catch (const std::system_error&) {
                return; // no more threads from the system
            }
        }
    }
};

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

void Workers::share_out(const SharedWork& work) {
    static Pool pool;
    if (!pool.run(work))
        for (int part = 0; part < work.parts; ++part) work.call(work.context, part);
}

} // namespace sinew

#endif
