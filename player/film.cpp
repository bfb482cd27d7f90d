#include "player/film.h"

#include "canvas/formats.h"

#include <utility>

namespace sinew::play {

Film::~Film() {
    if (recording()) (void)finish();
}

std::optional<std::string> Film::begin(std::filesystem::path path, int width, int height) {
    path_ = std::move(path);
    auto opened = canvas::open(path_, {.width = width, .height = height, .fps = rate});
    if (opened.failure) return opened.failure;
    writer_ = std::move(opened.writer);
    width_ = width, height_ = height;
    due_ = 0;
    return std::nullopt;
}

void Film::begin(std::filesystem::path path, std::unique_ptr<files::Exporter> exporter) {
    path_ = std::move(path);
    exporter_ = std::move(exporter);
    due_ = 0;
}

std::optional<std::string> Film::finish() {
    const auto writer = std::exchange(writer_, nullptr);
    const auto exporter = std::exchange(exporter_, nullptr);
    return exporter ? exporter->finish() : writer->finish();
}

std::optional<std::string> Film::add(const Session& session, const Picture& picture) {
    for (; wants_frame(); due_ += 1 / rate)
        if (auto failure = exporter_ ? exporter_->frame(session) : writer_->frame(picture)) {
            writer_.reset(), exporter_.reset();
            return failure;
        }
    return std::nullopt;
}

} // namespace sinew::play
