#pragma once

#include <string_view>
#include <vector>

namespace sinew {

/// All words of the format for what other engines call `word`; empty if there are none.
std::vector<std::string_view> own_names(std::string_view word);

} // namespace sinew
