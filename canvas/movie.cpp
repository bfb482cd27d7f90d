#include "canvas/movie.h"

#include "canvas/ffmpeg.h"
#include "canvas/formats.h"
#include "canvas/interrupt.h"
#include "canvas/raster.h"

#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

namespace sinew::canvas {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

/// A path as ffmpeg takes paths literally: without the prefix "a:b.mp4" would be a protocol and "-x.mp4" an option.
std::string url(const fs::path& path) {
    return "file:" + path.string();
}

Arguments joined(Arguments first, const Arguments& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

/// Raw frames on standard input.
Arguments input(const Raster& raster, double fps) {
    return {"-f",          "rawvideo",
            "-pix_fmt",    Raster::pixel_format(),
            "-video_size", fmt::format("{}x{}", raster.width(), raster.height()),
            "-framerate",  fmt::format("{}", fps),
            "-i",          "pipe:0"};
}

/// Common base of movie writers: a raster, and an ffmpeg that encodes the raster's pixels.
class MovieWriter : public Writer {
  public:
    /// Sides are padded to multiples of `multiple`.
    MovieWriter(fs::path path, const FrameFormat& frame_format, int multiple)
        : Writer(std::move(path), frame_format),
          raster(format.width, format.height, padding(format.width, multiple), padding(format.height, multiple)) {}

  protected:
    /// Arguments that encode the raw frames into the file at partial.path().
    virtual Arguments encoding() const = 0;

    Failure start() override { return run(joined(input(raster, format.fps), encoding())); }

    Failure add(const Picture& picture) override {
        if (auto failure = raster.paint(picture)) return failure;
        return ffmpeg.send(raster.bytes());
    }

    Failure complete() override { return ffmpeg.finish(); }
    void abandon() override { ffmpeg.abandon(); }

    Failure run(const Arguments& arguments) { return ffmpeg.start(arguments, extension_of(target)); }

    static int padding(int side, int multiple) { return (multiple - side % multiple) % multiple; }

    Raster raster;
    Ffmpeg ffmpeg;
};

/// A film in 4:2:0, its colours converted to BT.709 and tagged as such: players take untagged ones by the height.
class FilmWriter : public MovieWriter {
  public:
    FilmWriter(const fs::path& path, const FrameFormat& frame_format) : MovieWriter(path, frame_format, even) {}

  private:
    virtual Arguments codec() const = 0;
    virtual Arguments container() const = 0;

    Arguments encoding() const override {
        const Arguments converted = {"-vf", "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+full_chroma_inp"};
        const Arguments tagged = {"-pix_fmt",    "yuv420p", "-color_primaries", "bt709", "-color_trc", "bt709",
                                  "-colorspace", "bt709",   "-color_range",     "tv"};
        return joined(joined(joined(joined(converted, codec()), tagged), container()), {url(partial.path())});
    }
};

class Mp4Writer final : public FilmWriter {
  public:
    using FilmWriter::FilmWriter;

  private:
    Arguments codec() const override {
        return {"-c:v", "libx264", "-preset", "veryfast", "-tune", "animation", "-crf", "16"};
    }
    Arguments container() const override { return {"-movflags", "+faststart", "-f", "mp4"}; }
};

class WebmWriter final : public FilmWriter {
  public:
    using FilmWriter::FilmWriter;

  private:
    Arguments codec() const override {
        return {"-c:v", "libvpx-vp9", "-b:v", "0", "-crf", "20", "-deadline", "realtime", "-cpu-used", "6"};
    }
    Arguments container() const override { return {"-f", "webm"}; }
};

class WebpWriter final : public MovieWriter {
  public:
    WebpWriter(const fs::path& path, const FrameFormat& frame_format) : MovieWriter(path, frame_format, 1) {}

  private:
    Arguments encoding() const override {
        // libwebp_anim stores the differences between frames, but keeps the whole animation in memory until the end.
        const Arguments how = format.compact
                                  ? Arguments{"-c:v", "libwebp_anim", "-quality", "80", "-compression_level", "2"}
                                  : Arguments{"-c:v", "libwebp", "-quality", "85", "-compression_level", "1"};
        return joined(how, {"-loop", "0", "-f", "webp", url(partial.path())});
    }
};

/// The common single pass with `split` keeps every raw frame in memory until the palette is known (1.3 GB for 500
/// frames of 640x480). Two stages need 13 MB of disk for the same frames, give the same bytes and take the same time.
class GifWriter final : public MovieWriter {
  public:
    GifWriter(const fs::path& path, const FrameFormat& frame_format) : MovieWriter(path, frame_format, 1) {}
    GifWriter(const GifWriter&) = delete;
    GifWriter& operator=(const GifWriter&) = delete;
    ~GifWriter() override { ffmpeg.abandon(); } // stops ffmpeg before removing the files ffmpeg writes

  private:
    Failure start() override {
        if (auto failure = waiting.create(target, ".frames.mkv")) return failure;
        if (auto failure = palette.create(target, ".palette.png")) return failure;
        return MovieWriter::start();
    }

    Arguments encoding() const override {
        return {"-filter_complex",
                "split[frames][seen];[seen]palettegen=stats_mode=diff[palette]",
                "-map",
                "[palette]",
                "-c:v",
                "png",
                "-f",
                "image2pipe",
                url(palette.path()),
                "-map",
                "[frames]",
                "-c:v",
                "libx264rgb",
                "-preset",
                "ultrafast",
                "-qp",
                "0",
                "-f",
                "matroska",
                url(waiting.path())};
    }

    Failure complete() override {
        if (auto failure = MovieWriter::complete(); failure || interrupted()) return failure;
        const Arguments colouring = {"-f",
                                     "matroska",
                                     "-i",
                                     url(waiting.path()),
                                     "-f",
                                     "png_pipe",
                                     "-i",
                                     url(palette.path()),
                                     "-lavfi",
                                     "paletteuse=dither=none:diff_mode=rectangle",
                                     "-loop",
                                     "0",
                                     "-f",
                                     "gif",
                                     url(partial.path())};
        if (auto failure = run(colouring)) return failure;
        return MovieWriter::complete();
    }

    void abandon() override {
        MovieWriter::abandon();
        waiting.discard();
        palette.discard();
    }

    PartialFile waiting, palette;
};

} // namespace

Opened open_mp4(const fs::path& target, const FrameFormat& format) {
    return begun(std::make_unique<Mp4Writer>(target, format));
}

Opened open_gif(const fs::path& target, const FrameFormat& format) {
    return begun(std::make_unique<GifWriter>(target, format));
}

Opened open_webm(const fs::path& target, const FrameFormat& format) {
    return begun(std::make_unique<WebmWriter>(target, format));
}

Opened open_webp(const fs::path& target, const FrameFormat& format) {
    return begun(std::make_unique<WebpWriter>(target, format));
}

} // namespace sinew::canvas
