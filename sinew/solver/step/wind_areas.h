#pragma once

#include "sinew/world/world.h"

#include <array>
#include <vector>

namespace sinew {

/// Part of a figure that the wind presses on.
struct WindArea {
    enum class Shape : std::uint8_t {
        patch,    ///< three or four particles around an area
        line,     ///< two particles
        ball,     ///< one
        fragment, ///< cut cloth: the particles of a piece carry what is left of a cell
    };
    Shape shape = Shape::ball;
    std::uint32_t first = 0, count = 0; ///< in WindAreas::rows
    double width = 0;                   ///< of a line or a ball
    FigureIndex figure = 0;             ///< of a fragment
    std::uint32_t fragment = 0;         ///< index in the figure's fragments
};

/// Parts that the wind presses on: of each figure its areas, those of a net of threads too; of a figure without areas
/// its lines; of one without either, its particles as balls.
struct WindAreas {
    std::vector<WindArea> list;
    std::vector<Row> rows;                 ///< particles of the parts, in the order of each piece
    std::vector<std::array<Row, 2>> links; ///< scratch: ends of distances, the lower row first, in order
    std::uint64_t edits = ~0ull;           ///< of the world when the areas were found
};

} // namespace sinew
