#include "bench/bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::bench {
namespace {

using Vector = Bodies::Vector;

class BodyFinder {
  public:
    explicit BodyFinder(const ContactWork& work)
        : work_(work), neighbours_(work.particles.size()), bodies_at_(work.particles.size()) {
        for (const auto& stick : work.sticks) {
            neighbours_[stick.a].push_back(stick.b);
            neighbours_[stick.b].push_back(stick.a);
        }
    }

    Bodies run() {
        for (const auto& stick : work_.sticks)
            if (!share_body(stick.a, stick.b)) add_rigid(stick.a, stick.b);
        for (const auto& stick : work_.sticks)
            if (!share_body(stick.a, stick.b)) add_body({stick.a, stick.b});
        for (std::uint32_t i = 0; i < work_.particles.size(); ++i)
            if (bodies_at_[i].empty()) add_body({i});
        for (auto& body : found_.bodies) weigh(body);
        for (const auto& outline : work_.outlines) add_shape(outline.corners);
        add_discs();
        add_joints();
        return std::move(found_);
    }

  private:
    const ContactWork& work_;
    std::vector<std::vector<std::uint32_t>> neighbours_, bodies_at_;
    Bodies found_;

    Vector position(std::uint32_t particle) const { return cast<double>(work_.particles[particle].position); }
    bool are_linked(std::uint32_t a, std::uint32_t b) const {
        return std::ranges::find(neighbours_[a], b) != neighbours_[a].end();
    }
    /// First body that has both, or the number of bodies.
    std::uint32_t body_of(std::uint32_t a, std::uint32_t b) const {
        for (const auto body : bodies_at_[a])
            if (std::ranges::find(bodies_at_[b], body) != bodies_at_[b].end()) return body;
        return std::uint32_t(found_.bodies.size());
    }
    bool share_body(std::uint32_t a, std::uint32_t b) const { return body_of(a, b) < found_.bodies.size(); }

    void add_body(std::vector<std::uint32_t> members) {
        Bodies::Body body{.figure = work_.particles[members.front()].body};
        for (const auto particle : members) {
            bodies_at_[particle].push_back(std::uint32_t(found_.bodies.size()));
            body.points.push_back({particle});
        }
        found_.bodies.push_back(std::move(body));
    }

    /// A triangle on a link, and all that two links or more tie to it.
    void add_rigid(std::uint32_t a, std::uint32_t b) {
        std::vector<std::uint32_t> members{a, b};
        const auto ties = [&](std::uint32_t particle) {
            return std::ranges::count_if(members, [&](auto member) { return are_linked(member, particle); });
        };
        for (std::size_t i = 0; i < members.size(); ++i)
            for (const auto near : neighbours_[members[i]])
                if (std::ranges::find(members, near) == members.end() && ties(near) >= 2) {
                    members.push_back(near);
                    i = 0;
                }
        if (members.size() > 2) add_body(std::move(members));
    }

    void weigh(Bodies::Body& body) {
        const auto share = [&](const Bodies::Point& point) {
            return double(work_.particles[point.particle].mass) / double(bodies_at_[point.particle].size());
        };
        for (const auto& point : body.points)
            body.mass += share(point), body.center += position(point.particle) * share(point);
        body.center *= 1 / body.mass;
        for (auto& point : body.points) {
            point.from_center = position(point.particle) - body.center;
            const double radius = work_.particles[point.particle].radius;
            body.inertia += share(point) * (dot(point.from_center, point.from_center) + radius * radius / 2);
        }
    }

    void add_shape(const std::vector<std::uint32_t>& corners) {
        Bodies::Shape shape{.body = body_of(corners[0], corners[1]), .radius = std::numeric_limits<double>::infinity()};
        for (const auto corner : corners) {
            shape.corners.push_back(position(corner) - found_.bodies[shape.body].center);
            shape.radius = std::min(shape.radius, double(work_.particles[corner].radius));
        }
        found_.shapes.push_back(std::move(shape));
    }
    /// Particles wider than the outlines at them, or without one.
    void add_discs() {
        std::vector<double> covered(work_.particles.size(), 0);
        for (std::size_t i = 0; i < work_.outlines.size(); ++i)
            for (const auto corner : work_.outlines[i].corners)
                covered[corner] = std::max(covered[corner], found_.shapes[i].radius);
        for (std::uint32_t i = 0; i < work_.particles.size(); ++i) {
            const auto body = bodies_at_[i].front();
            const double radius = work_.particles[i].radius;
            if (radius > covered[i])
                found_.shapes.push_back(
                    {.body = body, .corners = {position(i) - found_.bodies[body].center}, .radius = radius});
        }
    }

    void add_joints() {
        for (std::uint32_t i = 0; i < work_.particles.size(); ++i) {
            double shortest = std::numeric_limits<double>::infinity();
            for (const auto near : neighbours_[i]) shortest = std::min(shortest, distance(position(i), position(near)));
            const auto& at = bodies_at_[i];
            for (std::size_t k = 1; k < at.size(); ++k)
                found_.joints.push_back({.a = at[0],
                                         .b = at[k],
                                         .on_a = position(i) - found_.bodies[at[0]].center,
                                         .on_b = position(i) - found_.bodies[at[k]].center,
                                         .length = shortest});
        }
    }
};

} // namespace

Bodies bodies_of(const ContactWork& work) {
    return BodyFinder(work).run();
}

std::vector<Vector> positions_of(const ContactWork& work, const Bodies& bodies, const BodySimulation& simulation) {
    std::vector<Vector> positions(work.particles.size());
    for (auto body = std::uint32_t(bodies.bodies.size()); body-- > 0;)
        for (const auto& point : bodies.bodies[body].points)
            positions[point.particle] = simulation.position(body, point.from_center);
    return positions;
}

ContactState look_at(const ContactWork& work, const Bodies& bodies, const BodySimulation& simulation,
                     std::span<const Vector> before) {
    const auto positions = positions_of(work, bodies, simulation);
    ContactState state;
    for (const auto& joint : bodies.joints)
        state.longest = std::max(state.longest, distance(simulation.position(joint.a, joint.on_a),
                                                         simulation.position(joint.b, joint.on_b)) /
                                                    joint.length);
    for (std::size_t i = 0; i < positions.size(); ++i)
        state.speed += distance(positions[i], before[i]) / frame / double(positions.size());
    state.is_lost = !std::isfinite(state.speed) || !std::isfinite(state.longest);
    state.crossed = crossed_sides(work, positions);
    return state;
}

} // namespace sinew::bench
