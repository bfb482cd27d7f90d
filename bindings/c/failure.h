#pragma once

#include "sinew/scene/diagnostic.h"

#include "bindings/c/sinew.h"

#include <string>

/// Failures of the C face: the message and the diagnostics of the thread's last one.
namespace sinew::c {

/// Receives the message of every failure; null: nobody.
struct Log {
    void (*tell)(void* context, sinew_status status, const char* message) = nullptr;
    void* context = nullptr;
};
Log& failure_log();

/// Keeps the message, tells the log and returns the status.
sinew_status fail(sinew_status status, std::string message);

sinew_status bad_handle();
sinew_status bad_id(const char* of); ///< "particle", "constraint", "pin"
sinew_status null_argument();
sinew_status not_finite();

/// Keeps the errors of a scene as the thread's diagnostics. Returns SINEW_BAD_SCENE, or SINEW_OK if there are none.
sinew_status keep_diagnostics(const Diagnostics& diagnostics);
void forget_diagnostics();

} // namespace sinew::c
