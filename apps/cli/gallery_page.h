#pragma once

#include "apps/cli/scene_page.h"

#include <string>
#include <vector>

namespace sinew::cli {

/// A scene and what it looks like in each mode, in the order of `modes`.
struct Exhibit {
    ScenePage page;
    std::vector<std::string> films;  ///< bytes of WebP files
    std::vector<std::string> stills; ///< of PNG files: for readers who do not want things to move
};

/// One HTML page that needs nothing but itself: pictures are in it, scripts and styles too, and nothing is loaded.
std::string gallery_html(const std::vector<Exhibit>& exhibits);

} // namespace sinew::cli
