#include "files/out/frame_name.h"

#include <string>
#include <string_view>

namespace sinew::files {
namespace {

struct Place {
    std::size_t begin = std::string::npos, end = 0; ///< of "%04d" in the name
    std::size_t digits = 0;
    bool zeros = false;
    bool found() const { return begin != std::string::npos; }
};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// The number's place at a percent sign; not found if another letter follows.
Place place_at(std::string_view name, std::size_t percent) {
    Place place{.begin = percent};
    std::size_t i = percent + 1;
    if (i < name.size() && name[i] == '0') place.zeros = true, ++i;
    if (i < name.size() && is_digit(name[i])) place.digits = std::size_t(name[i++] - '0');
    if (i >= name.size() || name[i] != 'd') return {};
    place.end = i + 1;
    return place;
}

Place place_in(std::string_view name) {
    for (std::size_t i = 0; i + 1 < name.size(); ++i) {
        if (name[i] != '%') continue;
        if (name[i + 1] == '%')
            ++i;
        else if (const auto place = place_at(name, i); place.found())
            return place;
    }
    return {};
}

std::string without_doubles(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        plain += text[i];
        if (text[i] == '%' && i + 1 < text.size() && text[i + 1] == '%') ++i;
    }
    return plain;
}

} // namespace

bool has_frame_number(const std::filesystem::path& path) {
    return place_in(path.filename().string()).found();
}

canvas::Failure frame_number_problem(const std::filesystem::path& path) {
    const auto name = path.filename().string();
    const auto place = place_in(name);
    if (place.found() && place_in(std::string_view(name).substr(place.end)).found())
        return path.string() + " has two places for the number of a frame";
    return {};
}

std::filesystem::path frame_path(const std::filesystem::path& pattern, std::size_t number) {
    const auto name = pattern.filename().string();
    const auto place = place_in(name);
    if (!place.found()) return pattern;
    auto digits = std::to_string(number);
    if (digits.size() < place.digits) digits.insert(0, place.digits - digits.size(), place.zeros ? '0' : ' ');
    return pattern.parent_path() / (without_doubles(std::string_view(name).substr(0, place.begin)) + digits +
                                    without_doubles(std::string_view(name).substr(place.end)));
}

} // namespace sinew::files
