#pragma once

#include "sinew/world/world.h"

#include <optional>
#include <string>

/// First difference of two worlds.
namespace sinew {

/// The first field, in the order of the list of a world's fields, of which the two have other numbers.
struct WorldDifference {
    std::string field{};       ///< "particles.position"
    std::size_t row = 0;       ///< first row that differs
    std::size_t component = 0; ///< of the row: 0 is x
    double first = 0, second = 0;
    std::size_t rows = 0; ///< number of rows that differ
    double most = 0;      ///< largest difference of a number of the field
};

/// Nothing where all of the state is equal, to the last bit.
template <int D, class Real>
std::optional<WorldDifference> difference(const World<D, Real>& first, const World<D, Real>& second);

} // namespace sinew
