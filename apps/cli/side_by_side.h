#pragma once

#include <cstddef>
#include <functional>

namespace sinew::cli {

/// Calls `work(0)` to `work(count - 1)` on several threads; calls `finished` with the number done, under a lock. After
/// an exception no more calls begin, and the exception with the lowest index is rethrown.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t)>& finished);

} // namespace sinew::cli
