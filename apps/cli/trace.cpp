#include "apps/cli/trace.h"

#include "sinew/scene/json.h"
#include "sinew/scene/text.h"
#include "sinew/session/pick.h"
#include "sinew/world/edit.h"

#include "apps/cli/command.h"
#include "apps/cli/console.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>

namespace sinew::cli {
namespace {

constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};

std::vector<std::string> names_of_all(const AnyWorld& world) {
    std::vector<std::string> names;
    std::visit(
        [&](const auto& any) {
            for (const auto& figure : any.figures) names.push_back(figure.name);
            for (const auto& figure : any.figures)
                for (const auto& [name, id] : figure.particle_names)
                    names.push_back(figure.name + "/" + std::string(name));
        },
        world);
    return names;
}

/// Particles named by a word of --of: a figure, a single particle, or a stem.
std::vector<ParticleId> particles_of(const AnyWorld& world, const std::string& word) {
    return std::visit(
        [&](const auto& any) {
            std::vector<ParticleId> found;
            if (const auto figure = find_figure(any, word))
                for (const auto id : any.figures[*figure].particles) found.push_back(id);
            else
                found = find_particles(any, word);
            return found;
        },
        world);
}

/// Shortest decimal representation with an exact round trip.
void put_number(std::string& text, double number) {
    fmt::format_to(std::back_inserter(text), "{}", number);
}

void put_list(std::string& text, std::span<const double> numbers) {
    text += '[';
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (i > 0) text += ',';
        put_number(text, numbers[i]);
    }
    text += ']';
}

/// A field of a CSV file (RFC 4180).
std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

std::string heading(int dimension) {
    std::string text = "time,name";
    for (int i = 0; i < dimension; ++i) text += fmt::format(",{}", axes[std::size_t(i)]);
    for (int i = 0; i < dimension; ++i) text += fmt::format(",v{}", axes[std::size_t(i)]);
    return text + "\n";
}

} // namespace

Trace::Trace(const std::string& path, const std::string& names, const Session& session)
    : path_(path), is_table_(path.ends_with(".csv")) {
    all_ = names.empty();
    if (!all_) choose(names, session); // first: a wrong name leaves an older file as it was
    if (path != "-") open();
    if (is_table_) text_ = heading(session.scene().dimension);
}

void Trace::open() {
    std::error_code unknown;
    const auto status = std::filesystem::status(path_, unknown);
    const bool is_stream = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
    if (!is_stream) {
        partial_ = std::make_unique<canvas::PartialFile>();
        if (const auto failure = partial_->create(path_)) refuse(path_, *failure);
    }
    file_.reset(std::fopen(partial_ ? partial_->path().c_str() : path_.c_str(), "wb"));
    if (!file_) refuse(path_, std::strerror(errno));
}

void Trace::choose(const std::string& names, const Session& session) {
    for (std::size_t begin = 0; begin < names.size();) {
        const auto end = std::min(names.find(',', begin), names.size());
        const auto word = names.substr(begin, end - begin);
        begin = end + 1;
        const auto found = particles_of(session.world(), word);
        if (found.empty()) {
            const auto known = names_of_all(session.world());
            refuse("sinew", fmt::format("there is no particle or figure called {}", in_quotes(word)),
                   suggest(word, {known.begin(), known.end()}));
        }
        for (const auto id : found) trace(id, session);
    }
}

void Trace::choose_all(const Session& session) {
    std::visit(
        [&](const auto& world) {
            if (traced_.size() == world.particles.size()) return;
            traced_.clear();
            for (Row row = 0; row < world.particles.size(); ++row) trace(world.particles.handles.id_of(row), session);
        },
        session.world());
}

void Trace::trace(ParticleId particle, const Session& session) {
    const auto name = name_of(session.world(), particle);
    traced_.push_back({particle, is_table_ ? csv_field(name) : json::to_text(json::Value(name))});
}

void Trace::write(const Session& session) {
    if (all_) choose_all(session);
    std::visit(
        [&]<class WorldT>(const WorldT& world) {
            std::array<double, WorldT::dimension> position{}, velocity{};
            for (const auto& [particle, name] : traced_) {
                const auto row = row_of(world, particle);
                if (!row) continue;
                for (std::size_t i = 0; i < position.size(); ++i) {
                    position[i] = double(world.particles.position[*row][int(i)]);
                    velocity[i] = double(world.particles.velocity[*row][int(i)]);
                }
                put_row(world.time, name, position, velocity);
            }
        },
        session.world());
    flush();
}

void Trace::put_row(double time, const std::string& name, std::span<const double> position,
                    std::span<const double> velocity) {
    if (is_table_) {
        put_number(text_, time);
        text_ += ',';
        text_ += name;
        for (const auto& numbers : {position, velocity})
            for (const double number : numbers) text_ += ',', put_number(text_, number);
        text_ += '\n';
        return;
    }
    text_ += R"({"time":)";
    put_number(text_, time);
    text_ += fmt::format(R"(,"name":{},"position":)", name);
    put_list(text_, position);
    text_ += R"(,"velocity":)";
    put_list(text_, velocity);
    text_ += "}\n";
}

void Trace::flush() {
    if (!file_)
        print(text_);
    else if (std::fwrite(text_.data(), 1, text_.size(), file_.get()) < text_.size())
        refuse(path_, std::strerror(errno));
    text_.clear();
}

void Trace::close() {
    if (file_ && std::fclose(file_.release()) != 0) refuse(path_, std::strerror(errno));
    if (!partial_) return;
    if (const auto failure = partial_->commit()) refuse(path_, *failure);
}

} // namespace sinew::cli
