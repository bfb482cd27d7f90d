#pragma once

#include "sinew/session/picture.h"

#include "canvas/partial_file.h"
#include "canvas/writer.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace sinew::cli {

/// A file that is read again as soon as it is written, and then is no more: what goes into another file, or into a
/// pipe.
class Scrap {
  public:
    /// In the folder of `beside`, of the kind that the ending says. Messages call it `called`. Throws GiveUp.
    Scrap(const std::filesystem::path& beside, std::string_view ending, std::string called);

    const std::filesystem::path& path() const { return file_.path(); }
    const std::string& called() const { return called_; }
    std::string bytes() const;

  private:
    std::string called_;
    canvas::PartialFile file_;
};

/// Passes a failure on as the end of the command. A failure that an interruption caused is told as that.
void settle(const canvas::Failure& failure);

} // namespace sinew::cli
