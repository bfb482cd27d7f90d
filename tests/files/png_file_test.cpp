#include "sinew/math/random.h"

#include "canvas/png.h"
#include "files/checksum.h"
#include "files/in/png_file.h"
#include "files/in/png_rows.h"
#include "files/out/bytes.h"
#include "files/out/deflate.h"
#include "files/out/png_writer.h"
#include "tests/files/imported.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;
using files::PngForm;

const std::string signature("\x89PNG\r\n\x1a\n");

std::string chunk(const std::string& type, const std::string& data) {
    std::string bytes;
    files::put_big(bytes, std::uint32_t(data.size()));
    bytes += type + data;
    files::put_big(bytes, files::crc32(std::string_view(bytes).substr(4)));
    return bytes;
}

std::string header(const PngForm& form) {
    std::string data;
    files::put_big(data, form.width);
    files::put_big(data, form.height);
    return data + char(form.depth) + char(form.type) + std::string(2, '\0') + char(form.is_interlaced);
}

/// Random rows, each after a filter of its own.
std::string rows_of(const PngForm& form, std::uint32_t seed) {
    auto byte = [&, i = 0U]() mutable { return char(random::bits(seed, 0, i++)); };
    std::string rows;
    const auto add = [&](unsigned width, unsigned height) {
        for (unsigned y = 0; width > 0 && y < height; ++y) {
            rows += char((y + seed) % 5);
            for (std::size_t i = 0; i < form.row_bytes(width); ++i) rows += byte();
        }
    };
    const auto w = form.width, h = form.height;
    if (!form.is_interlaced) {
        add(w, h);
    } else { // Adam7
        add((w + 7) / 8, (h + 7) / 8), add((w + 3) / 8, (h + 7) / 8), add((w + 3) / 4, (h + 3) / 8);
        add((w + 1) / 4, (h + 3) / 4), add((w + 1) / 2, (h + 1) / 4), add(w / 2, (h + 1) / 2), add(w, h / 2);
    }
    return rows;
}

std::string png_file(const PngForm& form, const std::string& beside, const std::string& rows) {
    return signature + chunk("IHDR", header(form)) + beside + chunk("IDAT", files::deflated(rows)) + chunk("IEND", "");
}

int difference(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height || a.pixels.size() != b.pixels.size()) return 1000;
    int most = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (unsigned k = 0; k < 32; k += 8)
            most = std::max(most, std::abs(int(a.pixels[i] >> k & 255U) - int(b.pixels[i] >> k & 255U)));
    return most;
}

/// As libpng and Cairo read it.
std::shared_ptr<const Image> by_libpng(const std::string& bytes) {
    return canvas::read_png(std::as_bytes(std::span(bytes)), "a.png", {}).image;
}

Image read(const std::string& bytes) {
    files::Notes notes;
    return files::read_png_file(bytes, notes);
}

/// Palette, and with `see_through` the colours of it, or the one colour, that are transparent.
std::string colors(const PngForm& form, bool see_through) {
    std::string chunks;
    const auto count = std::size_t(1) << form.depth;
    std::string palette, alphas;
    for (std::size_t i = 0; i < count && form.type == 3; ++i) {
        for (const unsigned k : {1U, 2U, 3U}) palette += char(random::bits(k, 0, i));
        alphas += char(i * 37);
    }
    if (form.type == 3) chunks += chunk("PLTE", palette);
    if (!see_through || form.type >= 4) return chunks;
    if (form.type == 0) alphas = std::string({'\0', '\1'});
    if (form.type == 2) alphas = std::string(6, '\0');
    return chunks + chunk("tRNS", alphas);
}

TEST(PngFile, AllFormsAreReadAsByLibpng) {
    std::uint32_t seed = 0;
    for (const unsigned type : {0U, 2U, 3U, 4U, 6U})
        for (const unsigned depth : {1U, 2U, 4U, 8U, 16U})
            for (const bool is_interlaced : {false, true})
                for (const bool see_through : {false, true}) {
                    PngForm form{.width = 13, .height = 11, .depth = depth, .type = type};
                    form.is_interlaced = is_interlaced;
                    if (!form.is_valid()) continue;
                    const auto bytes = png_file(form, colors(form, see_through), rows_of(form, ++seed));
                    const auto expected = by_libpng(bytes);
                    ASSERT_TRUE(expected) << type << " " << depth;
                    // Cairo rounds 16 bits to the nearest 8, and premultiplies before.
                    EXPECT_LE(difference(read(bytes), *expected), depth == 16 ? 1 : 0)
                        << "type " << type << ", depth " << depth << is_interlaced << see_through;
                }
}

TEST(PngFile, SmallInterlacedPicturesLackPasses) {
    for (std::uint32_t width = 1; width <= 5; ++width)
        for (std::uint32_t height = 1; height <= 5; ++height) {
            PngForm form{.width = width, .height = height};
            form.is_interlaced = true;
            const auto bytes = png_file(form, "", rows_of(form, width + 7 * height));
            const auto expected = by_libpng(bytes);
            ASSERT_TRUE(expected);
            EXPECT_EQ(difference(read(bytes), *expected), 0) << width << "x" << height;
        }
}

TEST(PngFile, PicturesOfOwnWriterComeBack) {
    const auto cat = read(text_of(std::filesystem::path(source_dir()) / "tests/files/png/cat.png"));
    const auto again = files::png_of(cat);
    EXPECT_EQ(difference(read(again), cat), 0);
    EXPECT_EQ(difference(*by_libpng(again), cat), 0);
    EXPECT_LT(again.size(), 2 * 6791U); // the file has 6791 bytes
}

TEST(PngFile, DamageIsToldWithItsPlace) {
    const PngForm form{.width = 4, .height = 4};
    const auto rows = rows_of(form, 1);
    const auto whole = png_file(form, "", rows);
    const auto problem_of = [](const std::string& bytes) { return refusal("a.png", bytes); };
    const std::size_t picture = 33; // byte of the chunk IDAT

    auto flipped = whole;
    flipped[picture + 12] = char(flipped[picture + 12] ^ 1);
    EXPECT_EQ(problem_of(flipped), "byte 33 | the chunk IDAT is damaged: its checksum is another");
    EXPECT_TRUE(problem_of(whole.substr(0, 60)).starts_with("byte 33 | the chunk IDAT of"));
    EXPECT_TRUE(problem_of(whole.substr(0, picture)).starts_with("byte 33 | the file breaks off"));
    EXPECT_TRUE(problem_of(whole.substr(0, whole.size() - 12)).find("before the chunk IEND") != std::string::npos);

    auto wrong_filter = rows;
    wrong_filter[2 * (form.row_bytes(4) + 1)] = 9;
    EXPECT_EQ(problem_of(png_file(form, "", wrong_filter)), "row 2 | there is no filter 9: the picture is damaged");

    const auto stream = files::deflated(rows);
    const auto parts = [&](const std::string& a, const std::string& b) {
        return signature + chunk("IHDR", header(form)) + chunk("IDAT", a) + chunk("IDAT", b) + chunk("IEND", "");
    };
    EXPECT_EQ(difference(read(parts(stream.substr(0, 20), stream.substr(20))), read(whole)), 0);
    // The damaged byte of the second chunk: its data begin at byte 33 + 12 + 20 + 8.
    const auto message = problem_of(parts(stream.substr(0, 20), stream.substr(20, 6)));
    EXPECT_EQ(message, "byte 79 | the compressed data breaks off");
    EXPECT_TRUE(problem_of(png_file(form, "", rows.substr(0, 30))).find("breaks off: 30 bytes of 68") !=
                std::string::npos);
    EXPECT_EQ(problem_of(png_file({.width = 2, .height = 2, .depth = 8, .type = 3}, chunk("PLTE", "abc"),
                                  std::string("\0\0\0\0\0\5", 6))),
              "row 1 | the palette has no colour 5");
    EXPECT_TRUE(
        problem_of(signature + chunk("tEXt", "a")).starts_with("byte 8 | it does not begin with the chunk IHDR"));
    EXPECT_TRUE(
        problem_of(png_file(form, chunk("ABCD", ""), rows)).starts_with("byte 33 | the chunk ABCD is not known"));
    EXPECT_TRUE(
        problem_of(png_file({.width = 4, .height = 4, .depth = 4, .type = 6}, "", rows)).starts_with("byte 8 |"));
}

TEST(PngFile, FramesOfAnAnimationAreTold) {
    const PngForm form{.width = 12, .height = 12, .depth = 8, .type = 0};
    std::string rows;
    for (int y = 0; y < 12; ++y) rows += std::string(13, '\0');
    const auto imported = import_text("a.png", png_file(form, chunk("acTL", std::string(8, '\1')), rows));
    EXPECT_TRUE(has_note(imported, "byte 33", "first frame"));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
