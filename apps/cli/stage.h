#pragma once

#include "sinew/picture/draw.h"

#include "apps/cli/arguments.h"
#include "apps/cli/stepping.h"
#include "apps/cli/watched_files.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace sinew::cli {

/// A scene to be drawn, or labelled variants of a scene beside each other: at the same time, and in the same scale
/// unless a mode has a view of its own.
class Stage {
  public:
    /// Variants are modes or key=value, applied after the shared overrides; without variants the scene stands alone.
    /// Files read are noted in `read`. Throws CommandError.
    Stage(const SceneWords& words, std::span<const std::string> variants, WatchedFiles* read = nullptr);

    /// Gives every variant a copy of the pointer's path.
    void lead_pointer(const PointerPath& path) {
        for (auto& run : runs_) run.pointer = path;
    }

    /// The first variant, which sets size and time for all.
    const Scene& scene() const { return runs_.front().session.scene(); }

    /// Size of the whole in pixels, for single pictures of size `one`.
    std::array<int, 2> size(std::array<int, 2> one) const;

    /// Steps all variants to `seconds` of the scene's time. `progress` counts the steps of all variants.
    void advance(double seconds, canvas::Progress& progress);
    /// Number of steps of all variants until `seconds`.
    std::uint64_t steps(double seconds) const;

    /// Draws into `picture`, with single pictures of `one` pixels.
    void draw(Picture& picture, std::array<int, 2> one, OverlaySet overlay);

  private:
    std::vector<std::string> labels_;
    std::vector<Run> runs_;
    std::vector<Picture> pictures_; ///< per variant; empty without variants
};

/// Variants in a list like "classic,physical" or "solver.substeps=4,solver.substeps=16". Throws CommandError.
std::vector<std::string> variants_in(const std::string& list);

} // namespace sinew::cli
