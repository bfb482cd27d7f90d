#include "player/tour.h"

#include <array>

namespace sinew::play {
namespace {

struct TourStep {
    std::string_view text, done; ///< the event that ends the step
};

constexpr std::array steps = {
    TourStep{"Drag anything, and throw it: the nearest part is taken hold of.", "let_go"},
    TourStep{"Draw across something with the right button: it is cut.", "cut"},
    TourStep{"Space pauses and goes on; r starts again; the line below goes back in time.", "pause"},
    TourStep{"Scenes are at the right: press one.", "scene"},
    TourStep{"Tools are at the left: ropes, forms, walls, joints; select moves, turns, scales and copies.", "tool"},
    TourStep{"The wheel zooms, the middle button moves the picture. F1 shows the keys, Help this tour again.", "end"},
};

} // namespace

std::size_t Tour::count() {
    return steps.size();
}

void Tour::advance(double seconds) {
    if (!is_on()) return;
    age_ += seconds;
    if (age_ < each) return;
    ++step_, age_ = 0;
}

void Tour::hear(std::string_view what) {
    if (!is_on() || steps[step_].done != what) return;
    ++step_, age_ = 0;
}

std::string Tour::text() const {
    if (!is_on()) return "";
    return std::to_string(step_ + 1) + "/" + std::to_string(steps.size()) + "  " + std::string(steps[step_].text) +
           "  (Escape ends the tour)";
}

} // namespace sinew::play
