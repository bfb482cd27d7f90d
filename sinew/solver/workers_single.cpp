// Platforms whose standard library has no threads.
#include "sinew/solver/worker_pool.h"

#if defined(__wasm__) && !defined(__wasm_atomics__)

namespace sinew {

void detail::yield_thread() {}

int hardware_threads() {
    return 1;
}

void Workers::share_out(const SharedWork& work) {
    for (int part = 0; part < work.parts; ++part) work.call(work.context, part);
}

} // namespace sinew

#endif
