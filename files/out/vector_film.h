#pragma once

#include "files/out/exporter.h"
#include "files/out/tracks.h"

#include <string>

namespace sinew::files {

/// Input of a format of moving vectors.
struct VectorFilm {
    const TrackRecorder& recorder;
    Color background;
    std::array<int, 2> size{}; ///< pixels
    double fps = 30;
    double tolerance = 0; ///< pixels
    bool steps = false;   ///< frames are shown one by one, not interpolated: 3D, where shapes change their order
};

/// Exporter of the pictures of a session to one text.
std::unique_ptr<Exporter> open_vectors(const ExportRequest& request, std::string (*write)(const VectorFilm&));

} // namespace sinew::files
