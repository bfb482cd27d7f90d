#pragma once

#include <sys/types.h>

/// Ctrl-C must not leave half a film behind. A command that writes files calls catch_interrupts() first; every Writer
/// then polls interrupted() at each frame, gives up, removes what it began, and returns a Failure. The command ends
/// with interrupt_exit_code(). A second signal, for the impatient, ends the process at once, after the same removal.
namespace sinew::canvas {

/// From now on SIGINT, SIGTERM and SIGHUP are noted instead of ending the process (where they were ignored, as under
/// nohup, they stay ignored). SIGPIPE and SIGXFSZ are ignored: a write into a closed pipe or past a quota returns an
/// error instead.
void catch_interrupts();

/// The signal that asked the process to end; 0 if none did.
int interrupted();

/// What shells expect of a process ended by a signal: 128 + its number (130 after Ctrl-C).
int interrupt_exit_code();

/// What a second signal takes down with the process: files are unlinked, child processes killed. The text of the path
/// must stay where it is until spared. At most 32 of each are remembered.
void doom(const char* path);
void spare(const char* path);
void doom(pid_t child);
void spare(pid_t child);

} // namespace sinew::canvas
