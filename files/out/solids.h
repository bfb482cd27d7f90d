#pragma once

#include "files/out/gltf_document.h"

/// Meshes of lines and balls. Radii and lengths in metres.
namespace sinew::files {

/// A rod along +y from the origin with round ends, `begin` and `end` its radii there.
TriangleMesh rod(double length, double begin, double end);
/// Lays an image on a rod as seen from +z: so many times from end to end, its top on the left of the way, at -x.
void lay_image(TriangleMesh& rod, double length, double radius, double times);
/// A long ring along +y around the origin and (0, length, 0), in the plane of x and y. `width`: outer width.
TriangleMesh long_ring(double length, double width);
TriangleMesh sphere(double radius);
/// A disc in the plane of x and y, of some height.
TriangleMesh disc(double radius, double half_height);

} // namespace sinew::files
