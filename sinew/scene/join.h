#pragma once

#include "sinew/scene/figure_section.h"

namespace sinew {

/// A constraint as a scene tells of it, between particles whose names begin with `prefix`; where one of them ends in a
/// star, one for each particle called so. It belongs to the figure, which draws it. A reference to nothing is left out,
/// for others to report.
template <int D, class Real>
void join(World<D, Real>& world, const ConstraintSection& section, FigureIndex figure = no_figure,
          const std::string& prefix = {});

} // namespace sinew
