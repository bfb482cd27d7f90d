#include "bindings/python/core/simulation.h"

#include "canvas/png.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::python {
namespace {

/// Longest time that steps run without a look at Python's signals.
constexpr std::chrono::milliseconds attention{50};

Images read_images(const SceneSource& source) {
    Images images;
    for (const auto& [name, path] : source.images) {
        auto read = canvas::read_png(path, name, Limits{});
        if (!read.image) raise(SINEW_BAD_ARGUMENT, read.problem + (read.help.empty() ? "" : " (" + read.help + ")"));
        images.emplace_back(name, std::move(read.image));
    }
    return images;
}

} // namespace

template <class Open> sinew_status SceneSource::with_options(const Images& read, const Open& open) const {
    std::vector<const char*> pairs;
    for (const auto& pair : overrides) pairs.push_back(pair.c_str());
    std::vector<sinew_image_file> sizes;
    for (const auto& [file, image] : read)
        sizes.push_back({file.c_str(), std::uint32_t(image->width), std::uint32_t(image->height)});
    std::vector<sinew_model_file> texts;
    for (const auto& [file, model] : models) texts.push_back({file.c_str(), model.c_str()});
    const sinew_open_options options{name.c_str(), pairs.data(), pairs.size(), sizes.data(),
                                     sizes.size(), texts.data(), texts.size()};
    return open(options);
}

Simulation::Simulation(const SceneSource& source) : images_(read_images(source)) {
    const auto open = [&](const sinew_open_options& options) {
        const py::gil_scoped_release others;
        return sinew_world_open(source.text.c_str(), &options, &handle_);
    };
    check(source.with_options(images_, open));
}

std::unique_ptr<Simulation> Simulation::load(std::string_view bytes, const SceneSource& files) {
    auto images = read_images(files);
    sinew_world handle{};
    const auto open = [&](const sinew_open_options& options) {
        const py::gil_scoped_release others;
        return sinew_world_load(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), &options, &handle);
    };
    check(files.with_options(images, open));
    return std::make_unique<Simulation>(handle, std::move(images));
}

void Simulation::restore(std::string_view bytes, const SceneSource& files) {
    const auto now = ask<sinew_info>(sinew_world_get_info);
    const auto other = load(bytes, files);
    const auto then = other->ask<sinew_info>(sinew_world_get_info);
    if (now.dimension != then.dimension || now.real_bytes != then.real_bytes)
        raise(SINEW_BAD_ARGUMENT, "the snapshot is of another dimension or precision; sinew.open opens it by itself");
    const Hold hold(mutex_);
    std::swap(handle_, other->handle_);
    std::swap(images_, other->images_);
    computed_.forget();
}

std::unique_ptr<Simulation> Simulation::copy() {
    return std::make_unique<Simulation>(ask<sinew_world>(sinew_world_copy), images_);
}

template <class Next> void Simulation::advance(const Next& next) {
    const Hold hold(mutex_);
    for (bool more = true; more;) {
        auto status = SINEW_OK;
        {
            const py::gil_scoped_release others;
            const auto end = std::chrono::steady_clock::now() + attention;
            while (more && std::chrono::steady_clock::now() < end) more = next(status) && status == SINEW_OK;
        }
        check(status);
        refresh();
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
}

void Simulation::restart() {
    call(sinew_world_restart);
    computed_.forget();
}

void Simulation::step(std::uint32_t count) {
    std::uint32_t taken = 0;
    advance([&](sinew_status& status) {
        status = sinew_world_step(handle_, std::min(count, 1u));
        return ++taken < count;
    });
}

void Simulation::run_until(double seconds) {
    if (!std::isfinite(seconds)) raise(SINEW_BAD_ARGUMENT, "the time is not finite");
    const double start = ask<sinew_report>(sinew_world_get_report).seconds;
    const double rate = ask<sinew_info>(sinew_world_get_info).rate;
    double steps = 0;
    advance([&](sinew_status& status) {
        const double next = start + ++steps / rate;
        status = sinew_world_run_until(handle_, std::min(next, seconds));
        return next < seconds;
    });
}

bool is_float(sinew_world handle) {
    sinew_info info{};
    check(sinew_world_get_info(handle, &info));
    return info.real_bytes == sizeof(float);
}

void check_points(const Points& points, bool is_float, const char* rows) {
    const double end = is_float ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    for (py::ssize_t row = 0; row < points.shape(0); ++row)
        for (py::ssize_t i = 0; i < points.shape(1); ++i)
            if (!(std::abs(points.at(row, i)) <= end))
                raise(SINEW_BAD_ARGUMENT, rows + (" " + std::to_string(row)) + ": a number is not finite");
}

sinew_point point_at(const Points& points, py::ssize_t row) {
    const double* const first = points.data(row, 0);
    return {first[0], first[1], points.shape(1) == 3 ? first[2] : 0};
}

sinew_point point_of(const Points& numbers, const char* what) {
    if (numbers.ndim() != 1 || (numbers.size() != 2 && numbers.size() != 3))
        raise(SINEW_BAD_ARGUMENT, std::string(what) + " has two or three numbers");
    const double* const first = numbers.data();
    return {first[0], first[1], numbers.size() == 3 ? first[2] : 0};
}

} // namespace sinew::python
