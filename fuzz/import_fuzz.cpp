#include "sinew/scene/read_models.h"
#include "sinew/scene/scene.h"

#include "canvas/png.h"
#include "files/in/formats.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace {

using namespace sinew;

std::string bytes_of(const files::Imported& imported, const std::string& name) {
    const auto found = std::ranges::find(imported.beside, name, &files::SideFile::name);
    if (found == imported.beside.end()) std::abort();
    return found->bytes;
}

/// A scene that was made of any file is one that opens.
void check(const files::Imported& imported) {
    auto document = load(json::to_text(imported.scene), "fuzz.json");
    const auto image = [&](const std::string& name, const Limits& limits) {
        const auto bytes = bytes_of(imported, name);
        return canvas::read_png(std::as_bytes(std::span(bytes)), name, limits);
    };
    const auto model = [&](const std::string& name, const Limits& limits) {
        return read_model(bytes_of(imported, name), name, limits);
    };
    if (open_scene(document, image, model)) return;
    std::fputs(to_text(document.diagnostics).c_str(), stderr);
    std::abort();
}

} // namespace

/// The first byte chooses a format, the rest is a file of it: a scene, or refused with a message.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const auto formats = files::import_formats();
    const auto& format = *formats[data[0] % formats.size()];
    const files::ImportFile file{"fuzz", "fuzz", std::string(reinterpret_cast<const char*>(data) + 1, size - 1)};
    try {
        check(format.read(file, {}));
    } catch (const files::ImportError& error) {
        if (error.message.empty()) std::abort();
    }
    return 0;
}
