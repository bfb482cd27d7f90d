#pragma once

#include "sinew/math/record.h"

#include <optional>
#include <string>

/// How things look: the section "looks" of a scene file. Nothing here moves anything.
namespace sinew {

/// Of one part of one figure ("bob/head"), of a whole figure ("bob") or of that part in all figures ("head").
struct Look {
    std::string color;
    std::string fill;
    std::optional<double> width;
    std::optional<bool> hidden;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.color, Field{.name = "color", .help = "Of lines and dots: a name, #rgb, #rrggbb or #rrggbbaa"});
        visit(self.fill, Field{.name = "fill", .help = "Of areas; none leaves them empty"});
        visit(self.width, Field{.name = "width",
                                .help = "Thickness of lines, diameter of dots",
                                .unit = unit::length,
                                .low = 0,
                                .high = 1e6});
        visit(self.hidden, Field{.name = "hidden", .help = "Not drawn; false shows what is hidden by default"});
    }
};

} // namespace sinew
