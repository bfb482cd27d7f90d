#include "sinew/prefab/ragdoll.h"

#include "sinew/prefab/body.h"

namespace sinew {
namespace {

// Places: the Roblox ragdoll, pixels. Shares, which count in physical mode only: the segments of the body after de Leva
// 1996, each divided between the joints at its ends; the upper trunk's also to the neck, for a light joint between
// heavy ones is what a blow crushes first.
// clang-format off
constexpr Joint joints[] = {
    // name              x    y    share  radius
    {"left_shoulder",  -10,   0,   9.2,      7},
    {"right_shoulder",  10,   0,   9.2,      7},
    {"left_hip",       -10,  40, 17.95,      7},
    {"right_hip",       10,  40, 17.95,      7},
    {"center",           0,   0,     0,      0, Rig::classic},
    {"head_left",      -10, -30,     0,      0, Rig::classic},
    {"head_right",      10, -30,     0,      0, Rig::classic},
    {"left_elbow",     -45,   5,  2.45,      4},
    {"right_elbow",     45,   5,  2.45,      4},
    {"left_hand",      -70,  20,   1.1,      4},
    {"right_hand",      70,  20,   1.1,      4},
    {"left_knee",      -25,  80,  9.95,      5},
    {"right_knee",      25,  80,  9.95,      5},
    {"left_foot",      -20, 130,  2.85,      5},
    {"right_foot",      20, 130,  2.85,      5},
    {"neck",             0,   0,     7,      7, Rig::physical},
    {"head",             0, -16,     6,     14, Rig::physical},
};
// clang-format on
static_assert(shares_are_whole(joints, Rig::physical));

constexpr double line = 7, tallness = 160;
// Widths in physical mode.
constexpr double torso = 14, hip = 14, ankle = 8, shoulder = 10, elbow = 9, sleeve = 12, wrist = 6;
constexpr double head_size = 29, hand_size = 9, foot_size = 12;

// clang-format off
constexpr Bone bones[] = {
    // name                from              to                part     classic width  width
    {"shoulders",        "left_shoulder",  "right_shoulder", "torso", line,                  0},
    {"pelvis",           "left_hip",       "right_hip",      "torso", line,                  0},
    {"left_side",        "left_shoulder",  "left_hip",       "torso", line,                  0},
    {"right_side",       "right_shoulder", "right_hip",      "torso", line,                  0},
    {"crown",            "head_left",      "head_right",     "head",  line,                  0, Rig::classic},
    {"left_neck",        "left_shoulder",  "head_left",      "head",  line,                  0, Rig::classic},
    {"right_neck",       "right_shoulder", "head_right",     "head",  line,                  0, Rig::classic},
    {"left_upper_arm",   "left_shoulder",  "left_elbow",     "arm",   line,                  0},
    {"left_forearm",     "left_elbow",     "left_hand",      "arm",   line,                0},
    {"right_upper_arm",  "right_shoulder", "right_elbow",    "arm",   line,                  0},
    {"right_forearm",    "right_elbow",    "right_hand",     "arm",   line,                0},
    {"left_thigh",       "left_hip",       "left_knee",      "leg",   line,              0},
    {"left_shin",        "left_knee",      "left_foot",      "leg",   line,             0},
    {"right_thigh",      "right_hip",      "right_knee",     "leg",   line,              0},
    {"right_shin",       "right_knee",     "right_foot",     "leg",   line,             0},
    {"falling_beam",     "left_shoulder",  "right_hip",      "beam",             0,       0, Rig::classic},
    {"rising_beam",      "right_shoulder", "left_hip",       "beam",             0,       0, Rig::classic},
    {"left_head_beam",   "right_shoulder", "head_left",      "beam",             0,       0, Rig::classic},
    {"right_head_beam",  "left_shoulder",  "head_right",     "beam",             0,       0, Rig::classic},
    {"left_leg_beam",    "left_hip",       "left_foot",      "beam",             0,       0, Rig::classic},
    {"right_leg_beam",   "right_hip",      "right_foot",     "beam",             0,       0, Rig::classic},
    {"left_collar",      "neck",           "left_shoulder",  "torso",            0,       0, Rig::physical},
    {"right_collar",     "neck",           "right_shoulder", "torso",            0,       0, Rig::physical},
    {"left_spine",       "neck",           "left_hip",       "torso",            0,       0, Rig::physical},
    {"right_spine",      "neck",           "right_hip",      "torso",            0,       0, Rig::physical},
    {"neck",             "neck",           "head",           "head",             0,       0, Rig::physical},
};
// clang-format on

// Knees point outwards and elbows up: the right side mirrors the left. Turns of the trunk are limited so that a blow
// cannot leave it inside out: at rest they are 104 and 90 degrees, and the nod 14.
// clang-format off
constexpr Bend bends[] = {
    // name              from              at                to             least  most
    {"left_elbow",     "left_shoulder",  "left_elbow",     "left_hand",      0,  150, Rig::physical},
    {"right_elbow",    "right_shoulder", "right_elbow",    "right_hand",  -150,    0, Rig::physical},
    {"left_knee",      "left_hip",       "left_knee",      "left_foot",      0,  140, Rig::physical},
    {"right_knee",     "right_hip",      "right_knee",     "right_foot",  -140,    0, Rig::physical},
    {"left_hip",       "left_shoulder",  "left_hip",       "left_knee",   -120,   45, Rig::physical},
    {"right_hip",      "right_shoulder", "right_hip",      "right_knee",   -45,  120, Rig::physical},
    {"nod",            "left_hip",       "neck",           "head",         -21, 49, Rig::physical},
    {"trunk",          "left_hip",       "right_hip",      "neck",          60,  150, Rig::physical},
    {"left_shoulder",  "neck",           "left_shoulder",  "left_hip",      45,  135, Rig::physical},
    {"right_shoulder", "neck",           "right_shoulder", "right_hip",   -135,  -45, Rig::physical},
};
// clang-format on

constexpr Body body{joints, bones, bends};

/// Flesh on the bones, back to front: legs, trunk, arms, head.
template <int D, class Real> void draw_flesh(Builder<D, Real>& figure, double scale) {
    const auto named = [&](std::initializer_list<std::string_view> names) {
        std::vector<ParticleId> particles;
        for (const auto name : names) particles.push_back(figure.named(name));
        return particles;
    };
    const auto limb = [&](std::string_view part, std::initializer_list<std::string_view> names, double from,
                          double to) {
        figure.draw_tapered(Mark::stroke, part, named(names), scale * from, scale * to);
    };
    for (const auto* foot : {"left_foot", "right_foot"})
        figure.draw(Mark::dot, "foot", named({foot}), scale * foot_size);
    limb("leg", {"left_hip", "left_knee", "left_foot"}, hip, ankle);
    limb("leg", {"right_hip", "right_knee", "right_foot"}, hip, ankle);
    const auto trunk = named({"left_shoulder", "right_shoulder", "right_hip", "left_hip"});
    figure.draw(Mark::fill, "torso", trunk);
    figure.draw(Mark::loop, "torso", trunk, scale * torso);
    figure.draw(Mark::stroke, "belt", named({"left_hip", "right_hip"}), scale * hip);
    limb("arm", {"left_shoulder", "left_elbow", "left_hand"}, shoulder, wrist);
    limb("arm", {"right_shoulder", "right_elbow", "right_hand"}, shoulder, wrist);
    for (const auto* hand : {"left_hand", "right_hand"})
        figure.draw(Mark::dot, "hand", named({hand}), scale * hand_size);
    limb("sleeve", {"left_shoulder", "left_elbow"}, sleeve, elbow);
    limb("sleeve", {"right_shoulder", "right_elbow"}, sleeve, elbow);
    figure.draw(Mark::dot, "head", named({"head"}), scale * head_size);
}

} // namespace

Sizes Ragdoll::sizes() const {
    return body.sizes();
}

template <int D, class Real> void Ragdoll::build(Builder<D, Real>& figure) const {
    const double scale = height / tallness;
    build_body(figure, body, scale, mass);
    if (figure.mode() == Mode::physical) draw_flesh(figure, scale);
}

template void Ragdoll::build(Builder<2, float>&) const;
template void Ragdoll::build(Builder<2, double>&) const;

} // namespace sinew
