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
        visit(self.file, Field{.name = "file", .help = "PNG file in the scene's folder or below", .required = true});
        visit(self.size, Field{.name = "size",
                               .help = "Size along and across the shape; negative values mirror; the size of the shape "
                                       "if left out. Along ropes the image repeats with the first value as its length",
                               .unit = unit::length,
                               .low = -1e6,
                               .high = 1e6});
        visit(self.turn, Field{.name = "turn",
                               .help = "Rotation about the image's centre, counter-clockwise on screen",
                               .unit = unit::angle,
                               .low = -100 * pi<double>,
                               .high = 100 * pi<double>});
        visit(self.shift, Field{.name = "shift",
                                .help = "Displacement of the image's centre, along and across",
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
        visit(
            self.color,
            Field{.name = "color",
                  .help = "Colour of lines and dots: a name, #rgb, #rrggbb, #rrggbbaa; ink and paper are the theme's"});
        visit(self.fill, Field{.name = "fill", .help = "Colour of areas; none for no fill"});
        visit(self.hover,
              Field{.name = "hover",
                    .help = "Colour laid over shapes under or held by the pointer, normally with some transparency"});
        visit(self.width, Field{.name = "width",
                                .help = "Thickness of lines, diameter of dots",
                                .unit = unit::length,
                                .low = 0,
                                .high = 1e6});
        visit(self.profile, Field{.name = "profile",
                                  .help = "Thickness of the limb at even distances, as multiples of its width",
                                  .low = 0,
                                  .high = 100});
        visit(self.hidden, Field{.name = "hidden", .help = "Hidden; false shows parts that are hidden by default"});
        visit(
            self.face,
            Field{.name = "face",
                  .help = "Eyes and a mouth on dots and tips, or in place of a face part's own; unchanged if left out",
                  .choices = expressions});
        visit(self.image, Field{.name = "image", .help = "Image painted in place of the shape"});
    }
};

} // namespace sinew
