#pragma once

#include "canvas/failure.h"
#include "canvas/partial_file.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace sinew::files {

/// A file written from the front to the back, which has its name only when complete. The first failure is kept, and
/// told by commit().
class OutputFile {
  public:
    /// Opens the file beside its final place.
    [[nodiscard]] canvas::Failure create(const std::filesystem::path& path);

    void put(std::string_view text);
    void put_bytes(std::span<const std::byte> bytes);
    /// Numbers with the lowest byte first, or the highest.
    void put_little(std::uint32_t number);
    void put_little(float number);
    void put_big(std::uint32_t number);
    void put_big(float number);
    /// Goes back to a byte of the file, to write a number known only at the end.
    void seek(long position);

    /// Gives the file its name.
    [[nodiscard]] canvas::Failure commit();

    const std::filesystem::path& path() const { return path_; }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    canvas::Failure told(const std::string& reason) const;

    std::filesystem::path path_;
    canvas::PartialFile partial_;
    std::unique_ptr<std::FILE, Close> file_;
    int error_ = 0; ///< errno of the first failure
};

/// Writes a whole file.
[[nodiscard]] canvas::Failure write_file(const std::filesystem::path& path, std::string_view bytes);

} // namespace sinew::files
