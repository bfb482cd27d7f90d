#pragma once

#include "sinew/prefab/builder.h"
#include "sinew/prefab/material.h"

namespace sinew {

/// A tire, positioned by its hub. Particles corner_0, ... counter-clockwise around center; constraints tread_0, ...
/// along the rim, brace_0, ... from a corner to one further on, spoke_0, ... from the centre. (After the tire of
/// verlet-js.) In 3D two such rims, `width` apart along z, on an axle from center (in front) to back_center; behind are
/// back_0, ..., and cross_0, ... join the rims. A spoke runs from each end of the axle to each corner.
struct Tire {
    static constexpr std::string_view name = "tire";
    static constexpr std::string_view about = "A soft tire: a tread with braces, and spokes to a hub.";
    static constexpr Dimensions dimensions{2, 3};

    int segments = 30;
    double radius = 0.5;
    double width = 0.25;
    int brace_span = 5;
    Elasticity spoke_elasticity{1e-3 /* m/N */};
    Elasticity tread_elasticity{2e-4 /* m/N */};
    double spoke_relaxation = 1;
    double tread_relaxation = 1;
    double mass = 10;
    double thickness = 0.1;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.segments,
              Field{.name = "segments", .help = "Number of corners, each with a spoke", .low = 3, .high = 1e9});
        visit(self.radius, Field{.name = "radius",
                                 .help = "Distance from the hub (the figure's position) to the tread",
                                 .unit = unit::length,
                                 .low = 1e-6,
                                 .high = 1e6});
        visit(self.width,
              Field{.name = "width", .help = "Width, in 3D", .unit = unit::length, .low = 1e-6, .high = 1e6});
        visit(self.brace_span,
              Field{.name = "brace_span",
                    .help = "Number of sides spanned by a brace; no braces where the ends coincide or are neighbours",
                    .low = 2,
                    .high = 1e9});
        Elasticity::fields(self.spoke_elasticity, visit, "Compliance of the spokes; 0 is rigid", 0, "spoke_compliance");
        Elasticity::fields(self.tread_elasticity, visit, "Compliance of tread and braces; 0 is rigid", 0,
                           "tread_compliance");
        visit(self.spoke_relaxation, Field{.name = "spoke_relaxation",
                                           .help = "Share of the spokes' error removed in a pass (classic mode)",
                                           .low = 0,
                                           .high = 1});
        visit(self.tread_relaxation,
              Field{.name = "tread_relaxation",
                    .help = "Share of the error of tread and braces removed in a pass (classic mode)",
                    .low = 0,
                    .high = 1});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of the tread; collision radius of the corners is half",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
    }

    Sizes sizes() const {
        return {.particles = 2 * (std::size_t(segments) + 1), .constraints = 11 * std::size_t(segments) + 1};
    }
    template <int D, class Real> void build(Builder<D, Real>& figure) const;

  private:
    template <class Real> void build_flat(Builder<2, Real>& figure) const;
    template <class Real> void build_wheel(Builder<3, Real>& figure) const;
};

} // namespace sinew
