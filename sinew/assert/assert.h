#pragma once

/// Assertions: invariants that the engine relies on and no input can break. A broken one is a bug of Sinew, or of a
/// program that changed a world's columns by hand. Debug and sanitizer builds check assertions (SINEW_ASSERTIONS is 1);
/// elsewhere the condition is compiled but never evaluated.
namespace sinew {

/// Receives the place and the text of a broken assertion.
using AssertionHandler = void (*)(const char* file, int line, const char* text);

/// Replaces the handler and returns the one before; null: the default, which prints `file:line: text` to the standard
/// error output and aborts. Where a handler returns, the program goes on behind the assertion. The handler must be safe
/// to call from several threads.
AssertionHandler set_assertion_handler(AssertionHandler handler);

/// Calls the handler.
void assertion_failed(const char* file, int line, const char* text);

} // namespace sinew

#if !defined(SINEW_ASSERTIONS)
#define SINEW_ASSERTIONS 0
#endif

#if SINEW_ASSERTIONS
/// The text names the assumption.
#define SINEW_ASSERT(condition, text)                                                                                  \
    ((condition) ? static_cast<void>(0) : ::sinew::assertion_failed(__FILE__, __LINE__, text))
#else
#define SINEW_ASSERT(condition, text) static_cast<void>(sizeof((condition) ? 1 : 0))
#endif
