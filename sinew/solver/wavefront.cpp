#include "sinew/solver/worker_pool.h"

namespace sinew {

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
    while (!detail::soon(ready)) {
    }
    return found;
}

int threads_for(std::size_t particles, int wanted) {
    constexpr std::size_t worth_it = 4096;
    if (particles < worth_it) return 1;
    return wanted > 0 ? wanted : hardware_threads();
}

} // namespace sinew
