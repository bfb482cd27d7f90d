#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sinew {

/// Removes and returns the next line of an OBJ file. A backslash at its end, unless in a comment, joins it with the
/// line below; `joined` holds such a line. `lines`: number of lines that it takes.
std::string_view take_obj_line(std::string_view& text, std::string& joined, std::size_t& lines);

} // namespace sinew
