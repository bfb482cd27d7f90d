#pragma once

#include "sinew/math/record.h"

#include <array>
#include <optional>
#include <string>

/// Bounce and friction of a pair: the section "pairs" of a scene file.
namespace sinew {

/// Maximum number of pairs in a scene; each contact looks through all of them.
inline constexpr std::size_t max_pairs = 64;

/// Contact of two figures, or of a figure and a collider, where it differs from the rule for their own numbers.
struct PairSection {
    std::array<std::string, 2> between;
    std::optional<double> bounce, friction;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.between,
              Field{.name = "between",
                    .help = "Two figures, or a figure and a collider, or a figure and \"bounds\", the walls of the "
                            "world; one figure twice for its own parts",
                    .required = true});
        visit(self.bounce,
              Field{.name = "bounce",
                    .help = "Coefficient of restitution of the pair; that of its sides, the larger one, if left out",
                    .low = 0,
                    .high = 1});
        visit(self.friction, Field{.name = "friction",
                                   .help = "Coefficient of Coulomb friction of the pair; that of its sides if left out",
                                   .low = 0,
                                   .high = 100});
    }
};

} // namespace sinew
