#include "apps/cli/trace.h"

#include "sinew/scene/text.h"
#include "sinew/session/pick.h"
#include "sinew/world/edit.h"

#include "apps/cli/command.h"
#include "apps/cli/console.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

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

} // namespace

Trace::Trace(const std::string& path, const std::string& names, const Session& session)
    : path_(path), rows_(path.ends_with(".csv"), session.scene().dimension) {
    all_ = names.empty();
    if (!all_) choose(names, session); // first: a wrong name leaves an older file as it was
    if (path != "-") open();
    text_ = rows_.heading();
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
        for (const auto id : found) rows_.trace(session, id);
    }
}

void Trace::write(const Session& session) {
    if (all_) rows_.trace_all(session);
    rows_.add(session, text_);
    flush();
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
