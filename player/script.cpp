#include "player/script.h"

#include "sinew/scene/diagnostic.h"
#include "sinew/scene/text.h"
#include "sinew/world/edit.h"

#include "player/files.h"
#include "player/touch.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <sstream>

namespace sinew::play {
namespace {

/// A number whose whole part is exact in a double and in an integer.
std::optional<double> number_of(const std::string& text) {
    constexpr double largest = 1e15;
    double number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size() || !(std::fabs(number) <= largest))
        return std::nullopt;
    return number;
}

std::optional<Button> button_of(const std::vector<std::string>& words) {
    if (words.empty() || words[0] == "left") return Button::left;
    if (words[0] == "middle") return Button::middle;
    if (words[0] == "right") return Button::right;
    return std::nullopt;
}

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream stream(line.substr(0, line.find('#')));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::optional<ParticleId> particle_called(const std::string& name, const Play& play) {
    return std::visit([&](const auto& world) { return find_particle(world, name); }, play.session().world());
}

std::optional<Vec2<double>> pixel_of(ParticleId id, const Play& play) {
    const auto position = position_of(play.session().world(), {&id, 1});
    const auto seen = position ? play.view().see(position->as<3, double>()) : std::nullopt;
    return seen ? std::optional(cast<double>(seen->pixel)) : std::nullopt;
}

/// Motion of the pointer on a straight line to a pixel, or to a particle wherever the particle goes meanwhile.
class Glide {
  public:
    explicit Glide(Play& play) : play_(play) {}

    void begin(Vec2<double> to, std::optional<ParticleId> followed, double at, double over) {
        from_ = play_.pointer();
        to_ = to;
        followed_ = followed;
        since_ = at, until_ = at + over;
        if (over == 0) go(at);
    }

    void go(double now) {
        if (!to_) return;
        if (followed_)
            if (const auto pixel = pixel_of(*followed_, play_)) to_ = pixel;
        const double share = until_ > since_ ? std::clamp((now - since_) / (until_ - since_), 0.0, 1.0) : 1.0;
        play_.handle(Moved{from_ + (*to_ - from_) * share});
        if (share >= 1) to_.reset();
    }

    bool over() const { return !to_; }

  private:
    Play& play_;
    Vec2<double> from_{};
    std::optional<Vec2<double>> to_; ///< empty at rest
    std::optional<ParticleId> followed_;
    double since_ = 0, until_ = 0; ///< seconds
};

/// A finger in motion.
struct Slide {
    std::int64_t finger = 0;
    Vec2<double> from, to;
    double since = 0, until = 0;

    Vec2<double> at(double now) const {
        return from + (to - from) * std::clamp((now - since) / (until - since), 0.0, 1.0);
    }
};

/// Runs the lines of a script at their times.
class Player {
  public:
    Player(const Script& script, Play& play) : script_(script), play_(play), touch_(play), glide_(play) {}

    /// Carries out all lines due at `now`; returns the reason of the first failure.
    std::string perform(double now) {
        glide_.go(now);
        for (auto& slide : slides_) touch_.move(slide.finger, slide.at(now));
        std::erase_if(slides_, [&](const Slide& slide) { return now >= slide.until; });
        for (; next_ < script_.lines.size() && script_.lines[next_].at <= now; ++next_) {
            const auto& line = script_.lines[next_];
            if (auto problem = perform(line); !problem.empty()) return concat("line ", line.number, ": ", problem);
            if (over_) return "";
        }
        return "";
    }

    bool over() const {
        return over_ || (next_ == script_.lines.size() && glide_.over() && slides_.empty()) || play_.quit;
    }

    /// An action of scripts.
    struct Action {
        std::string_view name;
        std::size_t min, max; ///< number of words after the name
        std::string (Player::*perform)(double at, const std::vector<std::string>& words);
    };
    static std::span<const Action> actions();

  private:
    const Script& script_;
    Play& play_;
    Touch touch_;
    Glide glide_;
    std::vector<Slide> slides_;
    std::size_t next_ = 0;
    bool over_ = false;
    std::string perform(const ScriptLine& line);

    // --- actions: each returns the reason of failure, or nothing -------------------------------------------------

    using Words = std::vector<std::string>;

    std::string press(double, const Words& words) {
        const auto button = button_of(words);
        if (!button) return no_button(words);
        play_.handle(Pressed{*button});
        return "";
    }
    std::string release(double, const Words& words) {
        const auto button = button_of(words);
        if (!button) return no_button(words);
        play_.handle(Released{*button});
        return "";
    }
    static std::string no_button(const Words& words) { return "no button is called " + in_quotes(words[0]); }

    std::string scroll(double, const Words& words) {
        const auto amount = number_of(words[0]);
        if (!amount) return no_number(words);
        play_.handle(Scrolled{*amount});
        return "";
    }
    std::string go(double, const Words& words) {
        const auto step = number_of(words[0]);
        if (!step) return no_number(words);
        play_.go_to(std::uint64_t(std::max(*step, 0.0)));
        return "";
    }
    static std::string no_number(const Words& words) { return "expected a number, found " + in_quotes(words[0]); }

    std::string key(double, const Words& words) {
        play_.handle(Key{words[0]});
        play_.handle(KeyUp{words[0]});
        return "";
    }
    std::string key_down(double, const Words& words) {
        play_.handle(Key{words[0]});
        return "";
    }
    std::string key_up(double, const Words& words) {
        play_.handle(KeyUp{words[0]});
        return "";
    }
    std::string lift(double, const Words& words) {
        const auto finger = number_of(words[0]);
        if (!finger) return "expected the number of a finger";
        touch_.up(std::int64_t(*finger));
        return "";
    }
    std::string set(double, const Words& words) {
        const auto equals = std::min(words[0].find('='), words[0].size() - 1);
        play_.set(words[0].substr(0, equals), words[0].substr(equals + 1));
        return "";
    }
    std::string open(double, const Words& words) {
        play_.open(words[0]);
        return "";
    }
    std::string save(double, const Words& words) {
        play_.save(words[0]);
        return "";
    }
    std::string save_state(double, const Words& words) {
        play_.save_state(words[0]);
        return "";
    }
    std::string shoot(double, const Words& words) {
        play_.screenshot(words[0]);
        return "";
    }
    std::string end(double, const Words&) {
        over_ = true;
        return "";
    }
    std::string choose(double, const Words& words) {
        if (!play_.path_request) return "no path was asked for";
        play_.choose(words[0]);
        return "";
    }

    std::string move(double at, const Words& words) {
        constexpr double usual = 0.2;
        std::optional<Vec2<double>> to;
        std::optional<ParticleId> followed;
        std::size_t used = 1;
        if (const auto x = number_of(words[0])) {
            const auto y = words.size() > 1 ? number_of(words[1]) : std::nullopt;
            if (!y) return "expected two pixels or a particle";
            to = {{*x, *y}};
            used = 2;
        } else {
            followed = particle_called(words[0], play_);
            if (!followed) return "no particle is called " + in_quotes(words[0]);
            to = pixel_of(*followed, play_);
            if (!to) return in_quotes(words[0]) + " is behind the eye";
        }
        double over = usual;
        if (words.size() > used) {
            const auto said =
                words.size() == used + 2 && words[used] == "over" ? number_of(words[used + 1]) : std::nullopt;
            if (!said || *said < 0) return "expected `over` and seconds after the position";
            over = *said;
        }
        glide_.begin(*to, followed, at, over);
        return "";
    }

    std::string touch(double at, const Words& words) {
        const auto finger = number_of(words[0]), x = number_of(words[1]), y = number_of(words[2]);
        if (!finger || !x || !y) return "expected the number of a finger and two pixels";
        const auto over = words.size() == 5 && words[3] == "over" ? number_of(words[4]) : std::nullopt;
        if (words.size() > 3 && (!over || *over < 0)) return "expected `over` and seconds after the position";
        const auto id = std::int64_t(*finger);
        const Vec2<double> to{{*x, *y}};
        const auto from = touch_.position_of(id);
        if (!from) touch_.down(id, to);
        if (from && over.value_or(0) > 0)
            slides_.push_back({id, *from, to, at, at + *over});
        else
            touch_.move(id, to);
        return "";
    }

    std::string answer(double, const Words& words) {
        const auto& name = words[0];
        if (!play_.question) return "nothing was asked";
        std::vector<std::string_view> names;
        for (const auto& one : play_.question->answers) names.push_back(one.name);
        if (std::ranges::find(names, name) == names.end())
            return in_quotes(name) + " is no answer; " + suggest(name, names);
        play_.answer(name);
        return "";
    }

    std::string paste(double, const Words& words) {
        const auto& path = words[0];
        constexpr std::size_t max = 64u << 20; // bytes
        const auto text = read_file(path, max);
        if (!text) return path + " cannot be read";
        play_.open_text(*text, path);
        return "";
    }

    std::string where(double, const Words& words) {
        const auto& name = words[0];
        const auto id = particle_called(name, play_);
        const auto position = id ? position_of(play_.session().world(), {&*id, 1}) : std::nullopt;
        if (!position) return "no particle is called " + in_quotes(name);
        json::Array at;
        for (int i = 0; i < play_.session().scene().dimension; ++i) at.push_back((*position)[i]);
        json::Object told{{"particle", name}, {"at", std::move(at)}};
        if (const auto seen = play_.view().see(position->as<3, double>()))
            told.push_back({"pixel", json::Array{double(seen->pixel[0]), double(seen->pixel[1])}});
        play_.tell("where", std::move(told));
        return "";
    }
};

std::span<const Player::Action> Player::actions() {
    static constexpr Action list[] = {
        {"move", 1, 4, &Player::move},       {"press", 0, 1, &Player::press},
        {"release", 0, 1, &Player::release}, {"scroll", 1, 1, &Player::scroll},
        {"key", 1, 1, &Player::key},         {"where", 1, 1, &Player::where},
        {"set", 1, 1, &Player::set},         {"open", 1, 1, &Player::open},
        {"drop", 1, 1, &Player::open},       {"go", 1, 1, &Player::go},
        {"save", 1, 1, &Player::save},       {"shot", 1, 1, &Player::shoot},
        {"end", 0, 0, &Player::end},         {"touch", 3, 5, &Player::touch},
        {"lift", 1, 1, &Player::lift},       {"state", 1, 1, &Player::save_state},
        {"answer", 1, 1, &Player::answer},   {"choose", 1, 1, &Player::choose},
        {"paste", 1, 1, &Player::paste},     {"down", 1, 1, &Player::key_down},
        {"up", 1, 1, &Player::key_up},
    };
    return list;
}

const Player::Action* action_called(std::string_view name) {
    const auto actions = Player::actions();
    const auto found = std::ranges::find(actions, name, &Player::Action::name);
    return found == actions.end() ? nullptr : &*found;
}

std::string Player::perform(const ScriptLine& line) {
    const auto* action = action_called(line.action);
    return action ? (this->*action->perform)(line.at, line.words) : "nobody can " + in_quotes(line.action);
}

/// Parses one line; returns the reason of failure, or nothing.
std::string read_line(const std::vector<std::string>& words, std::size_t number, Script& script) {
    if (words[0] == "size" && words.size() == 2) {
        const auto cross = words[1].find('x');
        const auto width = number_of(words[1].substr(0, cross));
        const auto height = cross == std::string::npos ? std::nullopt : number_of(words[1].substr(cross + 1));
        if (!width || !height || *width < 1 || *height < 1 || *width > 16384 || *height > 16384)
            return "expected a size as 1280x720, found " + in_quotes(words[1]);
        script.width = int(*width), script.height = int(*height);
        return "";
    }
    if (words[0] == "fps" && words.size() == 2) {
        const auto fps = number_of(words[1]);
        if (!fps || *fps < 1 || *fps > 1000)
            return "expected frames a second from 1 to 1000, found " + in_quotes(words[1]);
        script.fps = *fps;
        return "";
    }
    const auto at = number_of(words[0]);
    if (!at || *at < 0) return "expected a second, found " + in_quotes(words[0]);
    if (words.size() < 2) return "nothing to do at that second";
    if (!script.lines.empty() && script.lines.back().at > *at) return "it is earlier than the line before";
    const auto* action = action_called(words[1]);
    if (!action) {
        std::vector<std::string_view> names;
        for (const auto& known : Player::actions()) names.push_back(known.name);
        return "nobody can " + in_quotes(words[1]) + "; " + suggest(words[1], names);
    }
    const auto count = words.size() - 2;
    if (count < action->min || count > action->max)
        return concat(in_quotes(words[1]), " with ", count, count == 1 ? " word" : " words");
    script.lines.push_back({*at, words[1], {words.begin() + 2, words.end()}, number});
    return "";
}

} // namespace

ReadScript read_script(const std::string& text) {
    ReadScript read;
    std::istringstream stream(text);
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        const auto words = words_of(line);
        if (words.empty()) continue;
        if (auto problem = read_line(words, number, read.script); !problem.empty())
            return {{}, concat("line ", number, ": ", problem)};
    }
    return read;
}

std::string run_script(const Script& script, Play& play, const std::function<void(double)>& frame) {
    Player player(script, play);
    std::vector<Picture> pictures;
    play.resize(script.width, script.height);
    for (std::uint64_t i = 0; !player.over(); ++i) {
        const double now = double(i) / script.fps;
        if (auto problem = player.perform(now); !problem.empty()) return problem;
        play.draw_panes(pictures);
        if (frame) frame(now);
        play.advance(1 / script.fps);
    }
    return "";
}

} // namespace sinew::play
