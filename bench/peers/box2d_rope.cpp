#include "bench/peers/peers.h"

#include <box2d/b2_draw.h>
#include <box2d/b2_rope.h>

/// The rope of Box2D 2.4 (Catto): position-based, for single strands only. Positions are accessible only through
/// drawing.
namespace sinew::bench {
namespace {

/// First particle and number of consecutive particles of a strand.
struct Strand {
    std::size_t first, count;
};

/// Decomposes the work into strands; empty if impossible.
std::vector<Strand> strands_of(const Work& work) {
    std::vector<Strand> strands;
    if (!work.struts.empty()) return {};
    std::size_t stick = 0;
    for (std::size_t i = 0; i < work.positions.size(); ++i) {
        if (!strands.empty() && stick < work.sticks.size() && work.sticks[stick].a == i - 1 &&
            work.sticks[stick].b == i) {
            ++strands.back().count;
            ++stick;
        } else {
            strands.push_back({i, 1});
        }
    }
    for (const auto& strand : strands)
        if (strand.count < 3) return {};
    return stick == work.sticks.size() ? strands : std::vector<Strand>{};
}

class Points final : public b2Draw {
  public:
    std::vector<b2Vec2> seen;
    void DrawPoint(const b2Vec2& p, float, const b2Color&) override { seen.push_back(p); }
    void DrawSegment(const b2Vec2&, const b2Vec2&, const b2Color&) override {}
    void DrawPolygon(const b2Vec2*, int32, const b2Color&) override {}
    void DrawSolidPolygon(const b2Vec2*, int32, const b2Color&) override {}
    void DrawCircle(const b2Vec2&, float, const b2Color&) override {}
    void DrawSolidCircle(const b2Vec2&, float, const b2Vec2&, const b2Color&) override {}
    void DrawTransform(const b2Transform&) override {}
};

class Box2DRope final : public Simulation {
  public:
    Box2DRope(const Work& work, const Effort& effort) : effort_(effort) {
        for (const auto& [first, count] : strands_of(work)) {
            std::vector<b2Vec2> positions;
            std::vector<float> masses;
            for (std::size_t i = first; i < first + count; ++i) {
                positions.emplace_back(work.positions[i][0], work.positions[i][1]);
                masses.push_back(work.inverse_masses[i] > 0 ? 1 / work.inverse_masses[i] : 0);
            }
            b2RopeDef def;
            def.vertices = positions.data();
            def.count = int32(count);
            def.masses = masses.data();
            def.gravity.Set(work.gravity[0], work.gravity[1]);
            def.tuning.bendStiffness = 0;
            ropes_.push_back(std::make_unique<b2Rope>());
            ropes_.back()->Create(def);
        }
    }

    void step() override {
        for (int i = 0; i < effort_.substeps; ++i)
            for (const auto& rope : ropes_)
                rope->Step(float(frame / effort_.substeps), effort_.iterations, b2Vec2_zero);
        looked_ = false;
    }

    Found position(std::size_t particle) const override {
        if (!looked_) {
            points_.seen.clear();
            for (const auto& rope : ropes_) rope->Draw(&points_);
            looked_ = true;
        }
        return {{points_.seen[particle].x, points_.seen[particle].y, 0}};
    }

  private:
    Effort effort_;
    std::vector<std::unique_ptr<b2Rope>> ropes_;
    mutable Points points_;
    mutable bool looked_ = false;
};

} // namespace

Solver peer::box2d_rope() {
    return {.name = "box2d rope",
            .about = "Box2D's b2Rope, of single ropes only",
            .takes = [](const Work& work) { return !strands_of(work).empty(); },
            .make = [](const Work& work, const Effort& effort) -> std::unique_ptr<Simulation> {
                return std::make_unique<Box2DRope>(work, effort);
            }};
}

} // namespace sinew::bench
