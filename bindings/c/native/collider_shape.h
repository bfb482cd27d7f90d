#pragma once

#include "sinew/collide/shape.h"

#include "bindings/c/sinew.h"

#include <string>

namespace sinew::c {

/// Sets the shape that a struct of the caller describes. Returns the reason, with the place, where the numbers make
/// none; then nothing is set.
template <int D, class Real> std::string set_shape(const sinew_collider_spec& spec, collide::Shape<D, Real>& shape);

} // namespace sinew::c
