#pragma once

#include "files/out/exporter.h"
#include "files/out/scene_mesh.h"

#include <cstddef>
#include <vector>

namespace sinew::files {

/// One mesh that moves: its form at the first frame, and the positions of its vertices in all.
class MeshFilm {
  public:
    /// Adds a frame. Refuses a mesh of another form than the first, because something tore, was cut or was added, and
    /// films of more than `max_numbers`. `ending` names the file in messages.
    [[nodiscard]] Failure add(const Session& session, const MeshContent& content, std::string_view ending);

    const SceneMesh& form() const { return form_; }
    std::size_t frames() const { return seconds_.size(); }
    double seconds(std::size_t frame) const { return seconds_[frame]; }
    std::size_t vertices() const { return form_.vertices.size(); }
    Vec3<double> position(std::size_t frame, std::size_t vertex) const {
        const float* p = &positions_[3 * (frame * vertices() + vertex)];
        return {{double(p[0]), double(p[1]), double(p[2])}};
    }
    /// Turn of a vertex' particle, a unit quaternion.
    Vec<4, double> turn(std::size_t frame, std::size_t vertex) const {
        const auto& turns = turns_[frame];
        return vertex < turns.size() ? turns[vertex] : Vec<4, double>::axis(3);
    }
    /// Coordinates of all vertices in a frame: x, y, z in turns.
    std::span<const float> numbers(std::size_t frame) const {
        return std::span(positions_).subspan(3 * vertices() * frame, 3 * vertices());
    }

    static constexpr std::size_t max_numbers = std::size_t(1) << 28; ///< a gibibyte

  private:
    SceneMesh form_;
    std::vector<float> positions_;
    std::vector<std::vector<Vec<4, double>>> turns_;
    std::vector<double> seconds_;
};

} // namespace sinew::files
