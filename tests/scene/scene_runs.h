#pragma once

#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include "tests/paths.h"
#include "tests/scene/models.h"
#include "tests/text_of.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

/// Scenes of the catalogue, opened and looked at.
namespace sinew {

inline std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(test::scenes_dir()))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// A session of a scene with a mode and a precision; what is wrong with it is a failure.
inline std::optional<Session> open(const std::string& name, const std::string& mode,
                                   const std::string& precision = "double") {
    const auto path = std::filesystem::path(test::scenes_dir()) / (name + ".json");
    const std::array<Override, 2> choice = {Override{"mode=" + mode}, Override{"precision=" + precision}};
    auto document = load(text_of(path), path.string(), choice);
    auto opened = open_scene(document, {}, models_beside(path));
    EXPECT_TRUE(opened.has_value()) << to_text(document.diagnostics);
    if (!opened) return std::nullopt;
    return Session(std::move(*opened));
}

/// How far the particles that move are beyond the bounds, at most, in their radii or in `size`, if that is larger.
inline double distance_outside(const AnyWorld& any, double size) {
    return std::visit(
        [&](const auto& world) {
            double farthest = 0;
            for (const auto& plane : world.bounds)
                for (Row row = 0; row < world.particles.size(); ++row) {
                    if (world.particles.mobility[row] == 0) continue;
                    const double depth =
                        double(plane.offset) - double(dot(plane.normal, world.particles.position[row]));
                    farthest = std::max(farthest, depth / std::max(double(world.particles.radius[row]), size));
                }
            return farthest;
        },
        any);
}

inline bool is_finite(const AnyWorld& any) {
    return std::visit(
        [](const auto& world) {
            return std::all_of(world.particles.position.begin(), world.particles.position.end(),
                               [](const auto& place) { return is_finite(place); });
        },
        any);
}

/// The worst strain of a distance that is not meant to give.
inline double rigid_strain(const AnyWorld& any) {
    return std::visit(
        []<class WorldT>(const WorldT& world) {
            const auto& distances = std::get<kind_number<Distance, WorldT::dimension>>(world.constraints);
            double worst = 0;
            for (Row row = 0; row < distances.size(); ++row) {
                if (distances.compliance[row] > 0) continue;
                const auto ends = distances.members[row];
                const double length =
                    double(distance(world.particles.position[ends[0]], world.particles.position[ends[1]]));
                const double low = double(distances.low(row)), high = double(distances.high(row));
                worst = std::max({worst, length / high - 1, low > 0 ? 1 - length / low : 0});
            }
            return worst;
        },
        any);
}

/// How far particles travel from where they were first seen, as a share of the picture's height; where the scene states
/// none, of the extent of all that can move.
class Travel {
  public:
    explicit Travel(const Scene& scene) : height_(scene.view.height) {}

    void see(const AnyWorld& any) {
        std::visit([&](const auto& world) { see_particles(world.particles); }, any);
    }

    double share() const { return farthest_ / height_.value_or(extent_); }

  private:
    using Place = std::array<double, 3>;

    template <int D, class Real> static Place place_of(const Vec<D, Real>& point) {
        Place place{};
        for (int axis = 0; axis < D; ++axis) place[std::size_t(axis)] = double(point[axis]);
        return place;
    }

    static double distance(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

    template <class Particles> void see_particles(const Particles& particles) {
        const bool is_first = first_.empty();
        for (Row row = 0; row < particles.size(); ++row) {
            const auto place = place_of(particles.position[row]);
            if (is_first) first_.push_back(place);
            if (row < first_.size()) farthest_ = std::max(farthest_, distance(place, first_[row]));
            if (!is_first || particles.mobility[row] == 0) continue;
            if (!origin_) origin_ = place;
            extent_ = std::max(extent_, distance(place, *origin_));
        }
    }

    std::optional<double> height_;
    std::optional<Place> origin_;
    std::vector<Place> first_;
    double extent_ = 0, farthest_ = 0;
};

struct SceneRun {
    std::string scene, mode, precision;

    friend std::ostream& operator<<(std::ostream& out, const SceneRun& run) {
        return out << run.scene << ' ' << run.mode << ' ' << run.precision;
    }
};

inline std::vector<SceneRun> runs() {
    std::vector<SceneRun> all;
    for (const auto& scene : scene_names())
        for (const auto mode : modes)
            for (const auto precision : SolverSection::precisions)
                all.push_back({scene, std::string(mode), std::string(precision)});
    return all;
}

inline std::string name_of_run(const testing::TestParamInfo<SceneRun>& test) {
    return fmt::format("{}_{}_{}", test.param.scene, test.param.mode, test.param.precision);
}

/// How far outside something may be that is smaller. An original's sweep comes after its walls, so that a stick pushes
/// a point out again for a frame.
inline double min_size(const Session& session, const std::string& mode) {
    return (mode == "classic" ? 0.5 : 0.01) * session.scene().measures().per_metre;
}

} // namespace sinew
