#include "files/in/bone_turns.h"

#include "sinew/collide/pose.h"

#include "files/out/rigid_fit.h"

#include <algorithm>
#include <utility>

namespace sinew::files {
namespace {

using Turn = collide::Rotation<3, double>;

Vec3<double> across(const Vec3<double>& v, const Vec3<double>& axis) {
    return v - axis * dot(v, axis);
}

/// Rotation about an axis that brings one unit vector across it to another.
Vec<4, double> turn_about(const Vec3<double>& axis, const Vec3<double>& from, const Vec3<double>& to) {
    if (dot(from, to) < -1 + 1e-9) return {{axis[0], axis[1], axis[2], 0}};
    return shortest_turn(from, to);
}

} // namespace

Vec3<double> turned(const Vec<4, double>& turn, const Vec3<double>& v) {
    return Turn{turn} * v;
}

BoneTurns::BoneTurns(std::vector<BonePoint> points)
    : points_(std::move(points)), children_(points_.size()), turns_(points_.size(), {{0, 0, 0, 1}}) {
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (points_[i].parent) children_[*points_[i].parent].push_back(i);
    for (std::size_t i = 0; i < points_.size(); ++i)
        std::ranges::stable_sort(children_[i], std::greater(),
                                 [&](std::size_t child) { return norm(points_[child].at - points_[i].at); });
}

double BoneTurns::length(std::span<const Vec3<double>> points) const {
    double sum = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (points_[i].parent) sum += norm(points[i] - points[*points_[i].parent]);
    return sum;
}

const std::vector<Vec<4, double>>& BoneTurns::follow(std::span<const Vec3<double>> now) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const auto& before = points_[i].parent ? turns_[*points_[i].parent] : turns_[i];
        turns_[i] = nearest_sign(turn(i, now, before), turns_[i]);
    }
    return turns_;
}

Vec<4, double> BoneTurns::turn(std::size_t i, std::span<const Vec3<double>> now, const Vec<4, double>& before) const {
    if (children_[i].empty()) return before;
    const auto rest = [&](std::size_t child) { return points_[child].at - points_[i].at; };
    const auto bone = [&](std::size_t child) { return now[child] - now[i]; };
    const auto longest = children_[i][0];
    const auto along = direction(bone(longest));
    if (along == Vec3<double>{}) return before;
    const auto bent = product(shortest_turn(direction(turned(before, rest(longest))), along), before);
    const auto side = [&](std::size_t child) { return across(turned(bent, rest(child)), along); };
    const auto widest = *std::ranges::max_element(children_[i], {}, [&](auto child) { return norm(side(child)); });
    const auto from = direction(side(widest)), to = direction(across(bone(widest), along));
    constexpr double least = 1e-3; // of the bone: below, its side is noise
    if (norm(side(widest)) < least * norm(rest(widest)) || to == Vec3<double>{}) return bent;
    return product(turn_about(along, from, to), bent);
}

} // namespace sinew::files
