// Workers of a page: one calls sinew_serve, with a stack of its own, and never returns (web/sinew/worker.js).
#include "sinew/solver/workers_page.h"

#if defined(__wasm_atomics__)

extern "C" [[noreturn]] void sinew_serve(int number) {
    sinew::serve_page(number);
}

#endif
