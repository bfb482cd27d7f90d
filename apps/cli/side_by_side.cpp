#include "apps/cli/side_by_side.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace sinew::cli {
namespace {

/// Each thread has files and a child process to clean up on an interruption (canvas/interrupt.h remembers 32 of each).
constexpr std::size_t max_at_once = 4;

} // namespace

void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t)>& finished) {
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> failed = false;
    std::size_t done = 0;
    std::mutex telling;
    std::vector<std::exception_ptr> thrown(count);
    const auto take_turns = [&] {
        for (std::size_t i = next++; i < count && !failed; i = next++) {
            try {
                work(i);
                const std::lock_guard lock(telling);
                finished(++done);
            } catch (...) {
                thrown[i] = std::current_exception();
                failed = true;
            }
        }
    };
    {
        const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < std::min({processors, max_at_once, count}); ++i) others.emplace_back(take_turns);
        take_turns();
    }
    for (const auto& error : thrown)
        if (error) std::rethrow_exception(error);
}

} // namespace sinew::cli
