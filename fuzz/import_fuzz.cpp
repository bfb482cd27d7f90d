#include "sinew/scene/read_models.h"
#include "sinew/scene/scene.h"
#include "sinew/scene/text.h"

#include "canvas/png.h"
#include "files/checksum.h"
#include "files/in/formats.h"
#include "files/out/bytes.h"
#include "files/out/deflate.h"

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

/// The reader under test.
const files::ImportFormat* reader = nullptr;

void put_chunk(std::string& png, std::string_view type, std::string_view data) {
    files::put_big(png, std::uint32_t(data.size()));
    png.append(type).append(data);
    files::put_big(png, files::crc32(std::string_view(png).substr(png.size() - data.size() - 4)));
}

/// A PNG whose checksums are right: of a compressed stream, or of the rows of pixels. The first 13 bytes are its
/// header.
std::string png_around(std::string_view bytes, bool is_stream) {
    constexpr std::size_t header = 13;
    std::string png("\x89PNG\r\n\x1a\n");
    put_chunk(png, "IHDR", bytes.substr(0, header));
    put_chunk(png, "PLTE", std::string_view("\x7f\0\0\0\xff\0", 6));
    const auto content = bytes.substr(std::min(bytes.size(), header));
    put_chunk(png, "IDAT", is_stream ? std::string(content) : files::deflated(content));
    put_chunk(png, "IEND", {});
    return png;
}

/// The input as a file; parts that mutations seldom reach are put where the reader meets them.
files::ImportFile file_of(std::string bytes) {
    const std::string_view format = reader->endings;
    if (format == "png" && !bytes.empty() && (bytes[0] == 's' || bytes[0] == 'r'))
        return {"fuzz", "fuzz", png_around(std::string_view(bytes).substr(1), bytes[0] == 's')};
    if (format == "tmj" && bytes.starts_with('<')) {
        files::ImportFile map{"fuzz", "fuzz",
                              R"({"tilewidth":8,"tileheight":8,"width":2,"height":1,
"tilesets":[{"firstgid":1,"source":"t.tsx"}],
"layers":[{"type":"tilelayer","width":2,"height":1,"data":[1,2147483650]}]})"};
        map.beside.push_back({"t.tsx", std::move(bytes)});
        return map;
    }
    return {"fuzz", "fuzz", std::move(bytes)};
}

} // namespace

/// A target for each reader: bin/import_fuzz_svg and so on are links to the program, and their ending says the format.
extern "C" int LLVMFuzzerInitialize(int* /*count*/, char*** arguments) {
    const std::string_view program = (*arguments)[0];
    for (const auto* format : files::import_formats())
        if (program.ends_with(concat("import_fuzz_", format->endings))) reader = format;
    if (reader) return 0;
    std::fputs("the program's name says which reader it feeds: import_fuzz_svg\n", stderr);
    std::exit(2);
}

/// A file of the format: a scene, or refused with a message.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto file = file_of(std::string(reinterpret_cast<const char*>(data), size));
    try {
        check(reader->read(file, {}));
    } catch (const files::ImportError& error) {
        if (error.message.empty()) std::abort();
    }
    return 0;
}
