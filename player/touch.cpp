#include "player/touch.h"

#include <algorithm>

namespace sinew::play {
namespace {

Vec2<double> middle(Vec2<double> a, Vec2<double> b) {
    return (a + b) * 0.5;
}

} // namespace

std::optional<Vec2<double>> Touch::position_of(std::int64_t finger) const {
    const auto found = std::ranges::find(fingers_, finger, &Finger::id);
    return found == fingers_.end() ? std::nullopt : std::optional(found->at);
}

void Touch::down(std::int64_t finger, Vec2<double> at) {
    at = within_reach(at);
    if (position_of(finger)) return;
    fingers_.push_back({finger, at});
    if (fingers_.size() == 1) {
        points_ = true;
        play_.handle(Moved{at});
        play_.handle(Pressed{});
    } else if (points_) {
        points_ = false;
        play_.handle(Released{});
    }
}

void Touch::move(std::int64_t finger, Vec2<double> to) {
    to = within_reach(to);
    const auto found = std::ranges::find(fingers_, finger, &Finger::id);
    if (found == fingers_.end()) return;
    if (points_) play_.handle(Moved{to});
    if (fingers_.size() == 2) {
        const auto& other = fingers_[found == fingers_.begin() ? 1 : 0];
        constexpr double close = 8; // pixels: the distance of touching fingers is too uncertain for a ratio
        const double before = max(distance(found->at, other.at), close), after = max(distance(to, other.at), close);
        const auto from = middle(found->at, other.at), at = middle(to, other.at);
        play_.handle(Moved{at});
        play_.handle(Pinched{at - from, after / before});
    }
    found->at = to;
}

void Touch::up(std::int64_t finger) {
    const auto gone = std::erase_if(fingers_, [&](const Finger& one) { return one.id == finger; });
    if (gone == 0) return;
    if (points_) play_.handle(Released{});
    points_ = false;
    if (fingers_.empty()) play_.handle(Left{});
}

} // namespace sinew::play
