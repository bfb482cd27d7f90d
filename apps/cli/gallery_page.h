#pragma once

#include "apps/cli/scene_page.h"

#include <string>
#include <vector>

namespace sinew::cli {

/// A scene with film and still in each mode, in the order of `modes`.
struct Exhibit {
    ScenePage page;
    std::vector<std::string> films;  ///< bytes of WebP files
    std::vector<std::string> stills; ///< bytes of PNG files, for readers who prefer reduced motion
};

/// A self-contained HTML page: pictures, scripts and styles are embedded, nothing is loaded.
std::string gallery_html(const std::vector<Exhibit>& exhibits);

} // namespace sinew::cli
