#include "apps/cli/process_limits.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "canvas/interrupt.h"

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fmt/format.h>
#include <new>
#include <string>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

namespace sinew::cli {
namespace {

/// Last words, formatted in advance: a signal handler may not allocate, and out of memory nobody can. Global because
/// handlers take no arguments.
std::string memory_message, time_message;

[[noreturn]] void end_with(const std::string& message) {
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message.data(), message.size());
    canvas::end_at_once(bad_input);
}

void end_for_memory() {
    end_with(memory_message);
}

void end_for_time(int) {
    end_with(time_message);
}

/// Limits private writable memory: unlike the address space, the reserves of threads and libraries do not count.
void limit_memory(int megabytes) {
    memory_message = error_text("sinew", fmt::format("more than {} MB of memory are needed", megabytes),
                                "--max-memory MB allows more");
    std::set_new_handler(end_for_memory);
    const auto bytes = rlim_t(megabytes) * 1'000'000;
    const rlimit limit{.rlim_cur = bytes, .rlim_max = bytes};
    if (setrlimit(RLIMIT_DATA, &limit) != 0) refuse("sinew", fmt::format("--max-memory: {}", std::strerror(errno)));
}

void limit_time(double seconds) {
    time_message = error_text("sinew", fmt::format("not done after {} s", seconds), "--max-seconds S allows more");
    struct sigaction ours {};
    ours.sa_handler = end_for_time;
    sigemptyset(&ours.sa_mask);
    sigaction(SIGALRM, &ours, nullptr);
    itimerval timer{};
    timer.it_value.tv_sec = time_t(std::floor(seconds));
    timer.it_value.tv_usec = suseconds_t((seconds - std::floor(seconds)) * 1e6);
    if (setitimer(ITIMER_REAL, &timer, nullptr) != 0)
        refuse("sinew", fmt::format("--max-seconds: {}", std::strerror(errno)));
}

} // namespace

void declare_limits(CLI::App& parser, ProcessLimits& target) {
    declare_whole(parser, "--max-memory", target.megabytes, {64, 1e9}, "MB", "gives up beyond so much memory");
    declare_number(parser, "--max-seconds", target.seconds, {0.01, 1e8}, "S", "gives up after so long on the clock");
}

void set_limits(const ProcessLimits& limits) {
    if (limits.megabytes) limit_memory(*limits.megabytes);
    if (limits.seconds) limit_time(*limits.seconds);
}

} // namespace sinew::cli
