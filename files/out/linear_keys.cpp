#include "files/out/linear_keys.h"

#include <algorithm>
#include <limits>

namespace sinew::files {
namespace {

/// Slopes from the last key within which every frame since is close enough (Imai and Iri 1986, with kept points).
class SlopeRange {
  public:
    explicit SlopeRange(std::span<const float> tolerances) : tolerances_(tolerances) { begin(nullptr); }

    void begin(const float* key) {
        key_ = key, span_ = 0;
        low_.assign(tolerances_.size(), -std::numeric_limits<float>::infinity());
        high_.assign(tolerances_.size(), std::numeric_limits<float>::infinity());
    }

    /// Goes on to the next frame; false, and nothing is done, if no line from the key to it is close to those between.
    bool pass(const float* frame) {
        const float span = span_ + 1;
        if (span_ > 0 && !reaches(frame, span)) return false;
        span_ = span;
        for (std::size_t k = 0; k < low_.size(); ++k) {
            const float rise = frame[k] - key_[k], off = tolerances_[k];
            low_[k] = std::max(low_[k], (rise - off) / span), high_[k] = std::min(high_[k], (rise + off) / span);
        }
        return true;
    }

  private:
    bool reaches(const float* frame, float span) const {
        for (std::size_t k = 0; k < low_.size(); ++k) {
            const float slope = (frame[k] - key_[k]) / span;
            if (!(slope >= low_[k] && slope <= high_[k])) return false;
        }
        return true;
    }

    std::span<const float> tolerances_;
    const float* key_ = nullptr;
    float span_ = 0; ///< frames since the key
    std::vector<float> low_, high_;
};

} // namespace

std::vector<std::size_t> linear_keys(std::span<const float> numbers, std::span<const float> tolerances) {
    const std::size_t count = tolerances.size(), frames = count > 0 ? numbers.size() / count : 0;
    const auto at = [&](std::size_t frame) { return numbers.data() + frame * count; };
    std::vector<std::size_t> keys{0};
    if (frames < 2) return keys;
    SlopeRange slopes(tolerances);
    slopes.begin(at(0));
    for (std::size_t i = 1; i < frames; ++i) {
        if (slopes.pass(at(i))) continue;
        keys.push_back(i - 1);
        slopes.begin(at(i - 1));
        slopes.pass(at(i));
    }
    keys.push_back(frames - 1);
    if (keys.size() == 2 && std::equal(at(0), at(1), at(frames - 1))) keys.pop_back();
    return keys;
}

} // namespace sinew::files
