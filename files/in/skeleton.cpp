#include "files/in/skeleton.h"

#include "sinew/scene/text.h"

#include "files/in/humanoid.h"
#include "files/in/json_building.h"
#include "files/in/names.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace sinew::files {
namespace {

struct RagdollParticle {
    std::string name, place;
    BodyPart part = BodyPart::other;
    std::optional<std::size_t> parent;
    Vec3<double> at{};
    double mass = 0, radius = 0;
};

class RagdollBuilder {
  public:
    RagdollBuilder(const std::vector<SkeletonJoint>& joints, double scale, Notes& notes) : notes_(notes) {
        for (const auto& joint : joints) numbers_.push_back(add_joint(joint, numbers_, scale));
        joints_ = particles_.size();
        add_tips();
        children_.resize(particles_.size());
        for (std::size_t i = 0; i < particles_.size(); ++i)
            if (particles_[i].parent) children_[*particles_[i].parent].push_back(i);
        set_masses();
    }

    std::size_t size() const { return particles_.size(); }

    JointParticles joint_particles() const {
        JointParticles result;
        std::size_t fresh = 0; // particles are in the order of their joints
        for (const auto number : numbers_) {
            result.names.push_back(number ? particles_[*number].name : "");
            result.is_own.push_back(number == fresh && fresh < joints_);
            if (result.is_own.back()) ++fresh;
        }
        return result;
    }

    json::Object figure(const std::string& name) {
        for (std::size_t i = 0; i < particles_.size(); ++i) link(i);
        for (std::size_t i = 0; i < particles_.size(); ++i) limit(i);
        return {{"name", name},
                {"internal_damping", 1},
                {"contact", json::Object{{"figures", true}}},
                {"particles", particles()},
                {"constraints", std::move(constraints_)},
                {"pieces", pieces()},
                {"looks", looks()}};
    }

  private:
    Notes& notes_;
    std::vector<std::optional<std::size_t>> numbers_; ///< particles by joint
    std::size_t joints_ = 0;                          ///< particles of joints, before those of tips
    std::vector<RagdollParticle> particles_;
    std::vector<std::vector<std::size_t>> children_;
    NewNames names_;
    std::set<std::pair<std::size_t, std::size_t>> linked_;
    json::Array constraints_;

    /// Number of the joint's particle; that of its parent, where the two are at one place.
    std::optional<std::size_t> add_joint(const SkeletonJoint& joint,
                                         const std::vector<std::optional<std::size_t>>& numbers, double scale) {
        const auto parent = joint.parent ? numbers[*joint.parent] : std::nullopt;
        const auto part = body_part(joint.name);
        const bool is_finger = part == BodyPart::finger || (parent && particles_[*parent].part == BodyPart::toes);
        if (is_finger)
            return notes_.count(joint.place, "joints of fingers and toes are part of the hand and the foot"), parent;
        const auto at = joint.at * scale;
        if (parent && distance(particles_[*parent].at, at) < 1e-4)
            return notes_.count(joint.place, "joints at the place of their parent are one with it"), parent;
        particles_.push_back({names_.take(joint.name, "joint"), joint.place, part, parent, at});
        return particles_.size() - 1;
    }

    /// glTF tells where a bone begins; heads, hands and feet without a child get an end, in line with the bone before.
    void add_tips() {
        const auto joints = particles_.size();
        std::vector<bool> has_child(joints);
        for (const auto& particle : particles_)
            if (particle.parent) has_child[*particle.parent] = true;
        for (std::size_t i = 0; i < joints; ++i) {
            const auto part = particles_[i].part;
            const bool ends = part == BodyPart::head || part == BodyPart::hand || part == BodyPart::foot;
            if (has_child[i] || !particles_[i].parent) continue;
            if (!ends) {
                notes_.count(particles_[i].place,
                             "the last bone of a chain has no length in glTF: it ends where it begins");
                continue;
            }
            const auto bone = particles_[i].at - particles_[*particles_[i].parent].at;
            constexpr double share = 0.5;
            const auto name = names_.take(particles_[i].name + "_end", "end"), place = particles_[i].place;
            particles_.push_back({name, place, BodyPart::other, i, particles_[i].at + bone * share});
        }
    }

    double bone_length(std::size_t i) const {
        return particles_[i].parent ? distance(particles_[i].at, particles_[*particles_[i].parent].at) : 0;
    }

    double height() const {
        if (particles_.empty()) return 0;
        double low = particles_[0].at[1], high = low;
        for (const auto& p : particles_) low = std::min(low, p.at[1]), high = std::max(high, p.at[1]);
        double longest = high - low;
        for (const auto& p : particles_) longest = std::max(longest, distance(p.at, particles_[0].at));
        return longest;
    }

    /// 70 kg for a height of 1.7 m, by its cube, divided between bones by length; each end has half of a bone's.
    void set_masses() {
        constexpr double usual_mass = 70, usual_height = 1.7, thickness = 0.035;
        const double total = std::clamp(usual_mass * std::pow(height() / usual_height, 3), 1e-3, 1e6);
        double length = 0;
        for (std::size_t i = 0; i < particles_.size(); ++i) length += bone_length(i);
        for (std::size_t i = 0; i < particles_.size(); ++i)
            if (particles_[i].parent) {
                const double half = total * bone_length(i) / length / 2;
                particles_[i].mass += half, particles_[*particles_[i].parent].mass += half;
            }
        for (std::size_t i = 0; i < particles_.size(); ++i) {
            double shortest = particles_[i].parent ? bone_length(i) : height();
            for (const auto child : children_[i]) shortest = std::min(shortest, bone_length(child));
            particles_[i].radius = std::min(thickness * height(), 0.4 * std::max(shortest, 0.02 * height()));
        }
    }

    void add_distance(std::size_t a, std::size_t b, bool is_bone, std::optional<double> slack = {}) {
        if (!linked_.insert({std::min(a, b), std::max(a, b)}).second) return;
        const double length = distance(particles_[a].at, particles_[b].at);
        if (length < 1e-4) return;
        json::Object constraint{{"between", json::Array{particles_[a].name, particles_[b].name}}};
        if (is_bone) constraint.insert(constraint.begin(), {"name", concat("bone_", particles_[b].name)});
        if (slack) constraint.push_back({"low", rounded_number(length * (1 - *slack))});
        if (slack) constraint.push_back({"high", rounded_number(length * (1 + *slack))});
        constraint.push_back({"hidden", true});
        constraints_.push_back(std::move(constraint));
    }

    /// A bone with several bones at its end is stiff: distances to three of its points hold a further one.
    void link(std::size_t i) {
        const auto& children = children_[i];
        for (const auto child : children) add_distance(i, child, true);
        for (std::size_t k = 1; k < children.size(); ++k)
            for (std::size_t j = k < 3 ? 0 : k - 3; j < k; ++j) add_distance(children[j], children[k], false);
        if (children.size() > 1) limit_twist(i);
    }

    /// Two stiff bones of a trunk, such as pelvis and chest, twist little against each other.
    void limit_twist(std::size_t i) {
        auto above = particles_[i].parent;
        while (above && children_[*above].size() < 2) above = particles_[*above].parent;
        if (!above) return;
        constexpr double slack = 0.15;
        for (const auto child : children_[i]) {
            const auto nearest = std::ranges::min_element(children_[*above], {}, [&](auto other) {
                return other == i ? 1e9 : distance(particles_[other].at, particles_[child].at);
            });
            if (*nearest != i && !is_above(*nearest, i)) add_distance(*nearest, child, false, slack);
        }
    }
    bool is_above(std::size_t ancestor, std::size_t i) const {
        for (auto at = std::optional(i); at; at = particles_[*at].parent)
            if (*at == ancestor) return true;
        return false;
    }

    /// Bend at a joint, between the bone before and its longest bone.
    void limit(std::size_t i) {
        if (!particles_[i].parent || children_[i].empty()) return;
        const auto child = *std::ranges::max_element(children_[i], {}, [&](auto c) { return bone_length(c); });
        const auto before = particles_[i].at - particles_[*particles_[i].parent].at,
                   after = particles_[child].at - particles_[i].at;
        const double bend =
            std::acos(std::clamp(dot(before, after) / (norm(before) * norm(after)), -1.0, 1.0)) * (180 / pi<double>);
        const auto range = joint_limit(particles_[i].part);
        const double low = range.is_hinge ? 0 : std::max(bend - range.range, 0.0);
        const double high = std::min(range.is_hinge ? std::max(range.range, bend) : bend + range.range, 180.0);
        if (low <= 0 && high >= 180) return;
        json::Object angle{{"name", concat("joint_", particles_[i].name)},
                           {"kind", "angle"},
                           {"between", json::Array{particles_[*particles_[i].parent].name, particles_[i].name,
                                                   particles_[child].name}}};
        if (low > 0) angle.push_back({"low", rounded_number(std::floor(low * 10) / 10)});
        if (high < 180) angle.push_back({"high", rounded_number(std::ceil(high * 10) / 10)});
        constraints_.push_back(std::move(angle));
    }

    json::Object particles() const {
        json::Object list;
        for (const auto& p : particles_)
            list.push_back({p.name, json::Object{{"at", point_json(p.at)},
                                                 {"mass", rounded_number(std::max(p.mass, 1e-6))},
                                                 {"radius", rounded_number(p.radius)}}});
        return list;
    }

    bool has_skull(std::size_t i) const { return particles_[i].part == BodyPart::head && !children_[i].empty(); }

    json::Array pieces() const {
        json::Array list;
        for (std::size_t i = 0; i < particles_.size(); ++i) {
            if (!particles_[i].parent) continue;
            const auto& from = particles_[*particles_[i].parent];
            list.push_back(json::Object{{"mark", "stroke"},
                                        {"part", "bone"},
                                        {"through", json::Array{from.name, particles_[i].name}},
                                        {"width", rounded_number(2 * from.radius)},
                                        {"end_width", rounded_number(1.6 * particles_[i].radius)}});
        }
        for (std::size_t i = 0; i < particles_.size(); ++i)
            if (has_skull(i))
                list.push_back(json::Object{
                    {"mark", "dot"},
                    {"part", "skull"},
                    {"through", json::Array{particles_[children_[i][0]].name}},
                    {"width", rounded_number(1.2 * std::max(bone_length(children_[i][0]), 0.07 * height()))}});
        return list;
    }

    json::Object looks() const {
        json::Object looks{{"all", json::Object{{"hidden", true}}}, {"bone", json::Object{{"hidden", false}}}};
        for (std::size_t i = 0; i < particles_.size(); ++i)
            if (has_skull(i)) return looks.push_back({"skull", json::Object{{"hidden", false}}}), looks;
        return looks;
    }
};

} // namespace

json::Object ragdoll_of(const std::vector<SkeletonJoint>& joints, const std::string& name, double scale, Notes& notes) {
    RagdollBuilder builder(joints, scale, notes);
    if (builder.size() < 2) return {};
    return builder.figure(name);
}

JointParticles joint_particles(const std::vector<SkeletonJoint>& joints, double scale) {
    Notes notes;
    return RagdollBuilder(joints, scale, notes).joint_particles();
}

} // namespace sinew::files
