#pragma once

#include "sinew/solver/cloth/thin_contact.h"

#include <limits>

namespace sinew::detail {

/// Motion of the vertices of thin cloth in a substep, and their travel relative to the mean.
template <class Real> class ThinMotion {
  public:
    using Vector = Vec3<Real>;

    ThinMotion(const World<3, Real>& world, SweepState<3, Real>& state, ThinRoom<3, Real>& room,
               const SubstepSpan<Real>& span)
        : velocity_(world.particles.velocity), state_(state), room_(room), span_(span) {}

    void read() {
        auto& vertices = room_.vertices;
        if (vertices.size() != room_.mesh.size()) vertices.assign(room_.mesh.size(), {}), room_.is_listed = false;
        const Vector shift =
            mean([&](std::size_t i) { return state_.position_at(room_.mesh.slots[i]) - vertices[i].position; });
        room_.drift += shift;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            auto& vertex = vertices[i];
            const Row slot = room_.mesh.slots[i];
            const auto position = state_.position_at(slot), displacement = state_.displacement_at(slot);
            const auto moved = position - vertex.position;
            vertex.last_displacement = position == vertex.position ? displacement : moved;
            vertex.travel += double(norm(moved - shift));
            vertex.position = position, vertex.displacement = displacement, vertex.mobility = state_.mobility[slot];
        }
        look_ahead();
    }
    /// Reads the displacements once more in the same substep.
    void read_displacements() {
        for (std::size_t i = 0; i < room_.vertices.size(); ++i) {
            auto& vertex = room_.vertices[i];
            vertex.displacement = vertex.last_displacement = state_.displacement_at(room_.mesh.slots[i]);
        }
        look_ahead();
    }
    /// Travel until the end of the substep, by the displacements as they are now.
    void look_ahead() {
        const Vector common = mean([&](std::size_t i) { return room_.vertices[i].displacement; });
        room_.ahead.resize(room_.vertices.size());
        largest_ = 0;
        Real sum = 0;
        for (std::size_t i = 0; i < room_.vertices.size(); ++i) {
            const auto& vertex = room_.vertices[i];
            const Real ahead = norm(vertex.displacement - common);
            room_.ahead[i] = vertex.travel + double(ahead);
            largest_ = max(largest_, ahead);
            sum += ahead;
        }
        typical_ = sum / Real(room_.vertices.size());
    }
    /// Largest displacement relative to the mean.
    Real largest() const { return largest_; }
    /// Mean displacement relative to the mean.
    Real typical() const { return typical_; }
    void write() {
        for (std::size_t i = 0; i < room_.vertices.size(); ++i)
            state_.set_displacement(room_.mesh.slots[i], room_.vertices[i].displacement);
    }

    void begin_step() {
        room_.thickest = 0;
        for (const Real half : room_.mesh.half_thickness) room_.thickest = max(room_.thickest, Real(2) * half);
        room_.skin = skin * room_.thickest;
        Real furthest = 0;
        for (const auto& vertex : room_.vertices)
            for (int axis = 0; axis < 3; ++axis) furthest = max(furthest, absolute(vertex.position[axis]));
        room_.min_gap = max(min_gap * room_.thickest, Real(16) * std::numeric_limits<Real>::epsilon() * furthest);
        for (std::size_t i = 0; i < room_.vertices.size(); ++i) {
            auto& vertex = room_.vertices[i];
            vertex.step_began_at = vertex.travel;
            vertex.last_displacement = velocity(i) * span_.h;
        }
        room_.is_calm = is_slow();
    }
    /// True if not more than a few vertices have left the skin in this step.
    bool is_within_skin() const {
        return are_few(
            [&](std::size_t i) { return !(room_.ahead[i] - room_.vertices[i].step_began_at <= double(room_.skin)); });
    }

  private:
    const std::vector<Vector>& velocity_; ///< of the particles
    SweepState<3, Real>& state_;
    ThinRoom<3, Real>& room_;
    SubstepSpan<Real> span_;
    Real largest_ = 0, typical_ = 0;

    /// Skin as a share of the thickness: how far a vertex may be off its forecast. Thickness and two skins stay within
    /// the 0.7 cells between vertices without a face in common.
    static constexpr Real skin = Real(0.2);
    /// Floor under gaps, as a share of the thickness: else each substep takes its share of the rest, down to rounding.
    static constexpr Real min_gap = Real(0.004);
    static constexpr std::size_t few = 20; ///< the few are this part of all

    const Vector& velocity(std::size_t i) const { return velocity_[state_.row_of[room_.mesh.slots[i]]]; }
    template <class Of> Vector mean(Of&& of) const {
        Vector sum{};
        for (std::size_t i = 0; i < room_.vertices.size(); ++i) sum += of(i);
        return sum * (Real(1) / Real(room_.vertices.size()));
    }
    template <class Test> bool are_few(Test&& test) const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < room_.vertices.size(); ++i) count += test(i);
        return count * few <= room_.vertices.size();
    }
    /// By the velocities before the step: links pull and contacts push back within a substep, even at rest.
    bool is_slow() const {
        const Vector common = mean([&](std::size_t i) { return velocity(i); });
        const Real slow = Real(0.5) * room_.skin / (span_.h * Real(span_.count));
        return are_few([&](std::size_t i) { return !(norm(velocity(i) - common) <= slow); });
    }
};

} // namespace sinew::detail
