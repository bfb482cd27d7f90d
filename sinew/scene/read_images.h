#pragma once

#include "sinew/scene/scene.h"

namespace sinew {

/// Reads the images of a scene's looks. Errors in a file are reported at the look that names the file.
Images read_images(const Opened& opened, const ImageReader& reader, Document& document);

} // namespace sinew
