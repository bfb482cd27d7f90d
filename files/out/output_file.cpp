#include "files/out/output_file.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <utility>

namespace sinew::files {
namespace {

std::array<std::byte, 4> little(std::uint32_t n) {
    return {std::byte(n), std::byte(n >> 8), std::byte(n >> 16), std::byte(n >> 24)};
}

std::uint32_t swapped(std::uint32_t n) {
    return n << 24 | (n & 0xff00) << 8 | (n >> 8 & 0xff00) | n >> 24;
}

} // namespace

canvas::Failure OutputFile::told(const std::string& reason) const {
    return "cannot write " + path_.string() + ": " + canvas::reason_told(reason, path_.string());
}

canvas::Failure OutputFile::create(const std::filesystem::path& path) {
    path_ = path;
    if (auto failure = partial_.create(path)) return told(*failure);
    file_.reset(std::fopen(partial_.path().c_str(), "wb"));
    if (!file_) return told(std::strerror(errno));
    return {};
}

void OutputFile::put(std::string_view text) {
    put_bytes(std::as_bytes(std::span(text)));
}

void OutputFile::put_bytes(std::span<const std::byte> bytes) {
    if (error_ == 0 && std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) < bytes.size()) error_ = errno;
}

void OutputFile::put_little(std::uint32_t number) {
    put_bytes(little(number));
}
void OutputFile::put_little(float number) {
    put_little(std::bit_cast<std::uint32_t>(number));
}
void OutputFile::put_big(std::uint32_t number) {
    put_bytes(little(swapped(number)));
}
void OutputFile::put_big(float number) {
    put_big(std::bit_cast<std::uint32_t>(number));
}

void OutputFile::seek(long position) {
    if (error_ == 0 && std::fseek(file_.get(), position, SEEK_SET) != 0) error_ = errno;
}

canvas::Failure OutputFile::commit() {
    if (std::fclose(file_.release()) != 0 && error_ == 0) error_ = errno;
    if (error_ != 0) return told(std::strerror(error_));
    if (auto failure = partial_.commit()) return told(*failure);
    return {};
}

canvas::Failure write_file(const std::filesystem::path& path, std::string_view bytes) {
    OutputFile file;
    if (auto failure = file.create(path)) return failure;
    file.put(bytes);
    return file.commit();
}

} // namespace sinew::files
