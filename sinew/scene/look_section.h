#pragma once

#include "sinew/math/record.h"
#include "sinew/math/scalar.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Looks: the section "looks" of a scene file. Looks have no effect on motion.
namespace sinew {

/// An image painted in place of a shape. Placement: upright at a particle; along the line between two particles; along
/// the end tangent of a limb for a tip; bent along limbs and ropes; from corner to corner on four corners.
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

/// Colours of the theme by name: the foreground and the background.
inline constexpr std::array<std::string_view, 2> theme_colors = {"ink", "paper"};

/// Faces a look can put on a round part.
inline constexpr std::array<std::string_view, 4> expressions = {"none", "awake", "asleep", "dizzy"};

/// Look of one part of one figure ("bob/head"), of a whole figure ("bob") or of a part in all figures ("head").
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
