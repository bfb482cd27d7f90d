#include "sinew/prefab/humanoid.h"

#include "sinew/prefab/body.h"

namespace sinew {
namespace humanoid_rig {
namespace {

// The GameMaker tutorial's rig at its scale of 2, in pixels: right arm 40 and 40, all other limbs 64 and 64. The
// tutorial begins with outstretched arms; classic mode does the same here.
// clang-format off
constexpr Joint joints[] = {
    // name               x       y   share  radius
    {"root",              0,      0,      4,     20},
    {"head",              0,    -24,     16,     20},
    {"right_shoulder",   24,      3,      8,     10},
    {"left_shoulder",   -24,      3,      8,     10},
    {"right_hip",        21,     46,      8,     12},
    {"left_hip",        -21,     46,      8,     12},
    {"right_elbow",      56,     27,      8,     10, Rig::physical},
    {"right_hand",       88,     51,      4,     10, Rig::physical},
    {"left_elbow",    -62.4,   54.2,      8,     10, Rig::physical},
    {"left_hand",    -80.32, 115.64,      4,     10, Rig::physical},
    {"right_knee",    38.92, 107.44,      8,     12, Rig::physical},
    {"right_foot",    38.92, 171.44,      4,     12, Rig::physical},
    {"left_knee",    -38.92, 107.44,      8,     12, Rig::physical},
    {"left_foot",    -38.92, 171.44,      4,     12, Rig::physical},
    {"right_elbow",      64,      3,      0,      0, Rig::classic},
    {"right_hand",      104,      3,      0,      0, Rig::classic},
    {"left_elbow",      -88,      3,      0,      0, Rig::classic},
    {"left_hand",      -152,      3,      0,      0, Rig::classic},
    {"right_knee",       21,    110,      0,      0, Rig::classic},
    {"right_foot",       21,    174,      0,      0, Rig::classic},
    {"left_knee",       -21,    110,      0,      0, Rig::classic},
    {"left_foot",       -21,    174,      0,      0, Rig::classic},
};
// clang-format on
static_assert(shares_are_whole(joints, Rig::physical));

// clang-format off
constexpr Bone bones[] = {
    // name                from              to                part  widths
    {"neck",             "root",           "head",           "bone", 0, 0, Rig::physical},
    {"right_collar",     "right_shoulder", "head",           "bone", 0, 0, Rig::physical},
    {"left_collar",      "left_shoulder",  "head",           "bone", 0, 0, Rig::physical},
    {"right_upper_arm",  "right_shoulder", "right_elbow",    "bone", 0, 0},
    {"right_forearm",    "right_elbow",    "right_hand",     "bone", 0, 0},
    {"left_upper_arm",   "left_shoulder",  "left_elbow",     "bone", 0, 0},
    {"left_forearm",     "left_elbow",     "left_hand",      "bone", 0, 0},
    {"right_thigh",      "right_hip",      "right_knee",     "bone", 0, 0},
    {"right_shin",       "right_knee",     "right_foot",     "bone", 0, 0},
    {"left_thigh",       "left_hip",       "left_knee",      "bone", 0, 0},
    {"left_shin",        "left_knee",      "left_foot",      "bone", 0, 0},
    {"neck",             "root",           "head",           "bone", 0, 0, Rig::classic},
    {"left_collar",      "left_shoulder",  "head",           "bone", 0, 0, Rig::classic},
    {"right_collar",     "right_shoulder", "head",           "bone", 0, 0, Rig::classic},
    {"right_chest",      "root",           "right_shoulder", "bone", 0, 0, Rig::physical},
    {"left_chest",       "root",           "left_shoulder",  "bone", 0, 0, Rig::physical},
    {"right_belly",      "root",           "right_hip",      "bone", 0, 0, Rig::physical},
    {"left_belly",       "root",           "left_hip",       "bone", 0, 0, Rig::physical},
    {"shoulders",        "left_shoulder",  "right_shoulder", "bone", 0, 0, Rig::physical},
    {"pelvis",           "left_hip",       "right_hip",      "bone", 0, 0, Rig::physical},
    {"right_side",       "right_shoulder", "right_hip",      "bone", 0, 0, Rig::physical},
    {"left_side",        "left_shoulder",  "left_hip",       "bone", 0, 0, Rig::physical},
};
// clang-format on

constexpr Body body{joints, bones, {}};
constexpr double tallness = 216;
constexpr double trouser = 24, shoe = 26, sleeve = 20, fist = 20, belly = 48, face = 40;

} // namespace
} // namespace humanoid_rig

Sizes Humanoid::sizes() const {
    return humanoid_rig::body.sizes();
}

template <int D, class Real> void Humanoid::build(Builder<D, Real>& figure) const {
    using namespace humanoid_rig;
    const double scale = height / tallness;
    build_body(figure, body, scale, mass);
    const auto limb = [&](std::array<std::string_view, 3> names, std::string_view part, double width,
                          std::string_view tip, double tip_width) {
        std::vector<ParticleId> through;
        for (const auto joint : names) through.push_back(figure.named(joint));
        figure.draw(Mark::tip, tip, through, scale * tip_width);
        figure.draw(Mark::limb, part, through, scale * width);
    };
    limb(limbs[2], "trouser", trouser, "left_shoe", shoe);
    limb(limbs[3], "trouser", trouser, "right_shoe", shoe);
    limb(limbs[0], "sleeve", sleeve, "left_fist", fist);
    const std::vector trunk{figure.named("left_shoulder"), figure.named("right_shoulder"), figure.named("right_hip"),
                            figure.named("left_hip")};
    figure.draw(Mark::fill, "trunk", trunk);
    figure.draw(Mark::loop, "trunk", trunk, scale * sleeve);
    figure.draw(Mark::dot, "body", {figure.named("root")}, scale * belly);
    figure.draw(Mark::dot, "face", {figure.named("head")}, scale * face);
    limb(limbs[1], "sleeve", sleeve, "right_fist", fist);
}

#define SINEW_HUMANOID(D, Real) template void Humanoid::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_HUMANOID)

} // namespace sinew
