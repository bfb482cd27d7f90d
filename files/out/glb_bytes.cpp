#include "files/out/glb_bytes.h"

#include <cstdint>

namespace sinew::files {
namespace {

/// Numbers of the specification.
constexpr std::uint32_t glb_magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

void put(std::string& bytes, std::uint32_t number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

} // namespace

std::string glb_bytes(std::string text, const std::string& binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file;
    file.reserve(28 + text.size() + binary.size());
    for (const std::uint32_t number :
         {glb_magic, 2u, std::uint32_t(28 + text.size() + binary.size()), std::uint32_t(text.size()), json_chunk})
        put(file, number);
    file += text;
    put(file, std::uint32_t(binary.size()));
    put(file, binary_chunk);
    return file + binary;
}

} // namespace sinew::files
