#include "sinew/solver/workers.h"

#if !defined(__wasm__) // workers_single.cpp

#include <algorithm>
#include <atomic>
#include <deque>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace sinew {
namespace {

/// Polls ready(), at full speed and then yielding; false after a while. A step ends sooner than a thread can sleep and
/// wake, but cores may be shared.
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

    /// False if another caller uses the pool.
    bool run(const SharedWork& work) {
        const std::unique_lock lock(in_use_, std::try_to_lock);
        if (!lock) return false;
        start(std::min(work.threads, work.parts));
        work_ = work;
        work_.threads = std::min({work.threads, work.parts, int(threads_.size()) + 1});
        for (int i = 0; i < shares(); ++i) next_[std::size_t(i)].part = first_of(i);
        inside_ = 0;
        call_all();
        do_share(0);
        inside_ |= closed;
        while (!soon([&] { return inside_ == closed; }))
            if (const int left = inside_; left != closed) inside_.wait(left);
        return true;
    }

  private:
    /// First part of a share not taken by any thread.
    struct alignas(64) Next {
        std::atomic<int> part = 0;
    };
    static constexpr int closed = 1 << 30;

    std::mutex in_use_;
    std::vector<std::thread> threads_;
    std::deque<Next> next_; ///< by share: the caller's, then one per thread
    SharedWork work_;
    std::atomic<int> inside_ = closed; ///< number of working threads; `closed` is set when no part is left
    std::atomic<int> calls_ = 0;       ///< incremented by each run
    std::atomic<bool> stopping_ = false;

    /// Starts threads up to a total of `threads`, the caller's included.
    void start(int threads) {
        threads_.reserve(std::size_t(threads - 1));
        while (int(next_.size()) < threads) next_.emplace_back();
        while (int(threads_.size()) < threads - 1) {
            try {
                threads_.emplace_back(
                    [this, number = int(threads_.size()) + 1, seen = calls_.load()] { serve(number, seen); });
            } catch (const std::system_error&) {
                return; // no more threads from the system
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
            if (!enter()) continue;
            if (number < work_.threads) do_share(number);
            if (--inside_ == closed) inside_.notify_all();
        }
    }

    bool enter() {
        int inside = inside_;
        while ((inside & closed) == 0)
            if (inside_.compare_exchange_weak(inside, inside + 1)) return true;
        return false;
    }

    int shares() const { return work_.threads; }
    int first_of(int share) const { return int(std::int64_t(work_.parts) * share / shares()); }

    /// Does a share, then the rest of the others.
    void do_share(int number) {
        for (int i = 0; i < shares(); ++i) {
            const int share = (number + i) % shares();
            auto& next = next_[std::size_t(share)].part;
            for (int part = next++; part < first_of(share + 1); part = next++) work_.call(work_.context, part);
        }
    }
};

} // namespace

bool WavefrontScheduler::begin(int stage) {
    auto& done = stages_[std::size_t(stage)].done;
    auto seen = done.load();
    const bool ready = seen % 2 == 0 && seen / 2 < turns_ && (stage == 0 || turn_of(stage - 1) > seen / 2);
    return ready && done.compare_exchange_strong(seen, seen + 1);
}

int WavefrontScheduler::next_from(int stage) {
    int found = count_;
    const auto ready = [&] {
        for (int i = 0; i < count_; ++i)
            if (const int other = (stage + i) % count_; begin(other)) {
                found = other;
                return true;
            }
        return over();
    };
    while (!soon(ready)) {
    }
    return found;
}

int hardware_threads() {
    return std::max(1, int(std::thread::hardware_concurrency()));
}

int threads_for(std::size_t particles, int wanted) {
    constexpr std::size_t worth_it = 4096;
    if (particles < worth_it) return 1;
    return wanted > 0 ? wanted : hardware_threads();
}

void Workers::share_out(const SharedWork& work) {
    static Pool pool;
    if (!pool.run(work))
        for (int part = 0; part < work.parts; ++part) work.call(work.context, part);
}

} // namespace sinew

#endif
