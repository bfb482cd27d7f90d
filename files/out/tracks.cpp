#include "files/out/tracks.h"

#include "files/out/linear_keys.h"

#include <algorithm>
#include <iterator>

namespace sinew::files {
namespace {

/// Points of a shape; of an image, the rim of its grid.
std::vector<Vec2<float>> outline_of(const Picture& picture, const Picture::Item& item) {
    const auto points = picture.points_of(item);
    if (item.shape != Shape::image || item.across < 2) return {points.begin(), points.end()};
    const std::size_t across = item.across, down = points.size() / across;
    std::vector<Vec2<float>> rim;
    for (std::size_t c = 0; c < across; ++c) rim.push_back(points[c]);
    for (std::size_t r = 1; r < down; ++r) rim.push_back(points[r * across + across - 1]);
    for (std::size_t c = across - 1; c-- > 0;) rim.push_back(points[(down - 1) * across + c]);
    for (std::size_t r = down - 1; r-- > 1;) rim.push_back(points[r * across]);
    return rim;
}

/// Mean of an image's pixels, which are premultiplied.
Color mean_of(const Image& image) {
    double sum[4] = {};
    for (const auto pixel : image.pixels)
        for (int c = 0; c < 4; ++c) sum[c] += double(pixel >> (8 * c) & 255);
    const auto share = [&](int c) { return sum[3] > 0 ? float(sum[c] / sum[3]) : 0; };
    const double all = 255 * double(std::max<std::size_t>(image.pixels.size(), 1));
    return {share(2), share(1), share(0), float(sum[3] / all)};
}

Color color_of(const Picture& picture, const Picture::Item& item) {
    if (item.shape != Shape::image) return item.color;
    if (item.number >= picture.images.size() || !picture.images[item.number]) return {0, 0, 0, 0};
    return mean_of(*picture.images[item.number]);
}

std::string text_of(const Picture& picture, const Picture::Item& item) {
    return item.shape == Shape::text ? picture.texts[item.number] : std::string();
}

Shape shape_of(const Picture::Item& item) {
    return item.shape == Shape::image ? Shape::polygon : item.shape;
}

std::size_t points_of(const Picture& picture, const Picture::Item& item) {
    return item.shape == Shape::image ? outline_of(picture, item).size() : item.count;
}

bool goes_on(const Track& track, const Picture& picture, const Picture::Item& item) {
    return track.shape == shape_of(item) && track.points == points_of(picture, item) &&
           track.text == text_of(picture, item);
}

} // namespace

std::vector<std::size_t> keys_of(const Track& track, double tolerance, bool steps) {
    constexpr float color_tolerance = 0.02F;
    const std::size_t count = track.numbers_per_frame(), last = track.frames() - 1;
    std::vector<std::size_t> keys{0};
    if (steps) {
        for (std::size_t i = 1; i <= last; ++i)
            if (!std::equal(track.at(i), track.at(i) + count, track.at(i - 1))) keys.push_back(i);
        return keys;
    }
    std::vector<float> tolerances(count, float(tolerance));
    std::fill(tolerances.end() - 4, tolerances.end(), color_tolerance);
    return linear_keys(track.numbers, tolerances);
}

void TrackRecorder::add(const Picture& picture) {
    std::vector<const Picture::Item*> items;
    for (const auto& item : picture.items)
        if (item.shape != Shape::pane && item.count > 0) items.push_back(&item);
    std::vector<Place> now(items.size(), tracks_.end());
    std::size_t front = 0, back = 0;
    const auto fits = [&](std::size_t item, std::size_t track) {
        return goes_on(*present_[track], picture, *items[item]);
    };
    const auto common = std::min(items.size(), present_.size());
    while (front < common && (fits(front, front) || items.size() == present_.size())) {
        if (fits(front, front)) now[front] = present_[front];
        ++front;
    }
    while (front + back < common && fits(items.size() - 1 - back, present_.size() - 1 - back)) {
        now[items.size() - 1 - back] = present_[present_.size() - 1 - back];
        ++back;
    }
    auto next = tracks_.begin();
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (now[i] == tracks_.end()) {
            // Behind the ended track in whose place it is, so that order within a frame is kept.
            if (items.size() == present_.size()) next = std::next(present_[i]);
            now[i] = begin_track(picture, *items[i], next);
        }
        extend(*now[i], picture, *items[i]);
        next = std::next(now[i]);
    }
    present_ = std::move(now);
    ++frames_;
}

TrackRecorder::Place TrackRecorder::begin_track(const Picture& picture, const Picture::Item& item, Place before) {
    has_images_ |= item.shape == Shape::image;
    return tracks_.insert(before, Track{.shape = shape_of(item),
                                        .text = text_of(picture, item),
                                        .first = frames_,
                                        .points = points_of(picture, item),
                                        .numbers = {}});
}

void TrackRecorder::extend(Track& track, const Picture& picture, const Picture::Item& item) {
    for (const auto& p : outline_of(picture, item))
        for (int axis = 0; axis < 2; ++axis) track.numbers.push_back(p[axis]);
    const auto color = color_of(picture, item);
    for (const float number : {item.width, color.red, color.green, color.blue, color.alpha})
        track.numbers.push_back(number);
    numbers_ += track.numbers_per_frame();
}

} // namespace sinew::files
