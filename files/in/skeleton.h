#pragma once

#include "sinew/math/vec.h"

#include "files/in/notes.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sinew::files {

/// A joint of a skeleton: the beginning of a bone. Parents come before their children.
struct SkeletonJoint {
    std::string name, place;
    std::optional<std::size_t> parent;
    Vec3<double> at{}; ///< in the pose of the file, metres
};

/// A ragdoll of a skeleton: a particle for each joint; links for bones; the joints of one bone keep their distances.
/// Bends have the limits of a human's where bones are called so, else of 45 degrees about the pose. Masses are by
/// length. Fingers are left out. Notes tell what else is.
json::Object ragdoll_of(const std::vector<SkeletonJoint>& joints, const std::string& name, double scale, Notes& notes);

/// Names that the ragdoll's particles have for the joints: those of fingers and of joints at one place have the name of
/// the particle above, which may be none.
struct JointParticles {
    std::vector<std::string> names;
    std::vector<bool> is_own; ///< the joint has a particle to itself
};
JointParticles joint_particles(const std::vector<SkeletonJoint>& joints, double scale);

} // namespace sinew::files
