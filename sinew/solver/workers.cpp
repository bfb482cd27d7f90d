#include "sinew/solver/workers.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace sinew {
namespace {

/// Waits until ready() for a moment at full speed, then lets others have the core: a step is over in less than a thread
/// takes to fall asleep and wake, but cores may be shared.
template <class Ready> bool soon(Ready&& ready) {
    constexpr int quick = 2000, polite = 200;
    for (int i = 0; i < quick; ++i)
        if (ready()) return true;
    for (int i = 0; i < polite; ++i) {
        if (ready()) return true;
        std::this_thread::yield();
    }
    return false;
}

class Pool {
  public:
    ~Pool() {
        stopping_ = true;
        call_all();
        for (auto& thread : threads_) thread.join();
    }

    /// False where others use it already.
    bool run(int threads, int parts, void (*call)(const void*, int), const void* context) {
        const std::unique_lock lock(in_use_, std::try_to_lock);
        if (!lock) return false;
        start(std::min(threads, parts) - 1);
        call_ = call, context_ = context, parts_ = parts;
        next_ = 0;
        wanted_ = std::min({threads, parts, int(threads_.size()) + 1}) - 1;
        working_ = int(threads_.size());
        call_all();
        work();
        while (!soon([&] { return working_ == 0; }))
            if (const int left = working_; left != 0) working_.wait(left);
        return true;
    }

  private:
    std::mutex in_use_;
    std::vector<std::thread> threads_;
    void (*call_)(const void*, int) = nullptr;
    const void* context_ = nullptr;
    int parts_ = 0, wanted_ = 0;
    std::atomic<int> next_ = 0;    ///< part nobody does yet
    std::atomic<int> working_ = 0; ///< threads that have not finished
    std::atomic<int> calls_ = 0;   ///< rises with each run
    std::atomic<bool> stopping_ = false;

    void start(int count) {
        threads_.reserve(std::size_t(std::max(count, 0)));
        while (int(threads_.size()) < count) {
            try {
                threads_.emplace_back(
                    [this, number = int(threads_.size()), seen = calls_.load()] { serve(number, seen); });
            } catch (const std::system_error&) {
                return; // the system has no more
            }
        }
    }

    void call_all() {
        ++calls_;
        calls_.notify_all();
    }

    void serve(int number, int seen) {
        for (;;) {
            if (!soon([&] { return calls_ != seen; })) calls_.wait(seen);
            if (calls_ == seen) continue;
            seen = calls_;
            if (stopping_) return;
            if (number < wanted_) work();
            if (--working_ == 0) working_.notify_all();
        }
    }

    void work() {
        for (int part = next_++; part < parts_; part = next_++) call_(context_, part);
    }
};

} // namespace

void Progress::wait(unsigned time) const {
    while (!soon([&] { return reached_.load(std::memory_order_acquire) >= time; })) {
    }
}

int hardware_threads() {
    return std::max(1, int(std::thread::hardware_concurrency()));
}

void Workers::share_out(int threads, int parts, void (*call)(const void*, int), const void* context) {
    static Pool pool;
    if (!pool.run(threads, parts, call, context))
        for (int part = 0; part < parts; ++part) call(context, part);
}

} // namespace sinew
