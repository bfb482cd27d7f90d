// Platforms whose standard library has no threads.
#include "sinew/solver/workers.h"

#if defined(__wasm__)

namespace sinew {

int hardware_threads() {
    return 1;
}

int threads_for(std::size_t, int) {
    return 1;
}

void Workers::share_out(const SharedWork& work) {
    for (int part = 0; part < work.parts; ++part) work.call(work.context, part);
}

/// Alone, the stages are ready one after the other.
bool WavefrontScheduler::begin(int stage) {
    auto& done = stages_[std::size_t(stage)].done;
    const auto seen = done.load();
    const bool ready = seen % 2 == 0 && seen / 2 < turns_ && (stage == 0 || turn_of(stage - 1) > seen / 2);
    if (ready) done = seen + 1;
    return ready;
}

int WavefrontScheduler::next_from(int stage) {
    for (int i = 0; i < count_; ++i)
        if (const int other = (stage + i) % count_; begin(other)) return other;
    return count_;
}

} // namespace sinew

#endif
