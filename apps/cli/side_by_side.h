#pragma once

#include <cstddef>
#include <functional>

namespace sinew::cli {

/// Does `work(0)` to `work(count - 1)`, several at once, each on one thread; tells `finished` how many are done, one at
/// a time. After the first that throws no more are begun; of what was thrown the lowest number's is thrown on.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t)>& finished);

} // namespace sinew::cli
