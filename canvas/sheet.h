#pragma once

#include "canvas/writer.h"

namespace sinew::canvas {

/// How a contact sheet is laid out: frames in reading order, each with its time below it.
struct SheetFormat {
    int columns = 4;
    int rows = 3;
    int frame_width = 320;      ///< pixels of one frame on the sheet; pictures are scaled to fit
    int frame_height = 240;     ///< pixels
    double first_second = 0;    ///< time of the first frame
    double seconds_between = 1; ///< from frame to frame
    std::string called = {};    ///< what messages call the file; empty: its path
};

/// What is wrong with writing this sheet: not an image format, no or too many frames, too large in all.
[[nodiscard]] Failure check_sheet(const std::filesystem::path& path, const SheetFormat& format);

/// A writer of a contact sheet, a still image (.png, .svg or .pdf). Takes up to columns x rows frames; fewer leave room
/// at the end.
Opened open_sheet(const std::filesystem::path& path, const SheetFormat& format);

} // namespace sinew::canvas
