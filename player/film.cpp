#include "player/film.h"

#include "canvas/formats.h"

#include <utility>

namespace sinew::play {

Film::~Film() {
    if (writer_) (void)writer_->finish();
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

std::optional<std::string> Film::finish() {
    const auto writer = std::exchange(writer_, nullptr);
    return writer->finish();
}

std::optional<std::string> Film::add(const Picture& picture) {
    for (; wants_frame(); due_ += 1 / rate)
        if (auto failure = writer_->frame(picture)) {
            writer_.reset();
            return failure;
        }
    return std::nullopt;
}

} // namespace sinew::play
