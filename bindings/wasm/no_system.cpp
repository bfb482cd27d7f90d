// The system calls of wasi-libc on a page, which has no system: the module imports nothing.
//
// Each function stands for the import of the same name (WASI preview 1). No clock runs, no variable of the environment
// is set, and nothing can be written; an aborting program traps.
#include <cstdint>

namespace {

constexpr std::int32_t done = 0, not_here = 52; // ENOSYS of WASI

} // namespace

extern "C" {

std::int32_t __imported_wasi_snapshot_preview1_environ_sizes_get(std::int32_t count, std::int32_t bytes) {
    *reinterpret_cast<std::int32_t*>(count) = 0;
    *reinterpret_cast<std::int32_t*>(bytes) = 0;
    return done;
}

std::int32_t __imported_wasi_snapshot_preview1_environ_get(std::int32_t, std::int32_t) {
    return done;
}

std::int32_t __imported_wasi_snapshot_preview1_clock_time_get(std::int32_t, std::int64_t, std::int32_t time) {
    *reinterpret_cast<std::int64_t*>(time) = 0;
    return done;
}

std::int32_t __imported_wasi_snapshot_preview1_fd_close(std::int32_t) {
    return not_here;
}

std::int32_t __imported_wasi_snapshot_preview1_fd_seek(std::int32_t, std::int64_t, std::int32_t, std::int32_t) {
    return not_here;
}

std::int32_t __imported_wasi_snapshot_preview1_fd_write(std::int32_t, std::int32_t, std::int32_t, std::int32_t) {
    return not_here;
}

std::int32_t __imported_wasi_snapshot_preview1_fd_read(std::int32_t, std::int32_t, std::int32_t, std::int32_t) {
    return not_here;
}

std::int32_t __imported_wasi_snapshot_preview1_fd_fdstat_get(std::int32_t, std::int32_t) {
    return not_here;
}

[[noreturn]] void __imported_wasi_snapshot_preview1_proc_exit(std::int32_t) {
    __builtin_trap();
}

/// The one thread never ends: destructors of its variables never run.
int __cxa_thread_atexit(void (*)(void*), void*, void*) {
    return 0;
}

} // extern "C"
