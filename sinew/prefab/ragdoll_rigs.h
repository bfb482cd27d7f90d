#pragma once

#include "sinew/prefab/body.h"

/// The rigs of the ragdoll, in pixels: how it is built in the plane and in space.
namespace sinew::ragdoll_in_plane {

// Places: the Roblox ragdoll, pixels. Shares, which count in physical mode only: the segments of the body after de Leva
// 1996, each divided between the joints at its ends; the upper trunk's also to the neck, for a light joint between
// heavy ones is what a blow crushes first.
// clang-format off
inline constexpr Joint joints[] = {
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

inline constexpr double line = 7;

// clang-format off
inline constexpr Bone bones[] = {
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

// Knees point outwards and elbows up: the right side mirrors the left. A thigh opens 70 degrees from the trunk, so that
// the legs cannot come down in a split. Turns of the trunk are limited so that a blow cannot leave it inside out: at
// rest they are 104 and 90 degrees, and the nod 14.
// clang-format off
inline constexpr Bend bends[] = {
    // name              from              at                to             least  most
    {"left_elbow",     "left_shoulder",  "left_elbow",     "left_hand",      0,  150, Rig::physical},
    {"right_elbow",    "right_shoulder", "right_elbow",    "right_hand",  -150,    0, Rig::physical},
    {"left_knee",      "left_hip",       "left_knee",      "left_foot",      0,  140, Rig::physical},
    {"right_knee",     "right_hip",      "right_knee",     "right_foot",  -140,    0, Rig::physical},
    {"left_hip",       "left_shoulder",  "left_hip",       "left_knee",    -70,   45, Rig::physical},
    {"right_hip",      "right_shoulder", "right_hip",      "right_knee",   -45,   70, Rig::physical},
    {"nod",            "left_hip",       "neck",           "head",         -21, 49, Rig::physical},
    {"trunk",          "left_hip",       "right_hip",      "neck",          60,  150, Rig::physical},
    {"left_shoulder",  "neck",           "left_shoulder",  "left_hip",      45,  135, Rig::physical},
    {"right_shoulder", "neck",           "right_shoulder", "right_hip",   -135,  -45, Rig::physical},
};
// clang-format on

inline constexpr Body body{joints, bones, bends};

} // namespace sinew::ragdoll_in_plane

namespace sinew::ragdoll_in_space {

// The same body with depth: its front is towards positive z. Shoulders and neck are one rigid triangle, hips and neck
// another; all other joints are kept in their ranges by distances that have room (Jakobsen 2001), and by folds. The
// knees come 0.78 m apart at the most, as thighs do that open 46 degrees each.
// clang-format off
inline constexpr Joint joints[] = {
    // name              x    y    share  radius
    {"neck",             0,   0,     7,      7, Rig::both,  0},
    {"head",             0, -17,     6,     13, Rig::both,  2},
    {"left_shoulder",  -13,   4,   9.2,      7, Rig::both, -2},
    {"right_shoulder",  13,   4,   9.2,      7, Rig::both, -2},
    {"left_hip",        -9,  42, 17.95,      7, Rig::both,  0},
    {"right_hip",        9,  42, 17.95,      7, Rig::both,  0},
    {"left_elbow",     -36,  18,  2.45,      4, Rig::both, -2},
    {"right_elbow",     36,  18,  2.45,      4, Rig::both, -2},
    {"left_hand",      -55,  35,   1.1,      4, Rig::both,  4},
    {"right_hand",      55,  35,   1.1,      4, Rig::both,  4},
    {"left_knee",      -15,  83,  9.95,      5, Rig::both,  4},
    {"right_knee",      15,  83,  9.95,      5, Rig::both,  4},
    {"left_foot",      -17, 128,  2.85,      5, Rig::both, -1},
    {"right_foot",      17, 128,  2.85,      5, Rig::both, -1},
};
static_assert(shares_are_whole(joints, Rig::both));

inline constexpr double no_limit = 100;
inline constexpr double stick = 5, thread = 1; // lines of classic mode: bones, and what keeps joints in their ranges

inline constexpr Bone bones[] = {
    // name                from              to               part        widths        least  most
    {"shoulders",        "left_shoulder",  "right_shoulder", "torso",     stick, 0},
    {"left_collar",      "neck",           "left_shoulder",  "torso",     stick, 0},
    {"right_collar",     "neck",           "right_shoulder", "torso",     stick, 0},
    {"pelvis",           "left_hip",       "right_hip",      "torso",     stick, 0},
    {"left_spine",       "neck",           "left_hip",       "torso",     stick, 0},
    {"right_spine",      "neck",           "right_hip",      "torso",     stick, 0},
    {"neck",             "neck",           "head",           "head",      stick, 0},
    {"left_upper_arm",   "left_shoulder",  "left_elbow",     "arm",       stick, 0},
    {"left_forearm",     "left_elbow",     "left_hand",      "arm",       stick, 0},
    {"right_upper_arm",  "right_shoulder", "right_elbow",    "arm",       stick, 0},
    {"right_forearm",    "right_elbow",    "right_hand",     "arm",       stick, 0},
    {"left_thigh",       "left_hip",       "left_knee",      "leg",       stick, 0},
    {"left_shin",        "left_knee",      "left_foot",      "leg",       stick, 0},
    {"right_thigh",      "right_hip",      "right_knee",     "leg",       stick, 0},
    {"right_shin",       "right_knee",     "right_foot",     "leg",       stick, 0},
    {"left_side",        "left_shoulder",  "left_hip",       "limit", thread, 0, Rig::both, 0.85, 1.1},
    {"right_side",       "right_shoulder", "right_hip",      "limit", thread, 0, Rig::both, 0.85, 1.1},
    {"falling_twist",    "left_shoulder",  "right_hip",      "limit", thread, 0, Rig::both, 0.85, 1.1},
    {"rising_twist",     "right_shoulder", "left_hip",       "limit", thread, 0, Rig::both, 0.85, 1.1},
    {"left_nod",         "left_shoulder",  "head",           "limit", thread, 0, Rig::both, 0.7, 1.25},
    {"right_nod",        "right_shoulder", "head",           "limit", thread, 0, Rig::both, 0.7, 1.25},
    {"left_bow",         "left_hip",       "head",           "limit", thread, 0, Rig::both, 0.93, 1.1},
    {"right_bow",        "right_hip",      "head",           "limit", thread, 0, Rig::both, 0.93, 1.1},
    {"left_reach",       "left_shoulder",  "left_hand",      "limit", thread, 0, Rig::both, 0.35, no_limit},
    {"right_reach",      "right_shoulder", "right_hand",     "limit", thread, 0, Rig::both, 0.35, no_limit},
    {"left_squat",       "left_hip",       "left_foot",      "limit", thread, 0, Rig::both, 0.35, no_limit},
    {"right_squat",      "right_hip",      "right_foot",     "limit", thread, 0, Rig::both, 0.35, no_limit},
    {"left_crouch",      "left_shoulder",  "left_knee",      "limit", thread, 0, Rig::both, 0.5, no_limit},
    {"right_crouch",     "right_shoulder", "right_knee",     "limit", thread, 0, Rig::both, 0.5, no_limit},
    {"knees",            "left_knee",      "right_knee",     "limit", thread, 0, Rig::both, 0.45, 2.6},
    {"ankles",           "left_foot",      "right_foot",     "limit", thread, 0, Rig::both, 0.3, no_limit},
};

inline constexpr Fold folds[] = {
    // name            about the line from    to           from a     to         least  most
    {"left_knee",    {"left_hip",       "right_hip",   "left_knee",  "left_foot"},     0,    1},
    {"right_knee",   {"left_hip",       "right_hip",   "right_knee", "right_foot"},    0,    1},
    {"left_hip",     {"left_hip",       "right_hip",   "neck",       "left_knee"},  -0.4,    1},
    {"right_hip",    {"left_hip",       "right_hip",   "neck",       "right_knee"}, -0.4,    1},
};
// clang-format on

inline constexpr Body body{joints, bones, {}, folds};

} // namespace sinew::ragdoll_in_space
