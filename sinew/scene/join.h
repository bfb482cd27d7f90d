#pragma once

#include "sinew/scene/figure_section.h"

namespace sinew {

/// Adds a constraint from its section; names of members without a figure get `prefix`. Where a name ends in a star,
/// adds one constraint for each matching particle. The constraint belongs to the figure, which draws the piece. A
/// constraint with an unknown member is not added; check_references reports the name.
template <int D, class Real>
void join(World<D, Real>& world, const ConstraintSection& section, FigureIndex figure = no_figure,
          const std::string& prefix = {});

} // namespace sinew
