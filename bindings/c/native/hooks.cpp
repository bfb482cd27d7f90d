#include "sinew/assert/assert.h"
#include "sinew/solver/program_threads.h"

#include "bindings/c/simulation.h"

#include <algorithm>

/// Functions of the caller in place of the library's own.
using namespace sinew;
using namespace sinew::c;

extern "C" {

void sinew_set_log(sinew_log log, void* context) {
    failure_log() = {log, context};
}

void sinew_set_assertion_handler(sinew_assertion_handler handler) {
    set_assertion_handler(handler);
}

void sinew_set_parallel(sinew_parallel parallel, void* context) {
    set_program_threads({parallel, context});
}

sinew_status sinew_set_threads(sinew_simulation simulation, uint32_t threads) {
    constexpr std::uint32_t most = 1024;
    return change(simulation, [&](Session& session) {
        session.set_options({.threads = int(std::min(threads, most))});
        return SINEW_OK;
    });
}

} // extern "C"
