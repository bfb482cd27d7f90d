#pragma once

#include "canvas/failure.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace sinew::canvas {

/// A file with the final name only when complete. The content is written to `.name.partial-PID.ext` beside the target,
/// because a rename needs one file system, and removed unless committed. A killed process leaves partial files behind;
/// the next one to write in the folder removes them.
class PartialFile {
  public:
    PartialFile() = default;
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;
    ~PartialFile() { discard(); }

    /// Creates the empty partial file and missing parent folders. With a scratch extension (".palette.png") the file
    /// only helps to make the target and is to be discarded. Failures are bare reasons: "it is a folder".
    [[nodiscard]] Failure create(const std::filesystem::path& target, std::string_view scratch = {});

    /// Renames the partial file to the target, replacing an existing file.
    [[nodiscard]] Failure commit();

    void discard();

    const std::filesystem::path& path() const { return partial; }

  private:
    void let_go();

    std::filesystem::path target, partial;
    int held = -1; ///< descriptor that locks the partial file while the process lives
};

/// Makes missing folders of a file that is written in place, and removes partial files of killed processes there.
/// Failures are bare reasons, of a file that cannot be replaced, too.
[[nodiscard]] Failure prepare_folder_of(const std::filesystem::path& target);

/// Reason of a failed write, for a reader who knows the file only as `called`: a full disk is reported by the system's
/// message alone, and names of partial files are replaced.
std::string reason_told(const std::string& reason, const std::string& called);

} // namespace sinew::canvas
