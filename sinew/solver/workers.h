#pragma once

#include <array>
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

/// Stages that work goes through in turns: a stage does one turn after the other, each when the stage before has done
/// it. Threads that help each do whatever is ready, so that none waits for one that is slow, or has lost its core.
class Relay {
  public:
    static constexpr int most_stages = 64;
    Relay(int stages, int turns) : count_(stages), turns_(std::uint64_t(turns)) {}

    /// Calls work(stage, turn) for what is ready, until all is done; with others who do the same.
    template <class Work> void help(const Work& work) {
        for (int stage = next_from(0); stage < count_; stage = next_from(stage + 1)) {
            work(stage, int(turn_of(stage)));
            finish(stage);
        }
    }

  private:
    struct alignas(64) Stage {
        std::atomic<std::uint64_t> done = 0; ///< turns, twice; and one more while the next is being done
    };
    int count_;
    std::uint64_t turns_;
    std::array<Stage, most_stages> stages_;

    /// That it does, or does next.
    std::uint64_t turn_of(int stage) const { return stages_[std::size_t(stage)].done / 2; }
    void finish(int stage) { ++stages_[std::size_t(stage)].done; }
    bool begin(int stage);
    bool over() const { return turn_of(count_ - 1) == turns_; }
    /// Waits until some stage's next turn is ready, and begins it: of this one rather than of another, for what it
    /// touches is near. When all is done, the number of stages.
    int next_from(int stage);
};

struct SharedWork {
    int threads = 0, parts = 0;
    void (*call)(const void* context, int part) = nullptr;
    const void* context = nullptr;
};

/// Calls work(part) for every part in [0, parts), on up to that many threads, the caller's among them. Returns when all
/// are done. Each thread begins with the same share of the parts each time, which is near to it, and then helps others.
/// Threads are started once and kept; while another caller uses them, and where the system gives no more, fewer work.
/// Allocates only when it is asked for more threads than ever before.
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
