#pragma once

#include "files/in/drawing.h"
#include "files/in/triangulate.h"

namespace sinew::files {

/// A figure by hand of the triangles of an area: particles p0, p1, ..., edges hidden, an outline that is filled.
struct Body {
    Role role = Role::solid;
    double radius = 1; ///< collision radius of the particles
    std::string fill, stroke;
    double stroke_width = 0;
    const Worn* worn = nullptr;
};

/// Areal density of drawn figures: a drawing of 100 px a side (1 m) has 10 kg. Kilograms per square pixel.
inline constexpr double drawn_density = 1e-3;

json::Object body_of(const AreaMesh& mesh, const Body& body);

} // namespace sinew::files
