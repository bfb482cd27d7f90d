#include "canvas/partial_file.h"
#include "files/out/exporter.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace sinew::files {

Failure write_file(const std::filesystem::path& path, std::string_view bytes) {
    const auto told = [&](const std::string& reason) {
        return "cannot write " + path.string() + ": " + canvas::reason_told(reason, path.string());
    };
    canvas::PartialFile partial;
    if (auto failure = partial.create(path)) return told(*failure);
    auto* const file = std::fopen(partial.path().c_str(), "wb");
    if (!file) return told(std::strerror(errno));
    int error = std::fwrite(bytes.data(), 1, bytes.size(), file) < bytes.size() ? errno : 0;
    if (std::fclose(file) != 0 && error == 0) error = errno;
    if (error != 0) return told(std::strerror(error));
    if (auto failure = partial.commit()) return told(*failure);
    return {};
}

} // namespace sinew::files
