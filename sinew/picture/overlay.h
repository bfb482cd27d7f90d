#pragma once

#include "sinew/picture/picture.h"
#include "sinew/picture/theme.h"
#include "sinew/session/view.h"

#include <bitset>
#include <string_view>

/// Debug overlays: quantities of the world drawn over a picture.
namespace sinew {

struct Overlay {
    std::string_view name, about;
};

/// All overlays, in drawing order. A new overlay takes a line here and a function in overlay.cpp.
inline constexpr std::array<Overlay, 6> overlays = {{
    {"strain", "distances by how far they are stretched (red) or squeezed (blue)"},
    {"tension", "distances by what they pull (red) or push (blue) with, in newtons"},
    {"pins", "what is held, and where to"},
    {"names", "figures, and particles that have a name of their own"},
    {"forces", "force fields on particles (blue) and the pull of pins (red), in newtons"},
    {"contacts", "what lies on a wall, a collider or another figure, and the force there, in newtons"},
}};

/// Indexed as `overlays`.
using OverlaySet = std::bitset<overlays.size()>;

/// Adds the selected overlays to a picture of the world.
void draw_overlays(OverlaySet which, const Scene& scene, const AnyWorld& world, const View& view, Picture& picture);

} // namespace sinew
