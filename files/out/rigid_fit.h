#pragma once

#include "files/out/mesh_film.h"

#include <optional>
#include <span>
#include <vector>

namespace sinew::files {

/// Motion of vertices that keep their distances: positions at frame i are center[i] + rotation[i] (first - center[0]).
struct RigidMotion {
    std::vector<Vec3<double>> center;
    std::vector<Vec<4, double>> rotation; ///< unit quaternions, continuous in sign
    double error = 0;                     ///< metres: largest distance of a vertex from its place
};

/// The motion of these vertices as a rigid body; nothing if they lie on one line, or leave their places by more than
/// `tolerance` of their extent.
std::optional<RigidMotion> rigid_motion(const MeshFilm& film, std::span<const std::uint32_t> vertices,
                                        double tolerance);

/// Quaternion of the shortest rotation from one unit vector to another; about z if they are opposite.
Vec<4, double> shortest_turn(const Vec3<double>& from, const Vec3<double>& to);
/// The rotation a after b.
Vec<4, double> product(const Vec<4, double>& a, const Vec<4, double>& b);
/// The sign of a quaternion nearest to the one before.
Vec<4, double> nearest_sign(const Vec<4, double>& q, const Vec<4, double>& before);

} // namespace sinew::files
