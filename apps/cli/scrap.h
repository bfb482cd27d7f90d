#pragma once

#include "sinew/picture/picture.h"

#include "canvas/partial_file.h"
#include "canvas/writer.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace sinew::cli {

/// A temporary file, read back after writing and then removed: input of another file, or of a pipe.
class Scrap {
  public:
    /// Creates the file in the folder of `beside`, with the extension `ending`, called `called` in messages. Throws
    /// CommandError.
    Scrap(const std::filesystem::path& beside, std::string_view ending, std::string called);

    const std::filesystem::path& path() const { return file_.path(); }
    const std::string& called() const { return called_; }
    std::string bytes() const;

  private:
    std::string called_;
    canvas::PartialFile file_;
};

/// Throws CommandError on a failure; a failure caused by an interruption is reported as an interruption.
void settle(const canvas::Failure& failure);

} // namespace sinew::cli
