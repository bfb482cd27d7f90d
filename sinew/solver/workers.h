#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

/// The one place that knows threads. Work is cut into parts that touch nothing in common, so that who does which part,
/// and when, changes no bit of the result.
namespace sinew {

/// How many threads there are to use: one for each core of the machine.
int hardware_threads();
/// As many of those that are wanted (0: all) as help where so many particles are moved (docs/performance.md).
int threads_for(std::size_t particles, int wanted);

/// How far a part has come, for another that follows it.
class Progress {
  public:
    void reach(std::uint64_t time) { reached_.store(time, std::memory_order_release); }
    /// Returns when it is there.
    void await(std::uint64_t time) const {
        if (reached_.load(std::memory_order_acquire) < time) wait(time);
    }

  private:
    alignas(64) std::atomic<std::uint64_t> reached_ = 0;
    void wait(std::uint64_t time) const;
};

struct SharedWork {
    int threads = 0, parts = 0;
    bool in_order = false;
    void (*call)(const void* context, int part) = nullptr;
    const void* context = nullptr;
};

/// Calls work(part) for every part in [0, parts), on up to that many threads, the caller's among them. Returns when all
/// are done. Threads are started once and kept; while another caller uses them, and where the system gives no more,
/// fewer work. Allocates only when it is asked for more threads than ever before.
class Workers {
  public:
    /// Each thread begins with the same share of the parts each time: what they touch is still near to it.
    template <class Work> static void run(int threads, int parts, const Work& work) {
        run(threads, parts, false, work);
    }
    /// Parts are begun in their order, so that one may await an earlier one.
    template <class Work> static void run_in_order(int threads, int parts, const Work& work) {
        run(threads, parts, true, work);
    }

  private:
    template <class Work> static void run(int threads, int parts, bool in_order, const Work& work) {
        if (threads < 2 || parts < 2) {
            for (int part = 0; part < parts; ++part) work(part);
            return;
        }
        const auto call = [](const void* context, int part) { (*static_cast<const Work*>(context))(part); };
        share_out({threads, parts, in_order, call, &work});
    }
    static void share_out(const SharedWork& work);
};

} // namespace sinew
