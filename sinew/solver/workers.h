#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

/// Threads; no other file uses any. Work is divided into independent parts, so the schedule changes no bit of the
/// result.
namespace sinew {

/// Number of cores of the machine, at least 1.
int hardware_threads();
/// Number of threads worth using for so many particles (docs/measured/performance.md): 1 for few, otherwise `wanted`,
/// or all cores if `wanted` is 0.
int threads_for(std::size_t particles, int wanted);

/// Wavefront scheduler: every stage does all turns in order, each after the stage before has done the same turn.
/// Helping threads take any ready turn, so no thread waits for a slow or preempted one.
class WavefrontScheduler {
  public:
    static constexpr int max_stages = 64;
    WavefrontScheduler(int stages, int turns) : count_(stages), turns_(std::uint64_t(turns)) {}

    /// Calls work(stage, turn) for ready turns until all are done, together with other threads doing the same.
    template <class Work> void help(const Work& work) {
        for (int stage = next_from(0); stage < count_; stage = next_from(stage + 1)) {
            work(stage, int(turn_of(stage)));
            finish(stage);
        }
    }

  private:
    struct alignas(64) Stage {
        std::atomic<std::uint64_t> done = 0; ///< twice the turns done, plus 1 while a turn is in progress
    };
    int count_;
    std::uint64_t turns_;
    std::array<Stage, max_stages> stages_;

    /// Current or next turn of a stage.
    std::uint64_t turn_of(int stage) const { return stages_[std::size_t(stage)].done / 2; }
    void finish(int stage) { ++stages_[std::size_t(stage)].done; }
    bool begin(int stage);
    bool over() const { return turn_of(count_ - 1) == turns_; }
    /// Waits for a ready turn and begins it, preferably of the given stage, whose data are in cache. Returns the stage,
    /// or the number of stages when all turns are done.
    int next_from(int stage);
};

struct SharedWork {
    int threads = 0, parts = 0;
    void (*call)(const void* context, int part) = nullptr;
    const void* context = nullptr;
};

/// Calls work(part) for every part in [0, parts) on up to `threads` threads, including the caller's. Returns when all
/// are done. Each thread begins with the same share of the parts in every call, for the cache, and then helps others.
/// Threads are started once and kept; fewer work while another caller uses the pool, or if the system has no more.
/// Allocates only for more threads than ever before.
class Workers {
  public:
    template <class Work> static void run(int threads, int parts, const Work& work) {
        if (threads < 2 || parts < 2) {
            for (int part = 0; part < parts; ++part) work(part);
            return;
        }
        const auto call = [](const void* context, int part) { (*static_cast<const Work*>(context))(part); };
        share_out({threads, parts, call, &work});
    }

  private:
    static void share_out(const SharedWork& work);
};

} // namespace sinew
