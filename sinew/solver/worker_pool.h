#pragma once

#include "sinew/solver/workers.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <deque>

/// Threads that share parts of work, wherever the threads come from: the system (workers.cpp) or a page
/// (workers_page.cpp).
namespace sinew::detail {

// Defined where the threads are.

/// Gives the processor to another thread, if the system can.
void yield_thread();
/// Sleeps while the number is `old`, unless the thread may not sleep. May return early.
void wait_while(std::atomic<int>& number, int old);
/// The same in a thread that serves, which may sleep.
void wait_serving(std::atomic<int>& number, int old);
void wake_all(std::atomic<int>& number);

/// Polls ready(), at full speed and then yielding; false after a while. A step ends sooner than a thread can sleep and
/// wake, but cores may be shared.
template <class Ready> bool soon(Ready&& ready) {
    constexpr int quick = 2000, polite = 200;
    for (int i = 0; i < quick; ++i)
        if (ready()) return true;
    for (int i = 0; i < polite; ++i) {
        if (ready()) return true;
        yield_thread();
    }
    return false;
}

class WorkerPool {
  public:
    /// Does the work, together with the threads that serve. `start(threads)` may start threads and returns their
    /// number, the caller's included. False if another caller uses the pool.
    template <class Start> bool run(const SharedWork& work, Start&& start) {
        if (in_use_.exchange(true)) return false;
        const int wanted = std::min(work.threads, work.parts);
        while (int(next_.size()) < wanted) next_.emplace_back();
        work_ = work;
        work_.threads = std::min(wanted, int(start(wanted)));
        for (int i = 0; i < shares(); ++i) next_[std::size_t(i)].part = first_of(i);
        inside_ = 0;
        call_all();
        do_share(0);
        inside_ |= closed;
        while (!soon([&] { return inside_ == closed; }))
            if (const int left = inside_; left != closed) wait_while(inside_, left);
        in_use_ = false;
        return true;
    }

    /// Number of calls so far, from which a new thread serves.
    int calls() const { return calls_; }

    /// Takes part in every run after the first `seen`, as thread `number`, from 1, until stop().
    void serve(int number, int seen) {
        for (;;) {
            if (!soon([&] { return calls_ != seen; })) wait_serving(calls_, seen);
            if (calls_ == seen) continue;
            seen = calls_;
            if (stopping_) return;
            if (!enter()) continue;
            if (number < work_.threads) do_share(number);
            if (--inside_ == closed) wake_all(inside_);
        }
    }

    void stop() {
        stopping_ = true;
        call_all();
    }

  private:
    /// First part of a share not taken by any thread.
    struct alignas(64) Next {
        std::atomic<int> part = 0;
    };
    static constexpr int closed = 1 << 30;

    std::deque<Next> next_; ///< by share: the caller's, then one per thread
    SharedWork work_;
    std::atomic<int> inside_ = closed; ///< number of working threads; `closed` is set when no part is left
    std::atomic<int> calls_ = 0;       ///< incremented by each run
    std::atomic<bool> in_use_ = false, stopping_ = false;

    void call_all() {
        ++calls_;
        wake_all(calls_);
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

} // namespace sinew::detail
