#include "bindings/python/core/pinned_memory.h"

#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <new>
#include <utility>

namespace sinew::python {
namespace {

struct Pinned {
    int arrays = 0;
    bool is_freed = false; ///< by the engine
};

struct Blocks {
    std::mutex mutex;
    std::map<const void*, Pinned> pinned;
};

Blocks& blocks() {
    static auto& all = *new Blocks; // never destroyed: arrays outlive the module's static objects
    return all;
}

/// Number of pinned blocks. A block is freed by the thread that has locked its simulation, as the one that pinned the
/// block had: the order of memory need not be stronger.
std::atomic<int> pinned_count = 0;

/// Notes that the engine frees a block; false if the block is not pinned.
bool keeps(const void* block) {
    if (!block || pinned_count.load(std::memory_order_relaxed) == 0) return false;
    const std::scoped_lock lock(blocks().mutex);
    const auto found = blocks().pinned.find(block);
    if (found == blocks().pinned.end()) return false;
    found->second.is_freed = true;
    return true;
}

} // namespace

void pin_memory(const void* block) {
    const std::scoped_lock lock(blocks().mutex);
    if (blocks().pinned[block].arrays++ == 0) ++pinned_count;
}

void unpin_memory(const void* block) {
    std::map<const void*, Pinned>::node_type last; // destroyed after the lock: its memory is freed through keeps()
    {
        const std::scoped_lock lock(blocks().mutex);
        const auto found = blocks().pinned.find(block);
        if (--found->second.arrays > 0) return;
        last = blocks().pinned.extract(found);
        --pinned_count;
    }
    if (last.mapped().is_freed) ::operator delete(const_cast<void*>(block));
}

} // namespace sinew::python

// The linker calls __wrap_X for X, and X for __real_X. X are operator delete(void*) and (void*, size_t).
extern "C" {

void __real__ZdlPv(void* block) noexcept;
void __real__ZdlPvm(void* block, std::size_t bytes) noexcept;

void __wrap__ZdlPv(void* block) noexcept {
    if (!sinew::python::keeps(block)) __real__ZdlPv(block);
}

void __wrap__ZdlPvm(void* block, std::size_t bytes) noexcept {
    if (!sinew::python::keeps(block)) __real__ZdlPvm(block, bytes);
}

} // extern "C"
