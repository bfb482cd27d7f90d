#pragma once

#include "canvas/failure.h"

#include <filesystem>
#include <string_view>

namespace sinew::canvas {

/// A file that appears under its name only when it is whole. It is written as `.name.partial-PID.ext` beside its target
/// (so that the last step is a rename on one file system) and removed unless committed.
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
    std::filesystem::path target, partial;
};

} // namespace sinew::canvas
