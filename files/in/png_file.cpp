#include "files/in/png_file.h"

#include "files/checksum.h"
#include "files/in/inflate.h"
#include "files/in/png_rows.h"

#include <algorithm>

namespace sinew::files {
namespace {

constexpr std::size_t around_chunk = 12; // bytes of length, type and checksum

std::uint32_t big(std::string_view bytes) {
    std::uint32_t number = 0;
    for (const char c : bytes.substr(0, 4)) number = number << 8U | static_cast<unsigned char>(c);
    return number;
}

class PngFileReader {
  public:
    PngFileReader(std::string_view bytes, Notes& notes) : bytes_(bytes), notes_(notes) {}

    Image read() {
        constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
        if (!bytes_.starts_with(signature)) fail(0, "it does not begin as a PNG does");
        for (at_ = signature.size(); !is_done_;) read_chunk();
        if (stream_.empty()) fail(at_, "there is no picture in it: the chunk IDAT is missing");
        if (form_.type == 3 && form_.palette.empty()) fail(at_, "the chunk PLTE, its palette, is missing");
        const auto wanted = form_.bytes();
        auto data = inflate(stream_, wanted);
        if (!data.problem.empty()) fail(byte_of_stream(data.at), data.problem);
        if (data.bytes.size() < wanted)
            fail(byte_of_stream(data.at), concat("the picture breaks off: ", data.bytes.size(), " bytes of ", wanted));
        return png_picture(form_, std::move(data.bytes));
    }

  private:
    std::string_view bytes_;
    Notes& notes_;
    std::size_t at_ = 0; ///< of the next chunk
    PngForm form_;
    bool has_form_ = false, is_done_ = false;
    std::string stream_;                                     ///< of all chunks IDAT
    std::vector<std::pair<std::size_t, std::size_t>> parts_; ///< byte of the stream, byte of the file

    [[noreturn]] static void fail(std::size_t at, std::string message, std::string help = {}) {
        throw ImportError{concat("byte ", at), std::move(message), std::move(help)};
    }

    std::size_t byte_of_stream(std::size_t at) const {
        auto part = std::ranges::upper_bound(parts_, at, {}, &std::pair<std::size_t, std::size_t>::first);
        if (part != parts_.begin()) --part;
        return part->second + (at - part->first);
    }

    void read_chunk() {
        if (bytes_.size() - at_ < around_chunk) fail(at_, "the file breaks off before the chunk IEND, its end");
        const std::size_t size = big(bytes_.substr(at_));
        const auto type = bytes_.substr(at_ + 4, 4);
        if (size > bytes_.size() - at_ - around_chunk)
            fail(at_,
                 concat("the chunk ", printable(type), " of ", size, " bytes is longer than the rest of the file"));
        const auto data = bytes_.substr(at_ + 8, size);
        if (big(bytes_.substr(at_ + 8 + size)) != crc32(bytes_.substr(at_ + 4, 4 + size)))
            fail(at_, concat("the chunk ", printable(type), " is damaged: its checksum is another"));
        if (!has_form_ && type != "IHDR") fail(at_, "it does not begin with the chunk IHDR");
        take(type, data);
        at_ += around_chunk + size;
    }

    void take(std::string_view type, std::string_view data) {
        if (type == "IHDR") return take_form(data);
        if (type == "PLTE") return take_palette(data);
        if (type == "tRNS") return take_transparency(data);
        if (type == "IDAT") {
            parts_.emplace_back(stream_.size(), at_ + 8);
            stream_ += data;
        } else if (type == "IEND") {
            is_done_ = true;
        } else if (type == "acTL") {
            notes_.count(concat("byte ", at_), "of a picture that moves the first frame is taken");
        } else if ((static_cast<unsigned char>(type[0]) & 32U) == 0) { // all that a reader must know is in capitals
            fail(at_, concat("the chunk ", printable(type), " is not known"));
        }
    }

    void take_form(std::string_view data) {
        if (has_form_ || data.size() != 13) fail(at_, "the chunk IHDR is damaged");
        has_form_ = true;
        const auto byte = [&](std::size_t i) { return unsigned(static_cast<unsigned char>(data[i])); };
        form_.width = big(data), form_.height = big(data.substr(4));
        form_.depth = byte(8), form_.type = byte(9), form_.is_interlaced = byte(12) == 1;
        constexpr std::uint32_t longest_side = 16384;
        const auto size = concat(form_.width, "x", form_.height);
        if (form_.width == 0 || form_.height == 0 || form_.width > longest_side || form_.height > longest_side)
            fail(at_, concat("the picture is ", size, ": 1 to ", longest_side, " pixels a side are possible"));
        if (std::int64_t(form_.width) * form_.height > Limits{}.pixels)
            fail(at_, concat("the picture is ", size, ": at most ", Limits{}.pixels, " pixels are possible"));
        if (!form_.is_valid() || byte(10) != 0 || byte(11) != 0 || byte(12) > 1)
            fail(at_, concat("there are no pixels of the type ", form_.type, " with ", form_.depth,
                             " bits, or they are packed in an unknown way"));
    }

    void take_palette(std::string_view data) {
        if (data.empty() || data.size() % 3 != 0 || data.size() > std::size_t(3) * 256 || !form_.palette.empty())
            fail(at_, "a palette has 1 to 256 colours, and is there once");
        for (std::size_t i = 0; i < data.size(); i += 3)
            form_.palette.push_back(0xff000000U | big(data.substr(i)) >> (data.size() - i > 3 ? 8U : 0U));
    }

    void take_transparency(std::string_view data) {
        if (form_.type == 3) {
            if (data.size() > form_.palette.size()) fail(at_, "more colours are transparent than the palette has");
            for (std::size_t i = 0; i < data.size(); ++i)
                form_.palette[i] = (form_.palette[i] & 0xffffffU) | std::uint32_t(static_cast<unsigned char>(data[i]))
                                                                        << 24U;
            return;
        }
        const std::size_t samples = form_.type == 2 ? 3 : 1;
        if (form_.type >= 4 || data.size() != 2 * samples) fail(at_, "the transparent colour is damaged");
        std::array<std::uint32_t, 3> color{};
        for (std::size_t i = 0; i < 3; ++i) color[i] = big(data.substr(samples == 3 ? 2 * i : 0, 2));
        form_.see_through = color;
    }
};

} // namespace

Image read_png_file(std::string_view bytes, Notes& notes) {
    return PngFileReader(bytes, notes).read();
}

} // namespace sinew::files
