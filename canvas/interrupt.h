#pragma once

#include <sys/types.h>

/// Ctrl-C must not leave half a film behind. A command that writes files calls catch_interrupts() first; every Writer
/// then polls interrupted() at each frame, gives up, removes the partial file, and returns a Failure. The command ends
/// with interrupt_exit_code(). A second signal ends the process at once, after the same removal.
namespace sinew::canvas {

/// Installs handlers: from now on SIGINT, SIGTERM and SIGHUP are noted instead of ending the process (signals ignored
/// so far, as under nohup, stay ignored). SIGPIPE and SIGXFSZ are ignored: a write into a closed pipe or past a quota
/// returns an error instead.
void catch_interrupts();

/// The signal that asked the process to end; 0 if none did.
int interrupted();

/// Exit code of a process ended by a signal: 128 + the signal's number (130 after Ctrl-C).
int interrupt_exit_code();

/// Ends the process at once with this exit code, after removing the files and children registered below. Safe in a
/// signal handler.
[[noreturn]] void end_at_once(int exit_code);

/// Registers files to unlink and child processes to kill when the process ends at once. The path's characters must
/// outlive the registration. At most 32 of each are remembered.
void doom(const char* path);
void spare(const char* path);
void doom(pid_t child);
void spare(pid_t child);

} // namespace sinew::canvas
