#pragma once

#include "sinew/scene/image.h"

#include <string>

namespace sinew::files {

/// An image as a PNG whose pixels are stored, not compressed: the C face and the modules for pages have no compressor.
std::string stored_png(const Image& image);

} // namespace sinew::files
