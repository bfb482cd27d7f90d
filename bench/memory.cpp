#include "bench/memory.h"

#include <cstdio>
#include <cstring>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace sinew::bench {
namespace {

/// A field of /proc/self/status in bytes; 0 if missing.
std::size_t status(const char* key) {
    std::size_t bytes = 0;
    if (std::FILE* file = std::fopen("/proc/self/status", "r")) {
        char line[256];
        while (std::fgets(line, sizeof line, file))
            if (std::strncmp(line, key, std::strlen(key)) == 0) {
                unsigned long long kilobytes = 0;
                if (std::sscanf(line + std::strlen(key), " %llu", &kilobytes) == 1)
                    bytes = std::size_t(kilobytes) * 1024;
            }
        std::fclose(file);
    }
    return bytes;
}

/// Resets the process's peak memory; false on failure.
bool forget_peak() {
    std::FILE* file = std::fopen("/proc/self/clear_refs", "w");
    if (!file) return false;
    const bool written = std::fputs("5", file) >= 0;
    return (std::fclose(file) == 0) && written;
}

} // namespace

PeakMemory::PeakMemory() {
#ifdef __GLIBC__
    malloc_trim(0); // return free memory, or the next world would fill it unnoticed
#endif
    if (forget_peak()) begun_ = status("VmRSS:");
}

std::size_t PeakMemory::risen() const {
    const auto peak = status("VmHWM:");
    return begun_ > 0 && peak > begun_ ? peak - begun_ : 0;
}

} // namespace sinew::bench
