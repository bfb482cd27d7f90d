#pragma once

#include "sinew/math/format.h"
#include "sinew/world/world.h"

#include <array>
#include <optional>
#include <string>

/// Checks of the figures of a world that came with a file: pieces are drawn and cut by index.
namespace sinew::snapshot {

/// Fault of a field.
struct Fault {
    std::string field, what;
};

/// Most substeps, iterations and passes, as in scene files.
inline constexpr int max_substeps = 1000;

inline std::string range_text(double value, double low, double high) {
    return number_text(value) + " is not within " + number_text(low) + " and " + number_text(high);
}

/// Fewest particles of a piece.
constexpr std::size_t min_particles(Mark mark) {
    return mark == Mark::surface ? 3 : 1;
}

class FigureCheck {
  public:
    explicit FigureCheck(const Figure& figure) : figure_(figure) {}

    std::string run() const {
        if (!(figure_.friction >= 0 && figure_.friction <= 1e30)) return "friction out of range";
        if (!(figure_.internal_damping >= 0 && figure_.internal_damping <= 1e30)) return "damping out of range";
        for (const auto* rules : {&figure_.particle_numbers, &figure_.constraint_numbers})
            for (const auto& rule : *rules)
                if (rule.first > max_rows || rule.count > max_rows) return "names of too many rows";
        for (const auto& piece : figure_.pieces)
            if (auto fault = fault_of(piece); !fault.empty()) return fault;
        for (const auto& fragment : figure_.fragments)
            if (!is_sound(fragment)) return "a fragment without its corners";
        return {};
    }

  private:
    static constexpr std::size_t max_rows = limit::rows;
    const Figure& figure_;

    std::string fault_of(const Piece& piece) const {
        if (!(piece.width >= 0 && piece.width <= 1e30 && piece.end_width >= 0 && piece.end_width <= 1e30))
            return "a piece with a width out of range";
        if (piece.particles.size() < min_particles(piece.mark)) return "a piece of too few particles";
        if (piece.mark != Mark::fragment) return {};
        if (piece.fragment >= figure_.fragments.size()) return "a piece of a fragment that is not there";
        for (const auto& corner : figure_.fragments[piece.fragment].corners)
            for (const auto index : std::array{corner.of[0], corner.of[1], corner.of[2]})
                if (index >= piece.particles.size()) return "a fragment with a corner at no particle";
        return {};
    }
    static bool is_sound(const Fragment& fragment) {
        std::uint32_t before = 0;
        for (const auto end : fragment.ends) {
            if (end < before || end > fragment.points.size()) return false;
            before = end;
        }
        for (const auto& point : fragment.points)
            if (!is_finite(point)) return false;
        for (const auto& corner : fragment.corners)
            if (corner.count > 3 || !is_finite(corner.at)) return false;
        return true;
    }
};

template <int D, class Real> std::optional<Fault> check_figures(const World<D, Real>& world) {
    std::size_t unused = 0;
    for (std::size_t i = 0; i < world.figures.size(); ++i) {
        unused += world.figures[i].in_use() ? 0 : 1;
        if (auto fault = FigureCheck(world.figures[i]).run(); !fault.empty())
            return Fault{"figures", "number " + std::to_string(i) + ": " + fault};
    }
    if (unused != world.unused_figures) return Fault{"unused_figures", "not as many as there are"};
    for (const auto& [name, index] : world.figure_names)
        if (!has_figure(world, index)) return Fault{"figure_names", "a name of no figure"};
    return std::nullopt;
}

} // namespace sinew::snapshot
