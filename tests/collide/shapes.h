#pragma once

#include "sinew/collide/shape.h"
#include "sinew/math/random.h"

#include <gtest/gtest.h>

/// Random shapes, placements and points for tests of contacts.
namespace sinew::collide::test {

/// Numbers drawn one after the other from a seed.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : seed_(seed) {}
    double between(double low, double high) { return low + (high - low) * random::uniform(seed_, 0, count_++); }
    template <int D> Vec<D, double> point(double size) {
        return Vec<D, double>::map([&](int) { return between(-size, size); });
    }
    template <int D> Pose<D, double> pose() {
        if constexpr (D == 2)
            return {point<2>(2), Rotation<2, double>::of(between(-4, 4))};
        else
            return {point<3>(2), Rotation<3, double>::of(point<3>(1), between(-4, 4))};
    }

  private:
    std::uint64_t seed_, count_ = 0;
};

/// Convex shapes of a dimension, each with `inside`: true for points of the solid.
template <int D> struct Sample {
    Shape<D, double> shape;
    bool (*inside)(const Vec<D, double>& local);
};

inline Polygon<2, double> pentagon() {
    return {{{{0.5, -0.6}}, {{1.2, 0.1}}, {{0.4, 0.9}}, {{-0.7, 0.5}}, {{-0.8, -0.4}}}};
}

template <int D> std::vector<Sample<D>> convex_shapes() {
    using V = Vec<D, double>;
    std::vector<Sample<D>> shapes = {
        {HalfSpace<D, double>{direction(V::axis(0) + V::axis(1) * 2.0), 0.3},
         [](const V& p) { return dot(direction(V::axis(0) + V::axis(1) * 2.0), p) <= 0.3; }},
        {Sphere<D, double>{0.7}, [](const V& p) { return norm(p) <= 0.7; }},
        {Capsule<D, double>{V::axis(0) * -0.8, V::axis(0) * 0.6, 0.4},
         [](const V& p) { return norm(p - V::axis(0) * clamp(p[0], -0.8, 0.6)) <= 0.4; }},
        {Box<D, double>{V::map([](int i) { return 0.8 + 0.6 * i; })},
         [](const V& p) {
             for (int i = 0; i < D; ++i)
                 if (absolute(p[i]) > 0.4 + 0.3 * i) return false;
             return true;
         }},
    };
    if constexpr (D == 2)
        shapes.push_back({pentagon(), [](const V& p) {
                              const auto c = pentagon().corners;
                              for (std::size_t i = 0; i < c.size(); ++i)
                                  if (cross(c[(i + 1) % c.size()] - c[i], p - c[i]) < 0) return false;
                              return true;
                          }});
    return shapes;
}

template <int D>
SurfacePoint<D, double> nearest_of(const Shape<D, double>& shape, const Pose<D, double>& pose,
                                   const Vec<D, double>& point) {
    return *nearest(shape, pose, point, 1e6);
}

template <int D> void each_convex_placement(int placements, auto&& check) {
    Dice dice(D);
    for (const auto& sample : convex_shapes<D>())
        for (int i = 0; i < placements; ++i) check(sample, dice.pose<D>(), dice);
}

} // namespace sinew::collide::test
