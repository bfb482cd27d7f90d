#include "sinew/prefab/stick_figure.h"

#include "sinew/prefab/body.h"

namespace sinew {
namespace stick_figure_rig {
namespace {

// Mass shares: body segments after de Leva 1996, each halved between the joints at its ends.
// clang-format off
constexpr Joint joints[] = {
    // name           x    y    share  radius
    {"head",          0, -18,     7,     12},
    {"neck",          0,   0,  24.4,      2},
    {"hips",          0,  45,  35.9,      2},
    {"left_elbow",  -25,  18,  2.45,      2},
    {"left_hand",   -42,  42,   1.1,      2},
    {"right_elbow",  25,  18,  2.45,      2},
    {"right_hand",   42,  42,   1.1,      2},
    {"left_knee",   -14,  87,  9.95,      2},
    {"left_foot",   -20, 130,  2.85,      2},
    {"right_knee",   14,  87,  9.95,      2},
    {"right_foot",   20, 130,  2.85,      2},
};
// clang-format on
static_assert(shares_are_whole(joints, Rig::both));

constexpr double line = 4, head_size = 24, tallness = 160;

// clang-format off
constexpr Bone bones[] = {
    // name                 from           to             part       classic width  width
    {"neck",              "neck",        "head",        "stick",   line,          line},
    {"spine",             "neck",        "hips",        "stick",   line,          line},
    {"left_upper_arm",    "neck",        "left_elbow",  "stick",   line,          line},
    {"left_forearm",      "left_elbow",  "left_hand",   "stick",   line,          line},
    {"right_upper_arm",   "neck",        "right_elbow", "stick",   line,          line},
    {"right_forearm",     "right_elbow", "right_hand",  "stick",   line,          line},
    {"left_thigh",        "hips",        "left_knee",   "stick",   line,          line},
    {"left_shin",         "left_knee",   "left_foot",   "stick",   line,          line},
    {"right_thigh",       "hips",        "right_knee",  "stick",   line,          line},
    {"right_shin",        "right_knee",  "right_foot",  "stick",   line,          line},
    {"head_support",      "hips",        "head",        "support",             0,     0},
    {"left_arm_support",  "hips",        "left_elbow",  "support",             0,     0},
    {"right_arm_support", "hips",        "right_elbow", "support",             0,     0},
    {"left_leg_support",  "neck",        "left_knee",   "support",             0,     0},
    {"right_leg_support", "neck",        "right_knee",  "support",             0,     0},
};
// clang-format on

// Supports hold thighs and upper arms; forearms and shins are kept on their own side of the trunk by angle limits.
// clang-format off
constexpr Bend bends[] = {
    // name          from    at             to            least most
    {"left_elbow",  "neck", "left_elbow",  "left_hand",     0,   95, Rig::physical},
    {"right_elbow", "neck", "right_elbow", "right_hand",  -95,    0, Rig::physical},
    {"left_knee",   "hips", "left_knee",   "left_foot",  -110,   25, Rig::physical},
    {"right_knee",  "hips", "right_knee",  "right_foot",  -25,  110, Rig::physical},
};
// clang-format on

constexpr Body body{joints, bones, bends};

} // namespace
} // namespace stick_figure_rig

Sizes StickFigure::sizes() const {
    return stick_figure_rig::body.sizes();
}

template <int D, class Real> void StickFigure::build(Builder<D, Real>& figure) const {
    using namespace stick_figure_rig;
    const double scale = height / tallness;
    build_body(figure, body, scale, mass);
    figure.draw(Mark::dot, "head", {figure.named("head")}, scale * head_size);
}

#define SINEW_STICK_FIGURE(D, Real) template void StickFigure::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_STICK_FIGURE)

} // namespace sinew
