#pragma once

/// Memory that NumPy arrays show. The module is linked with --wrap for operator delete: a pinned block that the engine
/// frees (a column that grew, a closed world) is freed when its last array is gone.
namespace sinew::python {

void pin_memory(const void* block);
/// Ends one pin_memory() of the block.
void unpin_memory(const void* block);

} // namespace sinew::python
