#include "canvas/progress.h"

#include <algorithm>
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>

namespace sinew::canvas {
namespace {

std::size_t columns_of(std::FILE* stream) {
    winsize size{};
    return ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// `4:07`, or `1:02:30` from an hour on.
std::string clock_text(double seconds) {
    char text[48];
    const long s = long(std::min(seconds, 359999.0) + 0.5); // 99:59:59
    if (s < 3600)
        std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
    else
        std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    return text;
}

} // namespace

Progress::Progress(std::string label_, std::size_t total_, std::FILE* stream_)
    : label(std::move(label_)), total(std::max<std::size_t>(total_, 1)), stream(stream_),
      visible(isatty(fileno(stream_)) != 0) {}

void Progress::update(std::size_t done) {
    const auto now = Clock::now();
    if (!visible || now < next_redraw) return;
    next_redraw = now + std::chrono::milliseconds(100);

    const double part = double(std::min(done, total)) / double(total);
    const double elapsed = std::chrono::duration<double>(now - begin).count();
    char tail[80];
    std::snprintf(tail, sizeof tail, "  %3d %%  %s", int(100 * part),
                  done == 0 ? "" : (clock_text(elapsed * (1 - part) / part) + " left").c_str());
    const std::size_t taken = label.size() + sizeof "  []  100 %  99:59:59 left";
    const std::size_t columns = columns_of(stream);
    const std::size_t length = columns > taken ? std::min<std::size_t>(columns - taken, 40) : 0;
    const auto filled = std::size_t(part * double(length));
    std::fprintf(stream, "\r%s  [%s%s]%s\033[K", label.c_str(), std::string(filled, '#').c_str(),
                 std::string(length - filled, '-').c_str(), tail);
    std::fflush(stream);
}

Progress::~Progress() {
    if (visible) std::fputs("\r\033[K", stream), std::fflush(stream);
}

} // namespace sinew::canvas
