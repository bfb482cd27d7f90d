#pragma once

#include "sinew/prefab/obj.h"
#include "sinew/scene/driver_section.h"
#include "sinew/scene/fill_rule.h"
#include "sinew/scene/world_section.h"

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// Shapes that everything in the scene touches: the section "colliders" of a scene file.
namespace sinew {

struct HalfSpaceShape {
    static constexpr std::string_view name = "half_space";
    static constexpr std::string_view about = "Everything behind a plane without end.";
    Point normal{{0, 1, 0}};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.normal, Field{.name = "normal", .help = "Normal of the plane, towards the free side"});
    }
};

struct SphereShape {
    static constexpr std::string_view name = "sphere";
    static constexpr std::string_view about = "A sphere; a circle in the plane.";
    double radius = 0.5;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.radius, Field{.name = "radius", .help = "Radius", .unit = unit::length, .low = 1e-6, .high = 1e6});
    }
};

struct CapsuleShape {
    static constexpr std::string_view name = "capsule";
    static constexpr std::string_view about = "A segment with a radius: a rod with round ends.";
    Point from{}, to{{1, 0, 0}};
    double radius = 0.1;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.from, Field{.name = "from", .help = "Beginning of the axis, from \"at\"", .unit = unit::length});
        visit(self.to, Field{.name = "to", .help = "End of the axis, from \"at\"", .unit = unit::length});
        visit(self.radius, Field{.name = "radius", .help = "Radius", .unit = unit::length, .low = 1e-6, .high = 1e6});
    }
};

struct BoxShape {
    static constexpr std::string_view name = "box";
    static constexpr std::string_view about = "A box, or a rectangle in the plane, about \"at\".";
    Point size{{1, 1, 1}};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.size,
              Field{.name = "size", .help = "Lengths of the edges", .unit = unit::length, .low = 1e-6, .high = 1e6});
    }
};

struct PolygonShape {
    static constexpr std::string_view name = "polygon";
    static constexpr std::string_view about =
        "A polygon without crossings (2D), by its corners or by a path of SVG; one with dents becomes several parts.";
    std::vector<Point> points;
    std::string path;
    std::string fill_rule{fill_rules[0]};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.points, Field{.name = "points", .help = "Corners in order, from \"at\"", .unit = unit::length});
        visit(self.path,
              Field{.name = "path",
                    .help =
                        "In place of points: path of SVG (M L H V C S Q T A Z, absolute or relative) in coordinates "
                        "of the scene from \"at\", y as \"units.up\" has it; a subpath may be a hole"});
        visit(self.fill_rule,
              Field{.name = "fill_rule",
                    .help = "Rule of SVG that tells what is solid of a path with several subpaths: nonzero: a subpath "
                            "inside another one is a hole if it goes round the other way; evenodd: every second one is",
                    .choices = fill_rules});
    }
};

struct ChainShape {
    static constexpr std::string_view name = "chain";
    static constexpr std::string_view about = "Terrain (2D): segments with one solid side.";
    std::vector<Point> points;
    std::string path;
    bool closed = false;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.points, Field{.name = "points",
                                 .help = "Points from \"at\"; the free side is above a chain from left to right",
                                 .unit = unit::length});
        visit(self.path, Field{.name = "path",
                               .help = "In place of points: path of SVG, as for a polygon; each subpath is a chain, "
                                       "closed if it ends with Z"});
        visit(self.closed, Field{.name = "closed", .help = "An edge from the last point to the first"});
    }
};

struct MeshShape {
    static constexpr std::string_view name = "mesh";
    static constexpr std::string_view about =
        "Triangles (3D), each solid behind, by their corners or from an OBJ file.";
    std::vector<Point> points;
    std::vector<std::array<int, 3>> triangles;
    std::string file;
    double unit_length = 1;
    std::shared_ptr<const MeshModel> model{}; ///< content of the file, read by whoever opens the scene

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.points, Field{.name = "points", .help = "Corners, from \"at\"", .unit = unit::length});
        visit(self.triangles, Field{.name = "triangles",
                                    .help = "Numbers of three corners each, counter-clockwise seen from the free side",
                                    .low = 0});
        visit(self.file, Field{.name = "file",
                               .help = "In place of points and triangles: OBJ file in the scene's folder, faces "
                                       "counter-clockwise seen from the free side"});
        visit(self.unit_length, Field{.name = "unit_length",
                                      .help = "Length of one unit of the file",
                                      .unit = unit::length,
                                      .low = 1e-6,
                                      .high = 1e6});
    }
};

struct HeightFieldShape {
    static constexpr std::string_view name = "height_field";
    static constexpr std::string_view about = "A landscape over a square grid (3D).";
    std::vector<std::vector<double>> heights;
    double spacing = 1;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.heights, Field{.name = "heights",
                                  .help = "Rows of heights: rows follow each other along z, numbers along x",
                                  .unit = unit::length,
                                  .required = true});
        visit(self.spacing,
              Field{.name = "spacing", .help = "Side of a cell", .unit = unit::length, .low = 1e-6, .high = 1e6});
    }
};

/// Motion of a collider; bodies that touch it are carried along.
struct MotionSection {
    double spin = 0;
    std::optional<Driver> driver;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.spin, Field{.name = "spin",
                               .help = "Angular velocity, counter-clockwise on screen; in 3D about \"axis\"",
                               .unit = unit::spin,
                               .low = -200 * pi<double>,
                               .high = 200 * pi<double>});
        visit(self.driver, Field{.name = "driver", .help = "Motion of the position; none if left out"});
    }
};

struct ColliderSection {
    std::string name;
    std::variant<HalfSpaceShape, SphereShape, CapsuleShape, BoxShape, PolygonShape, ChainShape, MeshShape,
                 HeightFieldShape>
        shape;
    Point at{};
    double turn = 0;
    Point axis{{0, 0, 1}};
    double bounce = 0;
    double friction = 0.5;
    std::vector<int> layers{0};
    std::optional<std::vector<int>> touches;
    std::optional<Point> one_way;
    bool sensor = false;
    Point surface_velocity{};
    std::optional<MotionSection> motion;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.name, Field{.name = "name", .help = "Name, for events"});
        visit(self.shape, Field{.name = "shape", .help = "Shape", .required = true});
        visit(self.at, Field{.name = "at", .help = "Position", .unit = unit::length});
        visit(self.turn, Field{.name = "turn",
                               .help = "Rotation about the position, counter-clockwise on screen; in 3D about \"axis\"",
                               .unit = unit::angle});
        visit(self.axis, Field{.name = "axis", .help = "Axis of the turn and of the spin (3D)"});
        surface_fields(self, visit);
        visit(self.layers, Field{.name = "layers", .help = "Layers it belongs to", .low = 0, .high = 31});
        visit(self.touches,
              Field{.name = "touches", .help = "Layers it touches; all if left out", .low = 0, .high = 31});
        visit(self.one_way,
              Field{.name = "one_way", .help = "Direction of the only solid side: [0, 1] holds what falls on it"});
        visit(self.sensor, Field{.name = "sensor", .help = "Reports touches, and lets everything through"});
        visit(self.surface_velocity,
              Field{.name = "surface_velocity",
                    .help = "Velocity at which the surface runs along itself and carries what lies on it, before the "
                            "turn: a belt, an escalator",
                    .unit = unit::speed});
        visit(self.motion, Field{.name = "motion", .help = "Motion in time"});
    }
};

} // namespace sinew
