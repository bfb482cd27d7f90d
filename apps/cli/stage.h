#pragma once

#include "apps/cli/arguments.h"
#include "apps/cli/stepping.h"
#include "apps/cli/watched_files.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace sinew::cli {

/// A scene that is drawn, or variants of it beside each other: at the same time, in the same scale unless a mode has a
/// view of its own, each under its name.
class Stage {
  public:
    /// A variant is a mode or key=value, over the overrides that all share; without variants the scene stands alone.
    /// Files that are read are noted in `read`. Throws GiveUp.
    Stage(const SceneWords& words, std::span<const std::string> variants, WatchedFiles* read = nullptr);

    /// Every variant's pointer goes that way.
    void lead_pointer(const PointerPath& path) {
        for (auto& run : runs_) run.pointer = path;
    }

    /// The first, whose size and time are those of all.
    const Scene& scene() const { return runs_.front().session.scene(); }

    /// Pixels of the whole where one picture has so many.
    std::array<int, 2> size(std::array<int, 2> one) const;

    /// Steps until that many seconds of the scene are over. `progress` counts the steps of all.
    void advance(double seconds, canvas::Progress& progress);
    /// Steps of all until then.
    std::uint64_t steps(double seconds) const;

    /// Draws into `picture`, where one has `one` pixels.
    void draw(Picture& picture, std::array<int, 2> one, OverlaySet overlay);

  private:
    std::vector<std::string> labels_;
    std::vector<Run> runs_;
    std::vector<Picture> pictures_; ///< of each, where there are several
};

/// The variants that a list like "classic,physical" or "solver.substeps=4,solver.substeps=16" names. Throws GiveUp.
std::vector<std::string> variants_in(const std::string& list);

} // namespace sinew::cli
