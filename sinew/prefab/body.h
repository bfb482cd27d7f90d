#pragma once

#include "sinew/prefab/builder.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

/// Bodies are tables: of joints, of bones between them, of how far they bend, and of what to draw. Places, widths and
/// radii are in the tables' own unit, x right and y DOWN, as their sources have them; left and right are the screen's.
namespace sinew {

/// Whether a row belongs to the rig of one mode only.
enum class Rig : char { both, classic, physical };

struct Joint {
    std::string_view name;
    double x, y;
    double share;      ///< of the body's mass, in percent
    double radius = 0; ///< how far it stays away from walls
    Rig rig = Rig::both;
    double z = 0; ///< in space: towards the front
};

struct Bone {
    std::string_view name, from, to;
    std::string_view part;
    double classic_width, width; ///< as drawn; 0: a support, drawn only when asked for
    Rig rig = Rig::both;
    double least = 1, most = 1; ///< how far apart its ends may be, as shares of their distance in the table
};

/// The turn at `at` on the way from -> at -> to stays in a range: degrees, counter-clockwise as seen on screen.
struct Bend {
    std::string_view name, from, at, to;
    double least, most;
    Rig rig = Rig::both;
};

/// In space: a limb bends to one side only. The volume of four particles, as a share of the product of the lengths
/// from the first to the others as the table has them (a sixth of it), stays in a range: the sine of the turn from the
/// third to the fourth about the line from the first to the second, if all are square to that line.
struct Fold {
    std::string_view name;
    std::array<std::string_view, 4> between;
    double least, most;
};

/// Turns what hangs on a joint about it, before the body is built: degrees, counter-clockwise as seen on screen.
struct PoseTurn {
    std::string_view at;
    double degrees;
};

struct Body {
    std::span<const Joint> joints;
    std::span<const Bone> bones;
    std::span<const Bend> bends;
    std::span<const Fold> folds{};

    Sizes sizes() const {
        return {.particles = joints.size(), .constraints = bones.size() + bends.size() + folds.size()};
    }
};

/// Limbs as rows of joints; a turn at one of them moves those behind it.
inline constexpr std::array<std::array<std::string_view, 3>, 4> limbs{{{"left_shoulder", "left_elbow", "left_hand"},
                                                                       {"right_shoulder", "right_elbow", "right_hand"},
                                                                       {"left_hip", "left_knee", "left_foot"},
                                                                       {"right_hip", "right_knee", "right_foot"}}};

/// The joints of a table in a pose, in the order of the table.
std::vector<Joint> posed(std::span<const Joint> joints, std::span<const PoseTurn> pose);

constexpr bool shares_are_whole(std::span<const Joint> joints, Rig rig) {
    double sum = 0;
    for (const auto& joint : joints)
        if (joint.rig == Rig::both || joint.rig == rig) sum += joint.share;
    return absolute(sum - 100) < 1e-9;
}

/// A place of a body's table in the prefab's frame.
template <int D> Vec<D, double> place_of(const Joint& joint, double scale) {
    auto place = on_screen<D>(scale * joint.x, -scale * joint.y);
    if constexpr (D == 3) place[2] = scale * joint.z;
    return place;
}

/// The row of a name in a body's table. Tables only ask for names they have.
inline const Joint& joint_of(const Body& body, std::string_view name) {
    return *std::find_if(body.joints.begin(), body.joints.end(),
                         [&](const Joint& joint) { return joint.name == name; });
}

template <int D> double length_in_table(const Body& body, const Bone& bone, double scale) {
    return distance(place_of<D>(joint_of(body, bone.from), scale), place_of<D>(joint_of(body, bone.to), scale));
}

/// Builds the rows of a body that belong to the builder's mode.
template <int D, class Real>
void build_body(Builder<D, Real>& figure, const Body& body, double scale, double mass,
                std::span<const PoseTurn> pose = {}) {
    const auto belongs = [&](Rig rig) {
        return rig == Rig::both || (rig == Rig::classic) == (figure.mode() == Mode::classic);
    };
    for (const auto& joint : posed(body.joints, pose))
        if (belongs(joint.rig))
            figure.particle(joint.name, place_of<D>(joint, scale), mass * joint.share / 100, scale * joint.radius);

    for (const auto& bone : body.bones) {
        if (!belongs(bone.rig)) continue;
        const double width = figure.mode() == Mode::classic ? bone.classic_width : bone.width;
        const auto from = figure.named(bone.from), to = figure.named(bone.to);
        const std::array ends{from, to};
        const double length = bone.least == 1 && bone.most == 1 ? figure.template measure<Distance>(ends)
                                                                : length_in_table<D>(body, bone, scale);
        figure.template constrain<Distance>(bone.name, {from, to},
                                            {.limits = between(bone.least * length, bone.most * length)});
        figure.draw(Mark::stroke, bone.part, {from, to}, scale * width, width == 0);
    }
    constexpr double degree = pi<double> / 180;
    for (const auto& bend : body.bends)
        if (belongs(bend.rig))
            figure.template constrain<Angle>(bend.name,
                                             {figure.named(bend.from), figure.named(bend.at), figure.named(bend.to)},
                                             {.limits = between(bend.least * degree, bend.most * degree)});
    if constexpr (D == 3)
        for (const auto& fold : body.folds) {
            std::array<ParticleId, 4> members{};
            for (std::size_t i = 0; i < 4; ++i) members[i] = figure.named(fold.between[i]);
            double whole = 1.0 / 6;
            for (const std::size_t i : {1U, 2U, 3U})
                whole *= distance(place_of<D>(joint_of(body, fold.between[0]), scale),
                                  place_of<D>(joint_of(body, fold.between[i]), scale));
            figure.template constrain<Volume>(fold.name, members,
                                              {.limits = between(fold.least * whole, fold.most * whole)});
        }
}

} // namespace sinew
