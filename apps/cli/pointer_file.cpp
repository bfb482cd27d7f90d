#include "apps/cli/pointer_file.h"

#include "sinew/scene/text.h"
#include "sinew/session/pick.h"
#include "sinew/session/view.h"

#include "apps/cli/console.h"
#include "apps/cli/scene_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace sinew::cli {
namespace {

constexpr std::string_view shape = "a line is TIME, X, Y, BUTTON: 30, 320, 240, 1 holds what is there at that time";
constexpr std::size_t max_bytes = std::size_t(1) << 26U;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r";
    const auto first = text.find_first_not_of(blank);
    return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// Spreadsheets begin their files with a mark of UTF-8.
std::string_view without_mark(std::string_view text) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

bool is_separator(char c) {
    return c == ',' || c == ';' || c == ' ' || c == '\t';
}

/// Four numbers of a line, separated by commas or blanks; empty if the line differs.
std::optional<std::array<double, 4>> numbers_of(std::string_view line) {
    std::array<double, 4> numbers{};
    const char *at = line.data(), *end = at + line.size();
    for (auto& number : numbers) {
        while (at != end && is_separator(*at)) ++at;
        const auto [stop, error] = std::from_chars(at, end, number);
        if (error != std::errc() || !std::isfinite(number) || (stop != end && !is_separator(*stop))) return {};
        at = stop;
    }
    return at == end ? std::optional(numbers) : std::nullopt;
}

/// True for empty lines, comments, and the column headings.
bool is_no_sample(std::string_view line, std::size_t number) {
    return line.empty() || line[0] == '#' || (number == 1 && line.starts_with("time"));
}

[[noreturn]] void refuse_line(const std::filesystem::path& path, std::size_t number, std::string_view message) {
    refuse(fmt::format("{}:{}", path.string(), number), message, shape);
}

double end_of_step(const Session& session) {
    const double now = std::visit([](const auto& world) { return world.time; }, session.world());
    return now + step_length(session.scene());
}

} // namespace

PointerPath PointerPath::read(const std::filesystem::path& path) {
    const auto file = read_text(path, max_bytes);
    const auto text = without_mark(file);
    PointerPath read;
    std::size_t number = 1;
    for (std::size_t begin = 0; begin < text.size(); ++number) {
        const auto end = std::min(text.find('\n', begin), text.size());
        const auto line = trimmed(text.substr(begin, end - begin));
        begin = end + 1;
        if (is_no_sample(line, number)) continue;
        const auto numbers = numbers_of(line);
        if (!numbers) refuse_line(path, number, fmt::format("{} is not four numbers", in_quotes(line)));
        const auto [time, x, y, button] = *numbers;
        if (!read.samples_.empty() && time <= read.samples_.back().time)
            refuse_line(path, number,
                        fmt::format("time {} is not after {}, the line before", time, read.samples_.back().time));
        read.samples_.push_back({time, x, y, button != 0});
    }
    if (read.samples_.empty()) refuse(path.string(), "no line of a pointer's path", shape);
    return read;
}

/// Sample at `time`: the button of the last line, the position interpolated linearly to the next line.
PointerSample PointerPath::now(double time) {
    const double rounding = 1e-9 * std::fabs(time);
    while (next_ < samples_.size() && samples_[next_].time <= time + rounding) ++next_;
    auto sample = samples_[next_ - 1];
    if (next_ == samples_.size()) return sample;
    const auto& ahead = samples_[next_];
    const double share = std::fmax(time - sample.time, 0) / (ahead.time - sample.time);
    sample.x += (ahead.x - sample.x) * share;
    sample.y += (ahead.y - sample.y) * share;
    return sample;
}

std::vector<play::Action> PointerPath::moves(const Session& session) {
    const double time = end_of_step(session);
    if (time < samples_.front().time * (1 - 1e-9)) return {};
    const auto& scene = session.scene();
    const View view(scene, session.focus(), scene.view.size[0], scene.view.size[1]);
    const auto sample = now(time);
    Vec2<double> pixel{{sample.x, sample.y}};
    Point position{{sample.x, sample.y, 0}};
    if (scene.dimension == 2)
        pixel = cast<double>(view.see({{sample.x, sample.y, 0}})->pixel);
    else
        position = view.position_of(pixel, depth_);
    std::vector<play::Action> actions{play::PointAt{position}};
    if (sample.pressed && !pressed_)
        if (auto grab = press(session, view, pixel)) actions.emplace_back(std::move(*grab));
    if (!sample.pressed && pressed_) actions.emplace_back(play::LetGo{});
    pressed_ = sample.pressed;
    if (pressed_) actions.emplace_back(play::Drag{scene.dimension == 2 ? position : view.position_of(pixel, depth_)});
    return actions;
}

std::optional<play::Grab> PointerPath::press(const Session& session, const View& view, Vec2<double> pixel) {
    const auto picked = pick(session.world(), view, pixel, pick_radius);
    if (!picked) return std::nullopt;
    depth_ = picked->depth;
    return play::Grab{play::rows_of(session.world(), picked->members), picked->position};
}

} // namespace sinew::cli
