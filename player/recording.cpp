#include "player/recording.h"

#include "sinew/scene/check.h"
#include "sinew/scene/reader.h"
#include "sinew/scene/text.h"
#include "sinew/session/pick.h"

#include "player/recording_format.h"
#include "player/saved_action.h"

#include <algorithm>
#include <cstring>

namespace sinew::play {
namespace {

using format::Type;
using snapshot::ByteReader;
using Bytes = std::vector<std::byte>;
constexpr std::uint64_t enough_memory = std::uint64_t(1) << 40;

Point point_of(ByteReader& reader, int count) {
    Point point;
    for (int i = 0; i < count; ++i) point[i] = reader.number<double>();
    for (const double number : point.component)
        if (!is_finite(number)) reader.fail("a position that is not finite");
    return point;
}

std::string text_of(ByteReader& reader) {
    std::string text(reader.listed(1), '\0');
    reader.read(text.data(), text.size());
    return text;
}

/// Reads frame by frame.
class RecordingReader {
  public:
    RecordingReader(std::span<const std::byte> bytes, const SceneOpener& open) : bytes_(bytes), open_(open) {}

    std::optional<Recording> read(SnapshotError& error) {
        if (!is_recording(bytes_)) return refused(error, 0, "not a recording of Sinew");
        std::uint32_t found = 0;
        if (bytes_.size() < format::head_size) return refused(error, bytes_.size(), "ends within the header");
        std::memcpy(&found, bytes_.data() + format::magic.size(), sizeof found);
        if (found != format::version)
            return refused(error, format::magic.size(),
                           concat("version ", found, " of the format; this program reads version ", format::version));
        for (at_ = format::head_size; at_ < bytes_.size();) {
            if (const auto problem = read_frame(); !problem.empty()) return refused(error, fault_at_, problem);
            if (recording_.cut_short) break;
        }
        if (recording_.entries.empty()) return refused(error, bytes_.size(), "ends before its scene");
        return std::move(recording_);
    }

  private:
    std::span<const std::byte> bytes_;
    const SceneOpener& open_;
    Recording recording_;
    std::vector<std::size_t> end_of_step_{1}; ///< by steps taken: number of entries before the next step
    std::size_t at_ = 0, fault_at_ = 0;
    std::uint64_t chain_ = 0;

    static std::nullopt_t refused(SnapshotError& error, std::size_t at, std::string what) {
        error = {at, std::move(what), {}};
        return std::nullopt;
    }
    std::string problem(std::size_t at, std::string what) {
        fault_at_ = at;
        return what.empty() ? "damaged" : what;
    }

    /// A problem, or empty. At an incomplete frame `cut_short` is set.
    std::string read_frame() {
        ByteReader reader(bytes_.subspan(at_), at_, enough_memory);
        const auto type = reader.number<std::uint8_t>();
        if (type >= format::types) return problem(at_, "damaged: an entry of no known type");
        const auto begin = reader.left();
        const auto head_so_far = [&] { return begin - reader.left() + 1; };
        std::size_t size = 4; // of the content
        if (Type(type) == Type::drag || Type(type) == Type::point) {
            size = 8 * reader.number<std::uint8_t>();
            if (size > 24) return problem(at_, "damaged: a position of more than three numbers");
        } else if (Type(type) != Type::step) {
            size = std::size_t(reader.count());
            const auto expected = format::head_checksum(chain_, bytes_.subspan(at_, head_so_far()));
            if (reader.number<std::uint16_t>() != expected && !reader.failed())
                return problem(at_, concat("damaged: the length of an entry, after step ", recording_.steps));
        }
        const auto head = head_so_far();
        const auto checksum = format::checksum_size(Type(type));
        if (reader.failed() || size > reader.left() || checksum > reader.left() - size) {
            recording_.cut_short = at_;
            return {};
        }
        const auto frame = bytes_.subspan(at_, head + size);
        chain_ = format::chained(chain_, frame);
        if (std::memcmp(bytes_.data() + at_ + frame.size(), &chain_, checksum) != 0)
            return problem(at_, concat("damaged: the checksum of the entry differs, after step ", recording_.steps));
        ByteReader content(frame.subspan(head), at_ + head, enough_memory);
        if (auto what = take(Type(type), content, size); !what.empty()) return problem(at_, std::move(what));
        if (content.failed()) return problem(content.error().at, content.error().what);
        at_ += frame.size() + checksum;
        return {};
    }

    template <class What> std::string add(What what) {
        recording_.entries.push_back({std::move(what), at_});
        return {};
    }
    std::string take(Type type, ByteReader& content, std::size_t size) {
        const bool begins = type == Type::scene || type == Type::moment;
        if (recording_.entries.empty() && !begins) return "an entry before the scene";
        if (!recording_.entries.empty() && type == Type::scene) return "a second scene";
        switch (type) {
        case Type::scene: {
            auto text = text_of(content);
            return add(recorded::Scene{std::move(text), text_of(content)});
        }
        case Type::moment:
            return take_moment(content, size);
        case Type::step:
            return take_step(content);
        case Type::drag:
            return add(recorded::Act{Drag{point_of(content, dimensions(content, size))}});
        case Type::point:
            return add(recorded::Act{
                PointAt{size == 0 ? std::nullopt : std::optional(point_of(content, dimensions(content, size)))}});
        case Type::action:
            return take_action(content, size);
        case Type::restart:
            return add(recorded::Act{Restart{}});
        case Type::back:
            return take_back(content);
        case Type::places:
            return take_places(content, size);
        }
        return {};
    }
    static int dimensions(ByteReader& content, std::size_t size) {
        if (size == 16 || size == 24) return int(size / 8);
        content.fail("a position of neither two nor three numbers");
        return 0;
    }
    std::string take_moment(ByteReader& content, std::size_t size) {
        Bytes bytes(size);
        content.read(bytes.data(), size);
        SnapshotError error;
        if (!snapshot_header(bytes, error)) return error.text();
        return add(recorded::Moment{std::move(bytes)});
    }
    std::string take_step(ByteReader& content) {
        add(recorded::Step{content.number<std::uint32_t>()});
        ++recording_.steps;
        end_of_step_.push_back(recording_.entries.size());
        return {};
    }
    std::string take_back(ByteReader& content) {
        const auto step = content.number<std::uint64_t>();
        if (step > recording_.steps) return "a return to a step that was not taken";
        if (step < recording_.steps) {
            // actions at the step before the next one stay
            auto keep = end_of_step_[std::size_t(step)];
            while (!std::holds_alternative<recorded::Step>(recording_.entries[keep].what)) ++keep;
            recording_.entries.resize(keep);
        }
        recording_.steps = step;
        end_of_step_.resize(std::size_t(step) + 1);
        return {};
    }
    std::string take_places(ByteReader& content, std::size_t size) {
        recorded::Places places;
        const std::size_t dimension = dimension_of_scene();
        if (size % (4 * dimension) != 0) return "positions that are not whole";
        for (std::size_t i = 0; i < size / (4 * dimension); ++i) {
            auto& position = places.positions.emplace_back();
            for (std::size_t k = 0; k < dimension; ++k) position[int(k)] = double(content.number<float>());
        }
        return add(std::move(places));
    }
    std::string take_action(ByteReader& content, std::size_t size) {
        std::string text(size, '\0');
        content.read(text.data(), size);
        auto document = load(text, concat("entry at byte ", at_));
        SavedAction saved;
        Reading reading{.diagnostics = document.diagnostics, .dimension = int(dimension_of_scene())};
        if (document.diagnostics.ok()) sinew::read(document.root, saved, reading);
        if (!document.diagnostics.ok()) return to_text(document.diagnostics, {.color = false, .max = 5});
        auto action = action_of(saved, [&](const json::Value& scene) { return open_(json::to_text(scene), from_); });
        if (!action) return "an edit to a scene that cannot be opened";
        return add(recorded::Act{std::move(*action)});
    }

    std::string from_;
    std::size_t dimension_ = 0;
    /// Number of coordinates of actions, needed before the scene is opened.
    std::size_t dimension_of_scene() {
        if (dimension_ != 0) return dimension_;
        dimension_ = 2;
        const auto& first = recording_.entries.front().what;
        if (const auto* scene = std::get_if<recorded::Scene>(&first)) {
            from_ = scene->from;
            const auto document = load(scene->text, "scene");
            const auto* found = json::find(document.root, "/dimension");
            const auto* number = found ? found->as<json::Number>() : nullptr;
            if (number && number->integer == 3) dimension_ = 3;
        } else if (const auto* moment = std::get_if<recorded::Moment>(&first)) {
            SnapshotError error;
            if (const auto header = snapshot_header(moment->bytes, error)) dimension_ = std::size_t(header->dimension);
        }
        return dimension_;
    }
};

Positions positions_of(const Session& session) {
    Positions all;
    std::visit(
        [&]<int D, class Real>(const World<D, Real>& world) {
            for (const auto& position : world.particles.position) {
                auto& one = all.emplace_back();
                for (int i = 0; i < D; ++i) one[i] = double(position[i]);
            }
        },
        session.world());
    return all;
}

} // namespace

std::optional<Recording> read_recording(std::span<const std::byte> bytes, const SceneOpener& open,
                                        SnapshotError& error) {
    return RecordingReader(bytes, open).read(error);
}

std::vector<LoggedAction> actions_of(const Recording& recording, const SceneOpener& open) {
    std::vector<LoggedAction> actions;
    std::uint64_t steps = 0;
    for (std::size_t i = 1; i < recording.entries.size(); ++i) {
        const auto& what = recording.entries[i].what;
        if (std::holds_alternative<recorded::Step>(what)) ++steps;
        if (const auto* act = std::get_if<recorded::Act>(&what)) actions.push_back({steps, act->action});
        const auto* moment = std::get_if<recorded::Moment>(&what);
        if (!moment) continue;
        SnapshotError error;
        if (auto session = session_of(moment->bytes, open, error))
            actions.push_back({steps, Return{std::make_shared<const Session>(std::move(*session)), {}}});
    }
    return actions;
}

std::optional<Replay> Replay::begin(Recording recording, const SceneOpener& open, SnapshotError& error) {
    error = {};
    const auto& first = recording.entries.front().what;
    std::optional<Session> session;
    if (const auto* scene = std::get_if<recorded::Scene>(&first)) {
        if (auto opened = open(scene->text, scene->from)) session.emplace(std::move(*opened));
    } else {
        session = session_of(std::get<recorded::Moment>(first).bytes, open, error);
    }
    if (!session) return std::nullopt;
    return Replay(std::move(recording), std::move(*session), open);
}

bool Replay::step() {
    for (; next_ < recording_.entries.size(); ++next_) {
        const auto& what = recording_.entries[next_].what;
        if (const auto* act = std::get_if<recorded::Act>(&what)) {
            carry_out(act->action, session_);
        } else if (const auto* places = std::get_if<recorded::Places>(&what)) {
            compare(*places);
        } else if (const auto* moment = std::get_if<recorded::Moment>(&what)) {
            SnapshotError error;
            if (auto back = session_of(moment->bytes, open_, error)) session_ = std::move(*back);
        } else if (const auto* step = std::get_if<recorded::Step>(&what)) {
            session_.step();
            ++taken_, ++next_;
            compare(*step);
            return true;
        }
    }
    return false;
}

void Replay::compare(const recorded::Step& step) {
    if (divergence_) return;
    if (const auto found = short_hash(session_); found != step.hash)
        divergence_ = Divergence{.step = taken_, .recorded = step.hash, .found = found};
}

void Replay::compare(const recorded::Places& places) {
    if (!divergence_ || divergence_->place) return;
    const auto now = positions_of(session_);
    for (std::size_t i = 0; i < std::min(now.size(), places.positions.size()); ++i) {
        const auto& recorded = places.positions[i];
        if (cast<float>(now[i]) == cast<float>(recorded)) continue;
        divergence_->place = Divergence::Place{
            taken_, Row(i), name_of(session_.world(), id_at(session_.world(), Row(i))), recorded, now[i]};
        return;
    }
}

} // namespace sinew::play
