#pragma once

#include "sinew/picture/picture.h"

#include <span>
#include <string>

namespace sinew::canvas {

/// A picture with a line of text above.
struct Labelled {
    const Picture* picture = nullptr;
    std::string label;
};

/// Size of the picture filled by put_beside(), pixels.
struct BesideSize {
    int width = 0, height = 0;
};

/// Size of `count` pictures of width x height pixels beside each other.
BesideSize size_beside(std::size_t count, int width, int height);

/// Fills `whole` with pictures of one size from left to right, each clipped and under a label. The result is a display
/// list, which every painter and every file format accepts.
void put_beside(std::span<const Labelled> parts, Picture& whole);

/// Fills `whole` with pictures of one height from left to right, each clipped, without a gap or a label.
void join(std::span<const Picture> parts, Picture& whole);

} // namespace sinew::canvas
