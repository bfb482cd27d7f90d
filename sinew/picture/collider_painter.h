#pragma once

#include "sinew/picture/picture.h"
#include "sinew/picture/theme.h"
#include "sinew/scene/scene.h"
#include "sinew/session/view.h"

/// Drawing of colliders, behind all figures, in the theme's colours or those of the look with the collider's name.
/// Sensors are not drawn.
namespace sinew {

template <int D, class Real>
void draw_colliders(const Scene& scene, const World<D, Real>& world, const View& view, const Theme& theme,
                    float thickness, Picture& picture);

} // namespace sinew
