#pragma once

#include "sinew/picture/picture.h"

#include <cstddef>
#include <list>
#include <string>
#include <vector>

/// Pictures of a session as vectors that move.
namespace sinew::files {

/// A shape from the first frame it is seen in to the last: a fixed number of points, and a colour and a width at each
/// frame.
struct Track {
    Shape shape = Shape::polygon; ///< polyline, loop, disc, polygon or text
    std::string text;
    std::size_t first = 0;  ///< frame
    std::size_t points = 0; ///< of a frame
    std::vector<float>
        numbers; ///< frame by frame: x and y of each point, width (pixels), red, green, blue, alpha (0..1)

    std::size_t numbers_per_frame() const { return 2 * points + 5; }
    std::size_t frames() const { return numbers.size() / numbers_per_frame(); }
    std::size_t end() const { return first + frames(); }
    const float* at(std::size_t frame) const { return &numbers[frame * numbers_per_frame()]; }
};

/// Frames of a track, from 0 on, at which it needs a key: linear interpolation between keys is off by at most
/// `tolerance` pixels in points and widths, and by two hundredths in colours. With steps, keys are held instead, and
/// stand at each change.
std::vector<std::size_t> keys_of(const Track& track, double tolerance, bool steps);

class TrackRecorder {
  public:
    /// Adds the next frame. An item goes on with the track of the frame before where both lists of items agree, from
    /// the front or from the back.
    void add(const Picture& picture);

    /// Tracks in the order of painting.
    const std::list<Track>& tracks() const { return tracks_; }
    std::size_t frames() const { return frames_; }
    /// True if an image was replaced by its outline in its mean colour.
    bool has_images() const { return has_images_; }
    std::size_t numbers() const { return numbers_; }

  private:
    using Place = std::list<Track>::iterator;
    Place begin_track(const Picture& picture, const Picture::Item& item, Place before);
    void extend(Track& track, const Picture& picture, const Picture::Item& item);

    std::list<Track> tracks_;
    std::vector<Place> present_; ///< tracks of the frame before, by item
    std::size_t frames_ = 0, numbers_ = 0;
    bool has_images_ = false;
};

} // namespace sinew::files
