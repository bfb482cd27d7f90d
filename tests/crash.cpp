#include "tests/sanitized.h"

#include <array>
#include <csignal>
#include <cstring>
#include <execinfo.h>
#include <gtest/gtest.h>
#include <string_view>
#include <unistd.h>

/// Tests share a process: one that crashes takes the others along, and says its name and where.
namespace {

void write_out(std::string_view text) {
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
}

void tell(int signal) {
    write_out("\ncrashed in ");
    if (const auto* test = testing::UnitTest::GetInstance()->current_test_info()) {
        write_out(test->test_suite_name());
        write_out(".");
        write_out(test->name());
    }
    write_out("\n");
    std::array<void*, 40> frames{};
    backtrace_symbols_fd(frames.data(), backtrace(frames.data(), int(frames.size())), STDERR_FILENO);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

class CrashReport : public testing::Environment {
    void SetUp() override {
        if (sinew::test::sanitized) return;       // which tells more
        static std::array<char, 64 * 1024> stack; // of its own: the other may be full
        const stack_t own{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
        sigaltstack(&own, nullptr);
        struct sigaction action {};
        action.sa_handler = tell;
        action.sa_flags = int(SA_ONSTACK | SA_RESETHAND);
        for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) sigaction(signal, &action, nullptr);
    }
};

[[maybe_unused]] const auto* const report = testing::AddGlobalTestEnvironment(new CrashReport);

} // namespace
