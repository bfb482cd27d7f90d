#include "canvas/formats.h"
#include "tests/canvas/pixels.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/canvas/tumbling_figure.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <string>

namespace sinew::SINEW_TEST_FILE {
namespace {

using canvas::Failure;
using canvas::FrameFormat;

Failure film(const std::filesystem::path& path, const FrameFormat& format, int frames) {
    auto [writer, failure] = canvas::open(path, format);
    TumblingFigure figure;
    for (int i = 0; i < frames && !failure; ++i)
        failure = writer->frame(figure.at(float(i) / float(format.fps), format.width, format.height));
    return failure ? failure : writer->finish();
}

std::string output_of(const std::string& command) {
    std::string text;
    std::FILE* pipe = popen(command.c_str(), "r");
    for (int c; (c = std::fgetc(pipe)) != EOF;) text += char(c);
    EXPECT_EQ(pclose(pipe), 0) << command;
    return text;
}

/// What ffprobe finds in the first stream: each frame is decoded and counted.
std::map<std::string, std::string> probe(const std::filesystem::path& path) {
    std::istringstream lines(
        output_of("ffprobe -v error -count_frames -show_streams -of default=nw=1 '" + path.string() + "'"));
    std::map<std::string, std::string> found;
    for (std::string line; std::getline(lines, line);)
        if (const auto equals = line.find('='); equals != std::string::npos)
            found.emplace(line.substr(0, equals), line.substr(equals + 1));
    return found;
}

/// A frame of a film as an image.
PngFile frame_of(const std::filesystem::path& path, int index) {
    const auto png = path.parent_path() / "frame.png";
    output_of("ffmpeg -v error -nostdin -y -i '" + path.string() + "' -vf 'select=eq(n\\," + std::to_string(index) +
              ")' -frames:v 1 '" + png.string() + "'");
    return PngFile(png);
}

void expect_figure(const PngFile& image, int tolerance) {
    expect_near(image.at(10, 10), TumblingFigure::paper, tolerance);
    expect_near(image.at(320, 128), TumblingFigure::skin, tolerance);
    expect_near(image.at(310, 230), TumblingFigure::cloth, tolerance);
}

TEST(Mp4, HasEveryFrameAtItsSizeAndRate) {
    ScratchFolder folder;
    ASSERT_EQ(film(folder / "a.mp4", {640, 480, 60}, 90), Failure());
    auto found = probe(folder / "a.mp4");
    EXPECT_EQ(found["codec_name"], "h264");
    EXPECT_EQ(found["pix_fmt"], "yuv420p");
    EXPECT_EQ(found["width"] + "x" + found["height"], "640x480");
    EXPECT_EQ(found["r_frame_rate"], "60/1");
    EXPECT_EQ(found["nb_read_frames"], "90");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.mp4"});
}

TEST(Mp4, KeepsColours) {
    ScratchFolder folder;
    ASSERT_EQ(film(folder / "a.mp4", {640, 480, 60}, 3), Failure());
    // Two roundings to 8-bit YUV and the encoder's loss.
    expect_figure(frame_of(folder / "a.mp4", 0), 6);
    EXPECT_EQ(probe(folder / "a.mp4")["color_space"], "bt709");
}

TEST(Mp4, BeginsWithItsIndexSoThatItPlaysWhileItLoads) {
    ScratchFolder folder;
    ASSERT_EQ(film(folder / "a.mp4", {320, 240, 30}, 10), Failure());
    const std::string bytes = text_of(folder / "a.mp4");
    EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
}

TEST(Mp4, OddSidesArePaddedWithBackground) {
    ScratchFolder folder;
    ASSERT_EQ(film(folder / "a.mp4", {641, 479, 30}, 3), Failure());
    auto found = probe(folder / "a.mp4");
    EXPECT_EQ(found["width"] + "x" + found["height"], "642x480");
    const PngFile image = frame_of(folder / "a.mp4", 0);
    expect_near(image.at(641, 5), TumblingFigure::paper, 6);
}

TEST(Mp4, MayBeOnePixel) {
    ScratchFolder folder;
    ASSERT_EQ(film(folder / "a.mp4", {1, 1, 30}, 2), Failure());
    EXPECT_EQ(probe(folder / "a.mp4")["nb_read_frames"], "2");
}

TEST(Mp4, RateMayBeAFraction) {
    ScratchFolder folder;
    ASSERT_EQ(film(folder / "a.mp4", {64, 64, 24000. / 1001}, 24), Failure());
    EXPECT_EQ(probe(folder / "a.mp4")["r_frame_rate"], "24000/1001");
}

TEST(Gif, HasEveryFrameAtItsSizeAndRateAndLoops) {
    ScratchFolder folder;
    for (int fps : {50, 25, 20}) {
        ASSERT_EQ(film(folder / "a.gif", {321, 241, double(fps)}, fps), Failure());
        auto found = probe(folder / "a.gif");
        EXPECT_EQ(found["codec_name"], "gif");
        EXPECT_EQ(found["width"] + "x" + found["height"], "321x241");
        EXPECT_EQ(found["r_frame_rate"], std::to_string(fps) + "/1");
        EXPECT_EQ(found["nb_read_frames"], std::to_string(fps));
        EXPECT_TRUE(text_of(folder / "a.gif").find("NETSCAPE2.0") != std::string::npos);
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.gif"}) << "the waiting frames are gone";
}

TEST(Gif, KeepsColours) {
    ScratchFolder folder;
    ASSERT_EQ(film(folder / "a.gif", {640, 480, 25}, 10), Failure());
    expect_figure(frame_of(folder / "a.gif", 0), 3);
}

TEST(Gif, MayBeOneFrame) {
    ScratchFolder folder;
    ASSERT_EQ(film(folder / "a.gif", {64, 48, 25}, 1), Failure());
    EXPECT_EQ(probe(folder / "a.gif")["nb_read_frames"], "1");
}

/// A WebP taken apart (this ffprobe cannot read an animated one). RIFF chunks: a name, a length, the data; even
/// lengths.
struct Webp {
    int width = 0, height = 0, frames = 0, loops = -1, milliseconds = 0;
    bool still = false;

    static int number(const std::string& bytes, std::size_t at, int size) {
        int value = 0;
        for (int i = size - 1; i >= 0; --i)
            value = value << 8 | static_cast<unsigned char>(bytes.at(at + std::size_t(i)));
        return value;
    }

    explicit Webp(const std::string& bytes) {
        EXPECT_EQ(bytes.substr(0, 4) + bytes.substr(8, 4), "RIFFWEBP");
        EXPECT_EQ(std::size_t(number(bytes, 4, 4)) + 8, bytes.size());
        for (std::size_t at = 12; at + 8 <= bytes.size();) {
            const std::string name = bytes.substr(at, 4);
            const int length = number(bytes, at + 4, 4);
            at += 8;
            if (name == "VP8X") width = 1 + number(bytes, at + 4, 3), height = 1 + number(bytes, at + 7, 3);
            if (name == "ANIM") loops = number(bytes, at + 4, 2);
            if (name == "ANMF") ++frames, milliseconds += number(bytes, at + 12, 3);
            if (name == "VP8 ") still = true;
            at += std::size_t(length + length % 2);
        }
    }
};

TEST(WebP, HasEveryFrameAtItsSizeAndRateAndLoopsForEver) {
    ScratchFolder folder;
    ASSERT_EQ(film(folder / "a.webp", {321, 241, 60}, 60), Failure());
    const Webp found(text_of(folder / "a.webp"));
    EXPECT_EQ(found.width, 321);
    EXPECT_EQ(found.height, 241);
    EXPECT_EQ(found.frames, 60);
    EXPECT_EQ(found.loops, 0) << "0 means without end";
    EXPECT_NEAR(found.milliseconds, 1000, 20);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.webp"});
}

TEST(WebP, OfOneFrameIsAStillImage) {
    ScratchFolder folder;
    ASSERT_EQ(film(folder / "a.webp", {640, 480, 30}, 1), Failure());
    const Webp found(text_of(folder / "a.webp"));
    EXPECT_TRUE(found.still);
    EXPECT_EQ(found.frames, 0);
    expect_figure(frame_of(folder / "a.webp", 0), 6);
}

TEST(Film, NameIsTakenLiterally) {
    ScratchFolder folder;
    for (const char* name : {"-a b'$(x)%03d:1.mp4", "http:%d.gif", "\xff\xfe.webp"})
        EXPECT_EQ(film(folder / name, {32, 32, 25}, 2), Failure()) << name;
    EXPECT_EQ(folder.names().size(), 3u);
}

TEST(Film, SeveralMayBeWrittenAtOnce) {
    ScratchFolder folder;
    auto [one, no_one] = canvas::open(folder / "one.mp4", {64, 64, 30});
    auto [two, no_two] = canvas::open(folder / "one.gif", {64, 64, 25});
    auto [three, no_three] = canvas::open(folder / "one.png", {64, 64});
    ASSERT_TRUE(one && two && three);
    TumblingFigure figure;
    for (float seconds : {0.f, 0.1f})
        for (canvas::Writer* writer : {one.get(), two.get()})
            ASSERT_EQ(writer->frame(figure.at(seconds, 64, 64)), Failure());
    ASSERT_EQ(three->frame(figure.at(0, 64, 64)), Failure());
    // The first must see the end of its input although the second is still running.
    for (canvas::Writer* writer : {one.get(), two.get(), three.get()}) ASSERT_EQ(writer->finish(), Failure());
    EXPECT_EQ(probe(folder / "one.mp4")["nb_read_frames"], "2");
    EXPECT_EQ(probe(folder / "one.gif")["nb_read_frames"], "2");
    EXPECT_EQ(folder.names().size(), 3u);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
