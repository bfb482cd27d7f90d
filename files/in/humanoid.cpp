#include "files/in/humanoid.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace sinew::files {
namespace {

struct BoneWord {
    std::string_view word;
    BodyPart part;
};

// The first that is in a name counts: "forearm" before "arm", "upleg" before "leg". Mixamo's Arm and Leg are the upper
// arm and the shin.
constexpr std::array bone_words = {BoneWord{"thumb", BodyPart::finger},       BoneWord{"index", BodyPart::finger},
                                   BoneWord{"middle", BodyPart::finger},      BoneWord{"ring", BodyPart::finger},
                                   BoneWord{"pinky", BodyPart::finger},       BoneWord{"little", BodyPart::finger},
                                   BoneWord{"finger", BodyPart::finger},      BoneWord{"palm", BodyPart::finger},
                                   BoneWord{"forearm", BodyPart::forearm},    BoneWord{"lowerarm", BodyPart::forearm},
                                   BoneWord{"upperarm", BodyPart::upper_arm}, BoneWord{"upleg", BodyPart::thigh},
                                   BoneWord{"upperleg", BodyPart::thigh},     BoneWord{"thigh", BodyPart::thigh},
                                   BoneWord{"lowerleg", BodyPart::shin},      BoneWord{"shin", BodyPart::shin},
                                   BoneWord{"calf", BodyPart::shin},          BoneWord{"clavicle", BodyPart::shoulder},
                                   BoneWord{"collar", BodyPart::shoulder},    BoneWord{"shoulder", BodyPart::shoulder},
                                   BoneWord{"toe", BodyPart::toes},           BoneWord{"ball", BodyPart::toes},
                                   BoneWord{"foot", BodyPart::foot},          BoneWord{"ankle", BodyPart::foot},
                                   BoneWord{"hand", BodyPart::hand},          BoneWord{"wrist", BodyPart::hand},
                                   BoneWord{"arm", BodyPart::upper_arm},      BoneWord{"leg", BodyPart::shin},
                                   BoneWord{"head", BodyPart::head},          BoneWord{"neck", BodyPart::neck},
                                   BoneWord{"spine", BodyPart::spine},        BoneWord{"chest", BodyPart::spine},
                                   BoneWord{"torso", BodyPart::spine},        BoneWord{"hips", BodyPart::hips},
                                   BoneWord{"pelvis", BodyPart::hips},        BoneWord{"hip", BodyPart::hips}};

// Ranges of motion of a limp adult, from tables for goniometry, rounded: a knee bends by 140 degrees, an elbow by 145;
// the trunk's are divided between its joints.
constexpr std::array joint_limits = {
    JointLimit{BodyPart::shin, 140, true},       JointLimit{BodyPart::forearm, 145, true},
    JointLimit{BodyPart::spine, 25, false},      JointLimit{BodyPart::neck, 30, false},
    JointLimit{BodyPart::head, 30, false},       JointLimit{BodyPart::shoulder, 20, false},
    JointLimit{BodyPart::upper_arm, 100, false}, JointLimit{BodyPart::hand, 60, false},
    JointLimit{BodyPart::thigh, 80, false},      JointLimit{BodyPart::foot, 30, false},
    JointLimit{BodyPart::toes, 30, false},       JointLimit{BodyPart::hips, 25, false}};

} // namespace

BodyPart body_part(std::string_view bone_name) {
    // "Armature" and "mixamorig:" are no part of a body.
    if (const auto colon = bone_name.rfind(':'); colon != bone_name.npos) bone_name.remove_prefix(colon + 1);
    std::string letters;
    for (const char c : bone_name)
        if (std::isalpha(static_cast<unsigned char>(c)) != 0)
            letters += char(std::tolower(static_cast<unsigned char>(c)));
    if (letters.starts_with("armature")) return BodyPart::other;
    for (const auto& [word, part] : bone_words)
        if (letters.find(word) != letters.npos) return part;
    return BodyPart::other;
}

JointLimit joint_limit(BodyPart part) {
    constexpr double usual_range = 45; // degrees
    const auto found = std::ranges::find(joint_limits, part, &JointLimit::part);
    return found == joint_limits.end() ? JointLimit{part, usual_range, false} : *found;
}

} // namespace sinew::files
