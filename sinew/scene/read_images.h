#pragma once

#include "sinew/scene/scene.h"

namespace sinew {

/// Reads the images that the looks of a scene name. What is wrong with a file is said at the place of its name.
Images read_images(const Opened& opened, const ImageReader& reader, Document& document);

} // namespace sinew
