#include "sinew/prefab/ragdoll.h"

#include "sinew/prefab/ragdoll_rigs.h"

namespace sinew {
namespace ragdoll_flesh {
namespace {

constexpr double tallness = 160;
// Widths of flesh.
constexpr double torso = 14, hip = 14, ankle = 8, elbow = 9, sleeve = 12, bare_elbow = 8, wrist = 6;
constexpr double head_size = 29, hand_size = 9, foot_size = 12;

// Turns that the joint limits of the plane and those of space allow. Up is away from the feet.
constexpr std::array star{PoseTurn{"left_shoulder", -35}, PoseTurn{"right_shoulder", 35}, PoseTurn{"left_hip", -20},
                          PoseTurn{"right_hip", 20}};
constexpr std::array hands_up{PoseTurn{"left_shoulder", -90}, PoseTurn{"right_shoulder", 90}};
constexpr std::array dancing{PoseTurn{"left_shoulder", -80}, PoseTurn{"right_shoulder", -30}, PoseTurn{"left_hip", -45},
                             PoseTurn{"left_knee", 40}};

std::span<const PoseTurn> turns_of(std::string_view pose) {
    if (pose == "star") return star;
    if (pose == "hands_up") return hands_up;
    if (pose == "dancing") return dancing;
    return {};
}

double girth_of(std::string_view build) {
    constexpr double slim = 0.8, heavy = 1.35;
    return build == "slim" ? slim : build == "heavy" ? heavy : 1;
}

template <int D, class Real>
std::vector<ParticleId> all_named(Builder<D, Real>& figure, std::initializer_list<std::string_view> names) {
    std::vector<ParticleId> particles;
    for (const auto name : names) particles.push_back(figure.named(name));
    return particles;
}

template <int D, class Real> void draw_head(Builder<D, Real>& figure, double scale) {
    figure.draw(Mark::dot, "head", all_named(figure, {"head"}), scale * head_size);
    figure.draw(Mark::face, "face", all_named(figure, {"left_shoulder", "right_shoulder", "neck", "head"}),
                scale * head_size);
}

/// Flesh on the bones, back to front: legs, trunk, arms.
template <int D, class Real> void draw_flesh(Builder<D, Real>& figure, double scale, double girth) {
    const auto named = [&](std::initializer_list<std::string_view> names) { return all_named(figure, names); };
    const auto limb = [&](std::string_view part, std::initializer_list<std::string_view> names, double from,
                          double to) {
        figure.draw_tapered(Mark::stroke, part, named(names), scale * girth * from, scale * girth * to);
    };
    for (const auto* foot : {"left_foot", "right_foot"})
        figure.draw(Mark::dot, "foot", named({foot}), scale * foot_size);
    limb("leg", {"left_hip", "left_knee", "left_foot"}, hip, ankle);
    limb("leg", {"right_hip", "right_knee", "right_foot"}, hip, ankle);
    const auto trunk = named({"left_shoulder", "right_shoulder", "right_hip", "left_hip"});
    figure.draw(Mark::fill, "torso", trunk);
    figure.draw(Mark::loop, "torso", trunk, scale * girth * torso);
    figure.draw(Mark::stroke, "belt", named({"left_hip", "right_hip"}), scale * girth * hip);
    limb("arm", {"left_elbow", "left_hand"}, bare_elbow, wrist);
    limb("arm", {"right_elbow", "right_hand"}, bare_elbow, wrist);
    for (const auto* hand : {"left_hand", "right_hand"})
        figure.draw(Mark::dot, "hand", named({hand}), scale * hand_size);
    limb("sleeve", {"left_shoulder", "left_elbow"}, sleeve, elbow);
    limb("sleeve", {"right_shoulder", "right_elbow"}, sleeve, elbow);
}

} // namespace
} // namespace ragdoll_flesh

Sizes Ragdoll::sizes() const {
    const auto flat = ragdoll_in_plane::body.sizes(), deep = ragdoll_in_space::body.sizes();
    return {.particles = std::max(flat.particles, deep.particles),
            .constraints = std::max(flat.constraints, deep.constraints)};
}

template <int D, class Real> void Ragdoll::build(Builder<D, Real>& figure) const {
    using namespace ragdoll_flesh;
    const double scale = height / tallness, girth = girth_of(stature);
    const bool classic = figure.mode() == Mode::classic;
    build_body(figure, D == 2 ? ragdoll_in_plane::body : ragdoll_in_space::body, scale, mass, turns_of(pose));
    if (!classic) draw_flesh(figure, scale, girth);
    if (D == 3 || !classic) draw_head(figure, scale);
}

#define SINEW_RAGDOLL(D, Real) template void Ragdoll::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_RAGDOLL)

} // namespace sinew
