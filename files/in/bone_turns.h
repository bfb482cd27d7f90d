#pragma once

#include "sinew/math/vec.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sinew::files {

/// A joint of a skeleton, or the end of its last bone, at rest. Parents come before their children.
struct BonePoint {
    std::optional<std::size_t> parent;
    Vec3<double> at{};
};

/// Rotations of a skeleton's joints from rest, given where they are. A joint with one bone turns with it and twists as
/// its parent does; one with several turns with its longest, and about that with the bone furthest from its line.
class BoneTurns {
  public:
    explicit BoneTurns(std::vector<BonePoint> points);

    /// Unit quaternions of all points, continuous from one call to the next.
    const std::vector<Vec<4, double>>& follow(std::span<const Vec3<double>> now);
    /// Sum of the lengths of bones.
    double length(std::span<const Vec3<double>> points) const;

    const std::vector<BonePoint>& points() const { return points_; }

  private:
    std::vector<BonePoint> points_;
    std::vector<std::vector<std::size_t>> children_; ///< the longest bone first
    std::vector<Vec<4, double>> turns_;

    Vec<4, double> turn(std::size_t i, std::span<const Vec3<double>> now, const Vec<4, double>& before) const;
};

/// A vector turned by a unit quaternion.
Vec3<double> turned(const Vec<4, double>& turn, const Vec3<double>& v);

} // namespace sinew::files
