#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <span>

namespace sinew::detail {

/// Box around the places that a body passes over in a step, as far as its present velocities tell, and its speed.
template <int D, class Real> struct BodyBox {
    collide::BoundingBox<D, Real> box;
    Vec<D, Real> slowest = Vec<D, Real>::map([](int) { return collide::BoundingBox<D, Real>::huge; });
    Vec<D, Real> fastest = Vec<D, Real>::map([](int) { return -collide::BoundingBox<D, Real>::huge; });
    Real widest = 0; ///< radius
};

/// Boxes of bodies, several components side by side where the rows of a body are consecutive.
template <int D, class Real> class BodyBoxes {
  public:
    using Vector = Vec<D, Real>;
    BodyBoxes(const Particles<D, Real>& p, Real dt) : p_(p), dt_(dt) {}

    /// `rows` in ascending order.
    BodyBox<D, Real> of(std::span<const Row> rows) const {
        BodyBox<D, Real> body;
        std::size_t done = 0;
        if (rows.back() - rows.front() + 1 == rows.size()) done = include_abreast(body, rows.front(), rows.size());
        for (; done < rows.size(); ++done) include(body, rows[done]);
        body.box = body.box.grown(body.widest);
        return body;
    }

  private:
    const Particles<D, Real>& p_;
    Real dt_;

    static constexpr std::size_t width = 12, particles = width / D; ///< components and particles side by side
    struct Pack {
        std::array<Real, width> low, high, slowest, fastest;
    };

    void include(BodyBox<D, Real>& body, Row row) const {
        include(body, p_.position[row], p_.velocity[row]);
        body.widest = max(body.widest, p_.radius[row]);
    }
    void include(BodyBox<D, Real>& body, const Vector& position, const Vector& velocity) const {
        body.box.include(position);
        body.box.include(position + velocity * dt_);
        for (int i = 0; i < D; ++i) {
            body.slowest[i] = min(body.slowest[i], velocity[i]);
            body.fastest[i] = max(body.fastest[i], velocity[i]);
        }
    }

    /// Returns the number of particles included.
    std::size_t include_abreast(BodyBox<D, Real>& body, Row first, std::size_t count) const {
        if (count < particles) return 0;
        const Real* position = p_.position[first].component.data();
        const Real* velocity = p_.velocity[first].component.data();
        Pack pack;
        pack.low.fill(BodyBox<D, Real>{}.box.huge), pack.high.fill(-BodyBox<D, Real>{}.box.huge);
        pack.slowest = pack.low, pack.fastest = pack.high;
        const auto whole = count / particles;
        for (std::size_t i = 0; i < whole; ++i) {
            for (std::size_t k = 0; k < width; ++k) {
                const Real x = position[i * width + k], v = velocity[i * width + k], y = x + v * dt_;
                pack.low[k] = min(pack.low[k], min(x, y)), pack.high[k] = max(pack.high[k], max(x, y));
                pack.slowest[k] = min(pack.slowest[k], v), pack.fastest[k] = max(pack.fastest[k], v);
            }
        }
        for (std::size_t k = 0; k < width; ++k) {
            const int axis = int(k % D);
            body.box.low[axis] = min(body.box.low[axis], pack.low[k]);
            body.box.high[axis] = max(body.box.high[axis], pack.high[k]);
            body.slowest[axis] = min(body.slowest[axis], pack.slowest[k]);
            body.fastest[axis] = max(body.fastest[axis], pack.fastest[k]);
        }
        const auto* radius = p_.radius.data() + first;
        for (std::size_t i = 0; i < whole * particles; ++i) body.widest = max(body.widest, radius[i]);
        return whole * particles;
    }
};

} // namespace sinew::detail
