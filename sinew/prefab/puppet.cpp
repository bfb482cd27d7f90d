#include "sinew/prefab/puppet.h"

#include <array>

namespace sinew {
namespace {

/// The man of the tearable cloth demo: masses, and positions at which every link has its rest length. Unit: heads; the
/// figure is 7.5 heads from shoulder to foot.
struct PuppetPoint {
    std::string_view name;
    double x, y, mass;
};
// clang-format off
constexpr PuppetPoint points[] = {
    {"head",         0,     1.25,   4},
    {"shoulder",     0,     0,     26},
    {"pelvis",       0,    -3.5,   15},
    {"left_elbow",  -1.2,  -0.9,    2}, // 1.5 = |(1.2, 0.9)|
    {"right_elbow",  1.2,  -0.9,    2},
    {"left_hand",   -2.4,  -2.5,    2}, // 2 = |(1.2, 1.6)|
    {"right_hand",   2.4,  -2.5,    2},
    {"left_knee",   -0.56, -5.42,  10}, // 2 = |(0.56, 1.92)|
    {"right_knee",   0.56, -5.42,  10},
    {"left_foot",   -0.56, -7.42,   5},
    {"right_foot",   0.56, -7.42,   5},
};
constexpr double whole = 83;

struct Link {
    std::string_view name, from, to;
    double length, relaxation;
    bool support = false; // true: a hidden link of the classic rig
};
constexpr Link links[] = {
    {"neck",            "head",        "shoulder",    1.25, 1},
    {"left_upper_arm",  "left_elbow",  "shoulder",    1.5,  1},
    {"right_upper_arm", "right_elbow", "shoulder",    1.5,  1},
    {"left_forearm",    "left_hand",   "left_elbow",  2,    1},
    {"right_forearm",   "right_hand",  "right_elbow", 2,    1},
    {"spine",           "pelvis",      "shoulder",    3.5,  0.8},
    {"left_thigh",      "left_knee",   "pelvis",      2,    1},
    {"right_thigh",     "right_knee",  "pelvis",      2,    1},
    {"left_shin",       "left_foot",   "left_knee",   2,    1},
    {"right_shin",      "right_foot",  "right_knee",  2,    1},
    {"head_support",    "pelvis",      "head",        4.75, 0.02,  true},
    {"left_support",    "left_foot",   "shoulder",    7.5,  0.001, true},
    {"right_support",   "right_foot",  "shoulder",    7.5,  0.001, true},
};

struct Turn {
    std::string_view name, from, at, to;
    double min, max; // degrees, counter-clockwise
};
constexpr Turn turns[] = {
    {"nod",         "pelvis",   "shoulder",    "head",        -40,  40},
    {"left_arm",    "shoulder", "left_elbow",  "left_hand",     0, 150},
    {"right_arm",   "shoulder", "right_elbow", "right_hand", -150,   0},
    {"left_leg",    "pelvis",   "left_knee",   "left_foot",     0, 140},
    {"right_leg",   "pelvis",   "right_knee",  "right_foot", -140,   0},
};
// clang-format on

} // namespace

Sizes Puppet::sizes() const {
    return {.particles = std::size(points), .constraints = std::size(links) + std::size(turns)};
}

template <int D, class Real> void Puppet::build(Builder<D, Real>& figure) const {
    constexpr double heads = 7.5, head_width = 1.3;
    const double unit = height / heads;
    const bool classic = figure.mode() == Mode::classic;
    for (const auto& [called, x, y, weight] : points)
        figure.weighed_particle(called, on_screen<D>(unit * x, unit * y), mass * weight / whole, thickness / 2);
    for (const auto& link : links) {
        if (link.support && !classic) continue;
        const auto from = figure.named(link.from), to = figure.named(link.to);
        figure.template constrain<Distance>(
            link.name, {from, to},
            {.limits = exactly(unit * link.length),
             .compliance = link.support ? 1.0 : 0.0, // soft: the rest length is satisfied neither at first nor later
             .relaxation = classic ? link.relaxation : 1});
        figure.draw(Mark::stroke, link.support ? "support" : "limb", {from, to}, thickness, link.support);
    }
    constexpr double degree = pi<double> / 180;
    for (const auto& turn : turns)
        if (!classic)
            figure.template constrain<Angle>(turn.name,
                                             {figure.named(turn.from), figure.named(turn.at), figure.named(turn.to)},
                                             {.limits = between(turn.min * degree, turn.max * degree)});
    figure.draw(Mark::dot, "head", {figure.named("head")}, head_width * unit);
}

#define SINEW_PUPPET(D, Real) template void Puppet::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_PUPPET)

} // namespace sinew
