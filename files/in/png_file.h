#pragma once

#include "sinew/scene/image.h"

#include "files/in/notes.h"

#include <string_view>

namespace sinew::files {

/// Reads a PNG (ISO/IEC 15948), any colour type, depth and interlacing, as 8 bits a channel with premultiplied opacity.
/// Throws ImportError with the byte of the chunk, or the row, at which the file is broken. `notes` gains all that is
/// not taken.
Image read_png_file(std::string_view bytes, Notes& notes);

} // namespace sinew::files
