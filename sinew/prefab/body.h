#pragma once

#include "sinew/prefab/builder.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

/// A body is a set of tables: joints, bones between joints, limits of bending angles, and parts to draw. Positions,
/// widths and radii are in the table's own unit, x right and y DOWN as in the sources; left and right are those of the
/// screen.
namespace sinew {

/// Mode in which a row of a table is used.
enum class Rig : char { both, classic, physical };

struct Joint {
    std::string_view name;
    double x, y;
    double share;      ///< share of the body's mass, percent
    double radius = 0; ///< collision radius, table units
    Rig rig = Rig::both;
    double z = 0; ///< 3D only: depth, positive towards the front
};

struct Bone {
    std::string_view name, from, to;
    std::string_view part;
    double classic_width, width; ///< line width as drawn; 0: a support, drawn only on request
    Rig rig = Rig::both;
    double min = 1, max = 1; ///< range of the distance between the ends, as shares of the distance in the table
};

/// Range of the angle at `at` between the directions from -> at and at -> to, degrees, counter-clockwise on screen.
struct Bend {
    std::string_view name, from, at, to;
    double min, max;
    Rig rig = Rig::both;
};

/// A 3D limit that lets a limb bend to one side only: a range of the tetrahedron's volume. The volume is stated as a
/// share of a sixth of the product of the lengths from the first particle to the other three, as the table has them.
/// Where these edges are perpendicular to the axis first -> second, the share is the sine of the angle from the third
/// particle to the fourth about the axis.
struct Fold {
    std::string_view name;
    std::array<std::string_view, 4> between;
    double min, max;
};

/// Rotation, about a joint, of the joints further along the same limb, applied before the body is built; degrees,
/// counter-clockwise on screen.
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

/// Limbs as rows of joints, from the trunk outwards; a rotation at a joint moves the joints after it.
inline constexpr std::array<std::array<std::string_view, 3>, 4> limbs{{{"left_shoulder", "left_elbow", "left_hand"},
                                                                       {"right_shoulder", "right_elbow", "right_hand"},
                                                                       {"left_hip", "left_knee", "left_foot"},
                                                                       {"right_hip", "right_knee", "right_foot"}}};

/// Joints of a table in a pose, in table order.
std::vector<Joint> posed(std::span<const Joint> joints, std::span<const PoseTurn> pose);

constexpr bool shares_are_whole(std::span<const Joint> joints, Rig rig) {
    double sum = 0;
    for (const auto& joint : joints)
        if (joint.rig == Rig::both || joint.rig == rig) sum += joint.share;
    return absolute(sum - 100) < 1e-9;
}

/// Position of a joint in the prefab's frame.
template <int D> Vec<D, double> position_of(const Joint& joint, double scale) {
    auto position = on_screen<D>(scale * joint.x, -scale * joint.y);
    if constexpr (D == 3) position[2] = scale * joint.z;
    return position;
}

/// Joint of a given name. The name must be in the table.
inline const Joint& joint_of(const Body& body, std::string_view name) {
    return *std::find_if(body.joints.begin(), body.joints.end(),
                         [&](const Joint& joint) { return joint.name == name; });
}

template <int D> double length_in_table(const Body& body, const Bone& bone, double scale) {
    return distance(position_of<D>(joint_of(body, bone.from), scale), position_of<D>(joint_of(body, bone.to), scale));
}

/// Builds the rows of a body that the builder's mode uses.
template <int D, class Real>
void build_body(Builder<D, Real>& figure, const Body& body, double scale, double mass,
                std::span<const PoseTurn> pose = {}) {
    const auto belongs = [&](Rig rig) {
        return rig == Rig::both || (rig == Rig::classic) == (figure.mode() == Mode::classic);
    };
    for (const auto& joint : posed(body.joints, pose))
        if (belongs(joint.rig))
            figure.particle(joint.name, position_of<D>(joint, scale), mass * joint.share / 100, scale * joint.radius);

    for (const auto& bone : body.bones) {
        if (!belongs(bone.rig)) continue;
        const double width = figure.mode() == Mode::classic ? bone.classic_width : bone.width;
        const auto from = figure.named(bone.from), to = figure.named(bone.to);
        const std::array ends{from, to};
        const double length = bone.min == 1 && bone.max == 1 ? figure.template measure<Distance>(ends)
                                                             : length_in_table<D>(body, bone, scale);
        figure.template constrain<Distance>(bone.name, {from, to},
                                            {.limits = between(bone.min * length, bone.max * length)});
        figure.draw(Mark::stroke, bone.part, {from, to}, scale * width, width == 0);
    }
    constexpr double degree = pi<double> / 180;
    for (const auto& bend : body.bends)
        if (belongs(bend.rig))
            figure.template constrain<Angle>(bend.name,
                                             {figure.named(bend.from), figure.named(bend.at), figure.named(bend.to)},
                                             {.limits = between(bend.min * degree, bend.max * degree)});
    if constexpr (D == 3)
        for (const auto& fold : body.folds) {
            std::array<ParticleId, 4> members{};
            for (std::size_t i = 0; i < 4; ++i) members[i] = figure.named(fold.between[i]);
            double whole = 1.0 / 6;
            for (const std::size_t i : {1U, 2U, 3U})
                whole *= distance(position_of<D>(joint_of(body, fold.between[0]), scale),
                                  position_of<D>(joint_of(body, fold.between[i]), scale));
            figure.template constrain<Volume>(fold.name, members,
                                              {.limits = between(fold.min * whole, fold.max * whole)});
        }
}

} // namespace sinew
