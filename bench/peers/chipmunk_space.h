#pragma once

#include <chipmunk/chipmunk.h>
#include <cstdio>
#include <fcntl.h>
#include <unistd.h>

namespace sinew::bench {

/// Silences cpSpaceNew: Debian's Chipmunk prints a greeting on standard output, where results are printed.
inline cpSpace* make_space() {
    std::fflush(stdout);
    const int kept = dup(STDOUT_FILENO), nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    auto* space = cpSpaceNew();
    std::fflush(stdout);
    dup2(kept, STDOUT_FILENO);
    close(kept), close(nowhere);
    return space;
}

} // namespace sinew::bench
