#pragma once

#include "sinew/picture/overlay.h"
#include "sinew/picture/picture.h"
#include "sinew/session/session.h"
#include "sinew/session/view.h"

#include <span>
#include <string>

namespace sinew {

/// Fills `picture`, whose width and height in pixels the caller sets, with the display list of a session seen through
/// `view`: background, shadows, walls, traces and figures, overlays on top. With names in `figures`: these figures
/// alone, in a plane with their shadows.
void draw(const Session& session, const View& view, Picture& picture, OverlaySet overlay = {},
          std::span<const std::string> figures = {});

/// The same through the view that the scene asks for.
void draw(const Session& session, Picture& picture, OverlaySet overlay = {});

} // namespace sinew
