#include "canvas/interrupt.h"

#include <array>
#include <atomic>
#include <csignal>
#include <unistd.h>

namespace sinew::canvas {
namespace {

/// Fixed array of atomics: lock-free, because a signal handler reads the slots.
template <class T> struct Slots {
    std::array<std::atomic<T>, 32> slots{};
    static_assert(std::atomic<T>::is_always_lock_free);

    void replace(T from, T to) {
        for (std::atomic<T>& slot : slots)
            if (T expected = from; slot.compare_exchange_strong(expected, to)) return;
    }
};

// Global because signals belong to the process.
std::atomic<int> received = 0;
Slots<const char*> doomed_files;
Slots<pid_t> doomed_children;

void take_down_with_us() {
    for (const auto& slot : doomed_children.slots)
        if (const pid_t child = slot; child != 0) kill(-child, SIGKILL);
    for (const auto& slot : doomed_files.slots)
        if (const char* const path = slot; path != nullptr) unlink(path);
}

/// Signal handler: calls only async-signal-safe functions (POSIX).
void note(int signal_number) {
    if (received.exchange(signal_number) == 0) return;
    end_at_once(128 + signal_number);
}

void catch_signal(int signal_number) {
    struct sigaction before {};
    sigaction(signal_number, nullptr, &before);
    if (before.sa_handler == SIG_IGN) return;
    struct sigaction ours {};
    ours.sa_handler = note;
    sigemptyset(&ours.sa_mask);
    // No SA_RESTART: a blocked write to ffmpeg must return and poll the flag.
    sigaction(signal_number, &ours, nullptr);
}

} // namespace

void catch_interrupts() {
    for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) catch_signal(signal_number);
    for (const int signal_number : {SIGPIPE, SIGXFSZ}) std::signal(signal_number, SIG_IGN);
}

void end_at_once(int exit_code) {
    take_down_with_us();
    _exit(exit_code);
}

int interrupted() {
    return received;
}

int interrupt_exit_code() {
    return 128 + received;
}

void doom(const char* path) {
    doomed_files.replace(nullptr, path);
}

void spare(const char* path) {
    doomed_files.replace(path, nullptr);
}

void doom(pid_t child) {
    doomed_children.replace(0, child);
}

void spare(pid_t child) {
    doomed_children.replace(child, 0);
}

} // namespace sinew::canvas
