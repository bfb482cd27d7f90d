#pragma once

#include "sinew/math/record.h"
#include "sinew/math/scalar.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// How things look: the section "looks" of a scene file. Nothing here moves anything.
namespace sinew {

/// What is painted in place of a shape: at a particle upright; between two particles along the way from one to the
/// other; at the end of a limb as it ends; along limbs and ropes bent like them; on four corners from corner to corner.
struct ImageLook {
    std::string file;
    std::optional<std::array<double, 2>> size;
    double turn = 0;
    std::array<double, 2> shift{};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.file, Field{.name = "file", .help = "A PNG in the folder of the scene or below", .required = true});
        visit(self.size, Field{.name = "size",
                               .help = "Along and across what it is on; negative mirrors. Left out: as large as that; "
                                       "on ropes it is repeated, the first long",
                               .unit = unit::length,
                               .low = -1e6,
                               .high = 1e6});
        visit(self.turn, Field{.name = "turn",
                               .help = "About its middle, counter-clockwise as seen",
                               .unit = unit::angle,
                               .low = -100 * pi<double>,
                               .high = 100 * pi<double>});
        visit(self.shift, Field{.name = "shift",
                                .help = "Of its middle, along and across",
                                .unit = unit::length,
                                .low = -1e6,
                                .high = 1e6});
    }
};

/// Colours of the theme that a look can name: what stands out from the background, and the background itself.
inline constexpr std::array<std::string_view, 2> theme_colors = {"ink", "paper"};

/// Faces that a look can put on a round part.
inline constexpr std::array<std::string_view, 4> expressions = {"none", "awake", "asleep", "dizzy"};

/// Of one part of one figure ("bob/head"), of a whole figure ("bob") or of that part in all figures ("head").
struct Look {
    std::string color;
    std::string fill;
    std::string hover;
    std::optional<double> width;
    std::vector<double> profile;
    std::optional<bool> hidden;
    std::string face;
    std::optional<ImageLook> image;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.color,
              Field{.name = "color",
                    .help = "Of lines and dots: a name, #rgb, #rrggbb, #rrggbbaa; ink and paper are the theme's"});
        visit(self.fill, Field{.name = "fill", .help = "Of areas; none leaves them empty"});
        visit(self.hover, Field{.name = "hover", .help = "Laid over what the pointer is at or holds; mind its alpha"});
        visit(self.width, Field{.name = "width",
                                .help = "Thickness of lines, diameter of dots",
                                .unit = unit::length,
                                .low = 0,
                                .high = 1e6});
        visit(self.profile, Field{.name = "profile",
                                  .help = "Of limbs: how thick at even distances, as multiples of the width",
                                  .low = 0,
                                  .high = 100});
        visit(self.hidden, Field{.name = "hidden", .help = "Not drawn; false shows what is hidden by default"});
        visit(self.face,
              Field{.name = "face",
                    .help = "On dots and tips, or instead of the face that a part is: eyes and a mouth; left "
                            "out: as it is",
                    .choices = expressions});
        visit(self.image, Field{.name = "image", .help = "Painted in its place"});
    }
};

} // namespace sinew
