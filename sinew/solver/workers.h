#pragma once

#include <atomic>

/// The one place that knows threads. Work is cut into parts that touch nothing in common, so that who does which part,
/// and when, changes no bit of the result.
namespace sinew {

/// How many threads there are to use: one for each core of the machine.
int hardware_threads();

/// How far a part has come, for another that follows it.
class Progress {
  public:
    void reach(unsigned time) { reached_.store(time, std::memory_order_release); }
    /// Returns when it is there.
    void await(unsigned time) const {
        if (reached_.load(std::memory_order_acquire) < time) wait(time);
    }

  private:
    alignas(64) std::atomic<unsigned> reached_ = 0;
    void wait(unsigned time) const;
};

/// Calls work(part) for every part in [0, parts), on up to that many threads, the caller's among them. Returns when all
/// are done. Parts are begun in their order, so that one may await an earlier one. Threads are started once and kept;
/// while another caller uses them, and where the system gives no more, fewer work. Allocates only when it is asked for
/// more threads than ever before.
class Workers {
  public:
    template <class Work> static void run(int threads, int parts, const Work& work) {
        if (threads < 2 || parts < 2) {
            for (int part = 0; part < parts; ++part) work(part);
            return;
        }
        share_out(
            threads, parts, [](const void* context, int part) { (*static_cast<const Work*>(context))(part); }, &work);
    }

  private:
    static void share_out(int threads, int parts, void (*call)(const void*, int), const void* context);
};

} // namespace sinew
