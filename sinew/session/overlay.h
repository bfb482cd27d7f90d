#pragma once

#include "sinew/session/picture.h"
#include "sinew/session/theme.h"
#include "sinew/session/view.h"

#include <bitset>
#include <string_view>

/// What can be laid over a picture to see into the world.
namespace sinew {

struct Overlay {
    std::string_view name, about;
};

/// All of them, in the order in which they are drawn. A new one is a line here and a function in overlay.cpp.
inline constexpr std::array<Overlay, 6> overlays = {{
    {"strain", "distances by how far they are stretched (red) or squeezed (blue)"},
    {"tension", "distances by what they pull (red) or push (blue) with, in newtons"},
    {"pins", "what is held, and where to"},
    {"names", "figures, and particles that have a name of their own"},
    {"forces", "force fields on particles (blue) and the pull of pins (red), in newtons"},
    {"contacts", "particles on a wall, and the force with which it carries them, in newtons"},
}};

/// By number in `overlays`.
using OverlaySet = std::bitset<overlays.size()>;

/// Adds the overlays to a picture of the world.
void draw_overlays(OverlaySet which, const Scene& scene, const AnyWorld& world, const View& view, Picture& picture);

} // namespace sinew
