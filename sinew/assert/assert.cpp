#include "sinew/assert/assert.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace sinew {
namespace {

void print_and_abort(const char* file, int line, const char* text) {
    std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, text);
    std::abort();
}

std::atomic<AssertionHandler> current_handler = print_and_abort;

} // namespace

AssertionHandler set_assertion_handler(AssertionHandler handler) {
    return current_handler.exchange(handler ? handler : print_and_abort);
}

void assertion_failed(const char* file, int line, const char* text) {
    current_handler.load()(file, line, text);
}

} // namespace sinew
