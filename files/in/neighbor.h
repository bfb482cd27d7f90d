#pragma once

#include "files/in/import.h"

namespace sinew::files {

/// Bytes of a file beside the imported one or below its folder. Throws ImportError at `place` for names that lead
/// elsewhere, and where the file cannot be read.
std::string bytes_beside(const ImportFile& file, const std::string& name, const std::string& place);

} // namespace sinew::files
