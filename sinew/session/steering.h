#pragma once

#include "sinew/prefab/car.h"
#include "sinew/prefab/character.h"
#include "sinew/prefab/controls.h"
#include "sinew/prefab/walk.h"
#include "sinew/scene/scene.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sinew {

/// Controls of the characters and cars of a session. The program's count first, then the player's once a key has been
/// pressed, then the scene's events.
class Steering {
  public:
    using Steered = std::variant<Character, Car>;

    /// Parameters of a figure of a scene; nothing for one that cannot be steered.
    static std::optional<Steered> of(const FigureSection& section);

    /// Controls of the player's keys, for every figure that the program does not control.
    void play(const Controls& controls) { player_ = within_range(controls); }
    const Controls& player() const { return player_ ? *player_ : neutral; }
    /// Controls of a figure by the program; nothing: the player's and the scene's again. A later figure of the same
    /// index has none of them.
    void set(const FigureId& figure, std::optional<Controls> controls);
    /// A figure beside those of the scene.
    struct Known {
        FigureId figure;
        Steered steered;   ///< parameters, each within the range of its field
        std::string model; ///< original of a copy, whose events steer the copy as well; empty: none
    };
    void know(const Known& known);
    /// Original of a copy; empty for any other figure.
    std::string model_of(const FigureId& figure) const;
    /// Parameters of a figure; nothing for one that cannot be steered.
    std::optional<Steered> steered(const Scene& scene, const AnyWorld& world, FigureIndex figure) const;
    /// True if there is something to steer.
    bool has_any(const Scene& scene) const;
    /// Forgets figures that the scene has not built, and the program's controls.
    void restart();
    /// Takes over the program's controls, and parameters of figures that are not of the scene, from a world before, by
    /// the names of the figures.
    void take_over(const Steering& before, const AnyWorld& old, const AnyWorld& now);

    /// Moves all figures for the next step.
    void run(const Scene& scene, AnyWorld& world) const;

    /// State of a snapshot; is_of() says whether it belongs to a scene.
    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [player, set, known] = self;
        visit(player, set, known);
    }
    /// False unless every number is within its range, and no figure is named twice.
    bool is_of(const Scene& scene) const;
    /// Keeps the ids of figures that came with a file from being given out again, those of removed figures too.
    void pass_generations() const;

  private:
    static constexpr Controls neutral{};
    std::optional<Controls> player_;
    std::vector<std::pair<FigureId, Controls>> set_;
    std::vector<Known> known_;

    static Controls within_range(const Controls& controls);
    template <class WorldT> void run_in(const Scene& scene, WorldT& world) const;
};

} // namespace sinew
