#pragma once

#include "sinew/solver/phases.h"
#include "sinew/world/colliders.h"

#include "tests/any_figure.h"
#include "tests/worlds.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

/// Figures of any kinds that fall on each other, with restitution and friction, in a room with a floor, on tiles, on a
/// landscape, on a mesh.
namespace sinew::test {

template <int D, class Real> class Heap {
  public:
    using V = Vec<D, Real>;

    explicit Heap(std::uint64_t seed) : dice_(seed) {
        world_.settings.substeps = dice_.one_of(2) ? 0 : int(dice_.scale(1, 33));
        world_.settings.iterations = dice_.one_of(2) ? 1 : 1 + dice_.below(4);
        world_.forces.push_back(Gravity<D, Real>{V::axis(1) * Real(-gravity)});
        drop_figures();
        while (!world_.pins.empty()) unpin_all(world_, world_.pins[0].particle);
        set_contacts();
        build_room();
        throw_figures();
        text_ << "\n substeps " << world_.settings.substeps << ", iterations " << world_.settings.iterations;
    }
    std::string text() const { return text_.str(); }

    Stepped<D, Real>& world() { return world_; }

  private:
    Stepped<D, Real> world_;
    Dice dice_;
    std::ostringstream text_;
    double widest_ = 0;
    Real bounce_ = 0, friction_ = 0; ///< of the room

    /// Two to six figures of any kinds beside each other and in layers, so that none begins inside another.
    void drop_figures() {
        const int count = 2 + dice_.below(5);
        double x = 0, y = 0, top = 0;
        for (int i = 0, tries = 0; i < count && tries < 60; ++tries) {
            const auto size = drop_one(x, y, i);
            if (!size) continue;
            top = std::max(top, (*size)[1]);
            x += (*size)[0] + 0.1;
            widest_ = std::max(widest_, x);
            if (dice_.one_of(2)) y += top + 0.1, x = top = 0;
            ++i;
        }
    }
    /// Width and height of a figure put at (x, y); nothing if the one drawn is too large, or driven.
    std::optional<Vec<2, double>> drop_one(double x, double y, int number) {
        std::optional<Vec<2, double>> size;
        int kind = dice_.below(number_of_kinds());
        Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) {
            if constexpr (Prefab::dimensions.include(D))
                if (kind-- == 0) size = drop(Prefab{}, x, y, number);
        });
        return size;
    }
    static int number_of_kinds() {
        int count = 0;
        Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) { count += Prefab::dimensions.include(D); });
        return count;
    }
    template <class Prefab> std::optional<Vec<2, double>> drop(Prefab prefab, double x, double y, int number) {
        constexpr double largest = 8; // metres
        constexpr std::size_t most = 120;
        if (!draw(prefab, dice_, D, 12, 0.3, 2) || begins_within_itself(prefab)) return {};
        Stepped<D, Real> alone;
        build(alone, prefab, "it", Placement<D, Real>{});
        const auto& p = alone.particles;
        if (p.size() == 0 || p.size() > most || any_driven(static_cast<World<D, Real>&>(alone))) return {};
        Vec<2, double> low{{1e30, 1e30}}, high{{-1e30, -1e30}};
        for (Row row = 0; row < p.size(); ++row)
            for (int k = 0; k < 2; ++k) {
                const double at = double(p.position[row][k]), radius = double(p.radius[row]);
                low[k] = std::min(low[k], at - radius), high[k] = std::max(high[k], at + radius);
            }
        const auto size = high - low;
        if (size[0] > largest || size[1] > largest) return {};
        build(world_, prefab, std::to_string(number), Placement<D, Real>{.at = at<V>(x - low[0], y - low[1])});
        text_ << "\n " << description_of(prefab);
        return size;
    }
    /// Boxes of a formation that are larger than the space between them part, which is work that nobody counts.
    template <class Prefab> static bool begins_within_itself(const Prefab& prefab) {
        if constexpr (std::is_same_v<Prefab, Formation>) return prefab.size >= prefab.spacing;
        return false;
    }
    void set_contacts() {
        const bool bounces = dice_.one_of(2);
        const double friction = dice_.one_of(3) ? 0 : dice_.share();
        text_ << "\n friction " << friction << (bounces ? ", bouncing" : "");
        for (FigureIndex i = 0; i < world_.figures.size(); ++i) {
            set_contact(world_, i,
                        {.figures = true,
                         .itself = dice_.one_of(3),
                         .friction = friction,
                         .bounce = bounces ? dice_.share() : 0});
            if (dice_.one_of(3)) world_.figures[i].direct = dice_.one_of(2) ? Direct::off : Direct::on;
        }
    }

    void build_room() {
        bounce_ = Real(dice_.one_of(2) ? 0 : dice_.share());
        friction_ = Real(dice_.one_of(3) ? 0 : dice_.share());
        const double floor = -dice_.between(0.05, 1), left = -dice_.between(0.1, 2),
                     right = widest_ + dice_.between(0.1, 2);
        add_wall(at<V>(1, 0), left), add_wall(at<V>(-1, 0), -right);
        if constexpr (D == 3) add_wall(V::axis(2), -4), add_wall(V::axis(2) * Real(-1), -4);
        const int ground = dice_.below(D == 2 ? 2 : 4);
        add_wall(at<V>(0, 1), ground == 0 ? floor : floor - 6);
        if (ground == 1) lay_tiles(left, right, floor);
        if constexpr (D == 3)
            if (ground > 1) lay_landscape(left, right, floor, ground == 2);
        text_ << "\n ground " << ground << ", bounce " << bounce_ << ", friction " << friction_;
    }
    void add_wall(const V& normal, double offset) {
        world_.bounds.push_back({normal, Real(offset), bounce_, friction_});
    }
    void add(collide::Collider<D, Real> collider, const V& place) {
        collider.from.position = collider.target.position = place;
        collider.restitution = bounce_, collider.friction = friction_;
        add_collider(world_, collider);
    }
    void lay_tiles(double left, double right, double floor) {
        const double wide = dice_.between(0.3, 1.5), thick = 4;
        for (double x = left - 1; x < right + 1; x += wide) {
            const V size = V::map([&](int k) { return Real(k == 0 ? wide : k == 1 ? thick : 9); });
            add({.shape = collide::Box<D, Real>{size}}, at<V>(x + wide / 2, floor - thick / 2));
        }
    }
    /// A height field or a mesh, flat or with hollows.
    void lay_landscape(double left, double right, double floor, bool field) {
        const double spacing = dice_.between(0.3, 1.5), deepest = dice_.one_of(2) ? 0 : dice_.between(0, 0.3);
        const auto columns = std::uint32_t((right - left + 4) / spacing) + 2, rows = std::uint32_t(10 / spacing) + 2;
        std::vector<Real> height;
        for (std::uint32_t i = 0; i < columns * rows; ++i) height.push_back(Real(-deepest * dice_.share()));
        V corner = at<V>(left - 1, floor);
        corner[2] = -5;
        if (field) return add({.shape = collide::HeightField<3, Real>{columns, Real(spacing), height}}, corner);
        std::vector<V> corners;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (std::uint32_t i = 0; i < columns * rows; ++i)
            corners.push_back({{Real(i % columns * spacing), height[i], Real(i / columns * spacing)}});
        for (std::uint32_t i = 0; i + columns < columns * rows; ++i)
            if (i % columns + 1 < columns) {
                triangles.push_back({i, i + columns, i + 1});
                triangles.push_back({i + 1, i + columns, i + columns + 1});
            }
        add({.shape = collide::Mesh<3, Real>{corners, triangles}}, corner);
    }

    void throw_figures() {
        const double fastest = dice_.one_of(3) ? 0 : dice_.between(0, 6);
        for (FigureIndex i = 0; i < world_.figures.size(); ++i) {
            const V velocity = V::map([&](int) { return Real(dice_.between(-fastest, fastest)); });
            for (Row row = 0; row < world_.particles.size(); ++row)
                if (world_.particles.figure[row] == i)
                    set_velocity(world_, world_.particles.handles.id_of(row), velocity);
        }
        text_ << ", thrown at up to " << fastest;
    }
};

} // namespace sinew::test
