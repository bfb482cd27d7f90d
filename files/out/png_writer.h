#pragma once

#include "sinew/scene/image.h"

#include <string>

namespace sinew::files {

/// An image as a PNG: a writer of its own, since the C face and the modules for pages have no painter.
std::string png_of(const Image& image);

} // namespace sinew::files
