#pragma once

#include "canvas/failure.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace sinew::canvas {

/// A file that appears under its name only when it is whole. It is written as `.name.partial-PID.ext` beside its target
/// (so that the last step is a rename on one file system) and removed unless committed. A process that was killed
/// leaves its partial files behind: whoever next creates one in that folder removes those whose process is gone.
class PartialFile {
  public:
    PartialFile() = default;
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;
    ~PartialFile() { discard(); }

    /// Creates the empty partial file, and the folders that lead to it where they are missing. With a scratch extension
    /// (".palette.png") it only helps to make the target and is to be discarded. Failures are bare reasons: "it is a
    /// folder".
    [[nodiscard]] Failure create(const std::filesystem::path& target, std::string_view scratch = {});

    /// Gives the file its name. A file that had that name is replaced.
    [[nodiscard]] Failure commit();

    void discard();

    const std::filesystem::path& path() const { return partial; }

  private:
    void let_go();

    std::filesystem::path target, partial;
    int held = -1; ///< a descriptor that locks the partial file for as long as this process lives
};

/// Why a file could not be written, for those who know only what it is `called`: a full disk is told in the system's
/// words alone, and names of partial files are replaced.
std::string reason_told(const std::string& reason, const std::string& called);

} // namespace sinew::canvas
