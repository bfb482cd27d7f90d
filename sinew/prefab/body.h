#pragma once

#include "sinew/prefab/builder.h"

#include <array>
#include <span>
#include <string_view>

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

struct Body {
    std::span<const Joint> joints;
    std::span<const Bone> bones;
    std::span<const Bend> bends;

    Sizes sizes() const { return {.particles = joints.size(), .constraints = bones.size() + bends.size()}; }
};

constexpr bool shares_are_whole(std::span<const Joint> joints, Rig rig) {
    double sum = 0;
    for (const auto& joint : joints)
        if (joint.rig == Rig::both || joint.rig == rig) sum += joint.share;
    return absolute(sum - 100) < 1e-9;
}

/// Builds the rows of a body that belong to the builder's mode.
template <int D, class Real> void build_body(Builder<D, Real>& figure, const Body& body, double scale, double mass) {
    const auto belongs = [&](Rig rig) {
        return rig == Rig::both || (rig == Rig::classic) == (figure.mode() == Mode::classic);
    };
    for (const auto& [name, x, y, share, radius, rig] : body.joints)
        if (belongs(rig))
            figure.particle(name, on_screen<D>(scale * x, -scale * y), mass * share / 100, scale * radius);

    for (const auto& bone : body.bones) {
        if (!belongs(bone.rig)) continue;
        const double width = figure.mode() == Mode::classic ? bone.classic_width : bone.width;
        const auto from = figure.named(bone.from), to = figure.named(bone.to);
        const std::array ends{from, to};
        const double length = figure.template measure<Distance>(ends);
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
}

} // namespace sinew
