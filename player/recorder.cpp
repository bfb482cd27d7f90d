#include "sinew/scene/reader.h"
#include "sinew/scene/writer.h"
#include "sinew/world/measure.h"

#include "player/recording.h"
#include "player/recording_format.h"
#include "player/saved_action.h"

#include <algorithm>
#include <utility>

namespace sinew::play {
namespace {

using format::Type;
using snapshot::ByteWriter;
using Bytes = std::vector<std::byte>;

Bytes short_frame(Type type, const std::optional<Point>& position, int dimension) {
    Bytes frame;
    ByteWriter writer(frame);
    writer.number(type);
    writer.number(std::uint8_t(position ? dimension : 0));
    for (int i = 0; position && i < dimension; ++i) writer.number((*position)[i]);
    return frame;
}

/// `chain`: checksum of all frames before.
Bytes long_frame(Type type, const Bytes& content, std::uint64_t chain) {
    Bytes frame;
    ByteWriter writer(frame);
    writer.number(type);
    writer.count(content.size());
    writer.number(format::head_checksum(chain, frame));
    writer.append(content.data(), content.size());
    return frame;
}

void put_text(ByteWriter& writer, std::string_view text) {
    writer.count(text.size());
    writer.append(text.data(), text.size());
}

/// Text of an action, as a record of scene files.
Bytes content_of(const Action& action, int dimension, std::uint64_t step) {
    const auto text = json::to_text(write(saved({step, action}), Writing{.dimension = dimension}));
    Bytes content;
    ByteWriter(content).append(text.data(), text.size());
    return content;
}

bool is_at_start(const Session& session) {
    return std::visit([](const auto& world) { return world.steps == 0; }, session.world()) && !session.holds() &&
           session.happening_count() == 0 && !session.pointer();
}

} // namespace

std::uint32_t short_hash(const Session& session) {
    return std::uint32_t(std::visit([](const auto& world) { return state_hash(world); }, session.world()));
}

Recorder::Recorder(RecordingSink sink, const Session& session, std::string from)
    : sink_(std::move(sink)), from_(std::move(from)) {
    Bytes head;
    ByteWriter writer(head);
    writer.append(format::magic.data(), format::magic.size());
    writer.number(format::version);
    failure_ = sink_(head);
    begin(session);
}

/// The scene, where a session built of it is the same; else the session in full.
void Recorder::begin(const Session& session) {
    if (!is_at_start(session)) return write(long_frame(Type::moment, save(session, from_), chain_), 4);
    Bytes content;
    ByteWriter writer(content);
    put_text(writer, json::to_text(to_json(session.scene())));
    put_text(writer, from_);
    write(long_frame(Type::scene, content, chain_), 4);
}

void Recorder::write(Bytes frame, std::size_t checksum_bytes) {
    if (failure_) return;
    chain_ = format::chained(chain_, frame);
    ByteWriter(frame).append(&chain_, checksum_bytes);
    failure_ = sink_(frame);
}

void Recorder::act(const Action& action, const Session& session) {
    const int dimension = session.scene().dimension;
    if (const auto* drag = std::get_if<Drag>(&action))
        return write(short_frame(Type::drag, drag->position, dimension), 2);
    if (const auto* point = std::get_if<PointAt>(&action))
        return write(short_frame(Type::point, point->position, dimension), 2);
    if (std::holds_alternative<Restart>(action)) return write(long_frame(Type::restart, {}, chain_), 4);
    if (std::holds_alternative<Return>(action)) return write(long_frame(Type::moment, save(session, from_), chain_), 4);
    write(long_frame(Type::action, content_of(action, dimension, steps_), chain_), 4);
}

void Recorder::step(const Session& session) {
    Bytes frame;
    ByteWriter writer(frame);
    writer.number(Type::step);
    writer.number(short_hash(session));
    write(frame, 2);
    if (++steps_ >= next_places_) write_places(session);
}

/// Positions as float, at most 500 bytes a second on average, and once a second at most.
void Recorder::write_places(const Session& session) {
    Bytes content;
    ByteWriter writer(content);
    std::visit(
        [&]<int D, class Real>(const World<D, Real>& world) {
            for (const auto& position : world.particles.position)
                for (int i = 0; i < D; ++i) writer.number(float(position[i]));
        },
        session.world());
    constexpr double bytes_a_second = 500;
    const double seconds = std::max(1.0, double(content.size()) / bytes_a_second);
    next_places_ = steps_ + std::uint64_t(seconds * session.scene().solver.rate);
    write(long_frame(Type::places, content, chain_), 4);
}

void Recorder::go_to(std::uint64_t step) {
    if (step >= steps_) return;
    Bytes content;
    ByteWriter(content).number(step);
    write(long_frame(Type::back, content, chain_), 4);
    steps_ = step;
    next_places_ = std::min(next_places_, steps_);
}

} // namespace sinew::play
