#pragma once

#include "sinew/picture/picture.h"

#include "files/out/exporter.h"

namespace sinew::files {

/// Draws the session as the request asks: its size and background, the view on a figure that is followed, the caption.
void draw_frame(const Session& session, const ExportRequest& request, Picture& picture);

} // namespace sinew::files
