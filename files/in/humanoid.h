#pragma once

#include <string>
#include <string_view>

namespace sinew::files {

/// Part of a human that the name of a bone means, as Blender's Rigify, Mixamo, VRM, Unreal and Unity call them.
enum class BodyPart {
    other,
    hips,
    spine,
    neck,
    head,
    shoulder,
    upper_arm,
    forearm,
    hand,
    thigh,
    shin,
    foot,
    toes,
    finger
};

BodyPart body_part(std::string_view bone_name);

/// Range of the bend at the beginning of a bone, degrees: from straight for hinges, else about the pose.
struct JointLimit {
    BodyPart part;
    double range;
    bool is_hinge;
};
JointLimit joint_limit(BodyPart part);

} // namespace sinew::files
