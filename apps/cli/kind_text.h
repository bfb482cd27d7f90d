#pragma once

#include "sinew/constraint/kind_table.h"

#include <string>

namespace sinew::cli {

/// Definition of a constraint kind: drawing, order of particles, zero, sign, units, dimensions and an example.
std::string kind_text(const KindInfo& kind);
/// The same in Markdown, under a heading.
std::string kind_markdown(const KindInfo& kind);

} // namespace sinew::cli
