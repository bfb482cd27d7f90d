#include "files/out/joint_skin.h"

#include "sinew/collide/pose.h"
#include "sinew/math/scalar.h"

#include "files/out/rigid_fit.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace sinew::files {
namespace {

constexpr auto influences = JointSkin::influences;
using Turn = collide::Rotation<3, double>;
using Gram = std::array<std::array<double, influences>, influences>;
using Nearest = std::array<std::size_t, influences>;

class Skinner {
  public:
    Skinner(const FaceMesh& mesh, const MeshFilm& film, std::size_t joints) : mesh_(mesh), film_(film) {
        spread(std::min(joints, mesh.vertices.size()));
        for (const auto seat : seats_) add_joint(seat);
    }

    JointSkin skin() {
        for (const auto vertex : mesh_.vertices) bind(vertex);
        skin_.mean /= double(mesh_.vertices.size() * film_.frames());
        return std::move(skin_);
    }

  private:
    const FaceMesh& mesh_;
    const MeshFilm& film_;
    std::vector<std::uint32_t> seats_; ///< vertices of the film
    JointSkin skin_;

    double apart(std::uint32_t a, std::uint32_t b) const { return norm(film_.position(0, a) - film_.position(0, b)); }

    /// Farthest-point sampling (Gonzalez 1985): each seat is the vertex furthest from those before.
    void spread(std::size_t count) {
        std::vector<double> gaps(mesh_.vertices.size(), std::numeric_limits<double>::infinity());
        std::size_t next = 0;
        while (seats_.size() < count && gaps[next] > 0) {
            seats_.push_back(mesh_.vertices[next]);
            for (std::size_t i = 0; i < gaps.size(); ++i)
                gaps[i] = min(gaps[i], apart(seats_.back(), mesh_.vertices[i]));
            next = std::size_t(std::ranges::max_element(gaps) - gaps.begin());
        }
    }

    /// The vertices nearest to a seat: enough for a plane, and its share of the mesh.
    std::vector<std::uint32_t> around(std::uint32_t seat) const {
        constexpr std::size_t least = 5;
        auto near = mesh_.vertices;
        const auto count = std::min(near.size(), std::max(least, near.size() / seats_.size()));
        std::ranges::partial_sort(near, near.begin() + std::ptrdiff_t(count), {},
                                  [&](auto vertex) { return apart(seat, vertex); });
        near.resize(count);
        return near;
    }

    void add_joint(std::uint32_t seat) {
        const auto motion = rigid_motion(film_, around(seat), std::numeric_limits<double>::infinity());
        NodeMotion joint;
        for (std::size_t frame = 0; frame < film_.frames(); ++frame) {
            joint.translation.push_back(motion ? motion->center[frame] : film_.position(frame, seat));
            joint.rotation.push_back(motion ? motion->rotation[frame] : Turn{}.number);
        }
        skin_.joints.push_back(std::move(joint));
    }

    Nearest nearest_joints(std::uint32_t vertex) const {
        std::vector<std::size_t> order(skin_.joints.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
        const auto count = std::min(influences, order.size());
        std::ranges::partial_sort(order, order.begin() + std::ptrdiff_t(count), {},
                                  [&](std::size_t joint) { return apart(seats_[joint], vertex); });
        Nearest nearest{};
        for (std::size_t k = 0; k < influences; ++k) nearest[k] = order[std::min(k, count - 1)];
        return nearest;
    }

    /// Displacements of a vertex from its place at a frame, if it followed one joint alone.
    std::array<Vec3<double>, influences> misses(std::uint32_t vertex, const Nearest& joints, std::size_t frame) const {
        std::array<Vec3<double>, influences> all{};
        for (std::size_t k = 0; k < influences; ++k) {
            const auto& joint = skin_.joints[joints[k]];
            all[k] = joint.translation[frame] +
                     Turn{joint.rotation[frame]} * (film_.position(0, vertex) - joint.translation[0]) -
                     film_.position(frame, vertex);
        }
        return all;
    }

    void bind(std::uint32_t vertex) {
        const auto joints = nearest_joints(vertex);
        Gram gram{};
        for (std::size_t frame = 0; frame < film_.frames(); ++frame) {
            const auto miss = misses(vertex, joints, frame);
            for (std::size_t a = 0; a < influences; ++a)
                for (std::size_t b = 0; b < influences; ++b) gram[a][b] += dot(miss[a], miss[b]);
        }
        const auto weights = least_weights(gram);
        JointSkin::Vertex bound;
        for (std::size_t k = 0; k < influences; ++k)
            bound.joints[k] = std::uint16_t(weights[k] > 0 ? joints[k] : 0), bound.weights[k] = float(weights[k]);
        skin_.vertices.push_back(bound);
        for (std::size_t frame = 0; frame < film_.frames(); ++frame) {
            const auto miss = misses(vertex, joints, frame);
            Vec3<double> sum{};
            for (std::size_t k = 0; k < influences; ++k) sum += miss[k] * weights[k];
            skin_.error = max(skin_.error, norm(sum)), skin_.mean += norm(sum);
        }
    }

    /// Minimum of w G w over weights from 0 on whose sum is 1: one pair after the other, exactly (Platt 1998).
    static std::array<double, influences> least_weights(const Gram& gram) {
        std::array<double, influences> w{1, 0, 0, 0};
        constexpr int rounds = 50;
        for (int round = 0; round < rounds; ++round)
            for (std::size_t a = 0; a < influences; ++a)
                for (std::size_t b = 0; b < a; ++b) {
                    double slope = 0;
                    for (std::size_t k = 0; k < influences; ++k) slope += (gram[a][k] - gram[b][k]) * w[k];
                    const double bend = gram[a][a] + gram[b][b] - 2 * gram[a][b];
                    const double step = clamp(-slope * inverse_or_zero(bend), -w[a], w[b]);
                    w[a] += step, w[b] -= step;
                }
        double sum = 0;
        for (auto& weight : w) sum += weight = weight < 1e-4 ? 0 : weight;
        for (auto& weight : w) weight /= sum;
        return w;
    }
};

} // namespace

JointSkin joint_skin(const FaceMesh& mesh, const MeshFilm& film, std::size_t joints) {
    return Skinner(mesh, film, joints).skin();
}

} // namespace sinew::files
