#include "sinew/math/color.h"

#include "bindings/c/simulation.h"
#include "bindings/python/core/simulation.h"
#include "files/out/export_formats.h"
#include "files/out/frame_name.h"

#include <algorithm>
#include <pybind11/stl.h>

/// Files of other programs.
namespace sinew::python {
namespace {

using files::FramesPerFile;
using Words = std::vector<std::string>;

const files::ExportFormat& format_of(const std::string& path) {
    const auto* const format = files::export_format_of(path);
    if (!format) {
        std::string endings;
        for (const auto& known : files::export_formats())
            if (endings.find(known.ending) == endings.npos) endings += " " + std::string(known.ending);
        raise(SINEW_BAD_ARGUMENT, path + ": the ending is none of" + endings);
    }
    if (auto problem = files::frame_number_problem(path)) raise(SINEW_BAD_ARGUMENT, *problem);
    if (format->frames == FramesPerFile::all && files::has_frame_number(path))
        raise(SINEW_BAD_ARGUMENT, path + ": a " + std::string(format->ending) + " holds all frames");
    return *format;
}

/// An export into files on disk.
class Export {
  public:
    Export(const std::string& path, std::optional<double> fps, Words figures, std::array<int, 2> size,
           const std::string& background, std::string follow, std::string caption, std::optional<double> error)
        : format_(format_of(path)), request_{.path = path,
                                             .fps = fps.value_or(format_.usual_fps),
                                             .figures = std::move(figures),
                                             .size = size} {
        if (!background.empty() && !(request_.background = parse_color(background)))
            raise(SINEW_BAD_ARGUMENT, "'" + background + "' is not a colour");
        request_.follow = std::move(follow), request_.caption = std::move(caption);
        request_.tolerance = error;
        exporter_ = format_.open(request_);
    }

    double fps() const { return request_.fps; }
    bool is_film() const { return format_.frames == FramesPerFile::all || files::has_frame_number(request_.path); }

    void add(Simulation& simulation) {
        const Hold hold(simulation.mutex());
        const auto* const known = c::simulations().find(simulation.handle().id);
        const auto* const session = known ? known->session() : nullptr;
        if (!session) raise(SINEW_BAD_HANDLE, "the simulation is closed");
        if (!session->images().empty() && format_.is_painted)
            raise(SINEW_BAD_ARGUMENT,
                  "images of the scene are not painted in it: save_frames and save_film paint them");
        for (const auto& name : files::figures_named(request_))
            if (!files::has_figure(*session, name)) raise(SINEW_NOT_FOUND, "there is no figure called '" + name + "'");
        run([&] { return exporter_->frame(*session); });
    }
    void finish() {
        run([&] { return exporter_->finish(); });
    }

    Words written() const {
        Words paths;
        for (const auto& path : exporter_->written()) paths.push_back(path.string());
        return paths;
    }
    Words notes() const { return exporter_->notes(); }

  private:
    /// Calls work() without the GIL and raises its failure.
    template <class Work> void run(const Work& work) {
        files::Failure failure;
        {
            const py::gil_scoped_release others;
            failure = work();
        }
        if (failure) raise(SINEW_BAD_ARGUMENT, *failure);
    }

    const files::ExportFormat& format_;
    files::ExportRequest request_;
    std::unique_ptr<files::Exporter> exporter_;
};

} // namespace

void bind_exporting(py::module_& module) {
    py::class_<Export>(module, "Export")
        .def(py::init<const std::string&, std::optional<double>, Words, std::array<int, 2>, const std::string&,
                      std::string, std::string, std::optional<double>>())
        .def_property_readonly("fps", &Export::fps)
        .def_property_readonly("is_film", &Export::is_film)
        .def("add", &Export::add)
        .def("finish", &Export::finish)
        .def_property_readonly("written", &Export::written)
        .def_property_readonly("notes", &Export::notes);
}

} // namespace sinew::python
