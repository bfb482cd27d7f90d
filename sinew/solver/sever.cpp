#include "sinew/solver/sever.h"

#include <algorithm>

namespace sinew {
namespace {

/// Pairs of particles whose link is gone, each found in logarithmic time.
class Gaps {
  public:
    explicit Gaps(std::span<const Ends> gone) {
        for (const auto& ends : gone) keys_.push_back(key(ends[0], ends[1]));
        std::sort(keys_.begin(), keys_.end());
    }
    bool between(ParticleId a, ParticleId b) const { return std::binary_search(keys_.begin(), keys_.end(), key(a, b)); }

  private:
    static std::uint64_t key(ParticleId a, ParticleId b) {
        return std::uint64_t(std::min(a.slot, b.slot)) << 32 | std::max(a.slot, b.slot);
    }
    std::vector<std::uint64_t> keys_;
};

bool is_closed(Mark mark) {
    return mark == Mark::loop || mark == Mark::fill || mark == Mark::surface;
}

/// After which of its particles a piece has a gap.
std::vector<std::size_t> gaps_of(const Piece& piece, const Gaps& gaps) {
    std::vector<std::size_t> found;
    const auto& ids = piece.particles;
    if (piece.mark == Mark::dot) return found;
    for (std::size_t i = 0; i + (is_closed(piece.mark) ? 0 : 1) < ids.size(); ++i)
        if (gaps.between(ids[i], ids[(i + 1) % ids.size()])) found.push_back(i);
    return found;
}

/// `count` particles of a piece from number `first` on, round and round; thinner on the way as the whole is.
Piece part_of(const Piece& whole, std::size_t first, std::size_t count) {
    Piece part = whole;
    part.particles.clear();
    for (std::size_t i = 0; i < count; ++i)
        part.particles.push_back(whole.particles[(first + i) % whole.particles.size()]);
    if (whole.end_width > 0) {
        const double links = double(whole.particles.size() - 1);
        const auto width_at = [&](std::size_t i) {
            return whole.width + (whole.end_width - whole.width) * double(i) / links;
        };
        part.width = width_at(first);
        part.end_width = width_at(first + count - 1);
    }
    return part;
}

/// What is left of a closed piece with gaps.
void open_up(const Piece& piece, std::span<const std::size_t> gaps, std::vector<Piece>& left) {
    if (piece.mark == Mark::surface) return;
    if (piece.mark == Mark::fill && gaps.size() == 1) return left.push_back(piece);
    const std::size_t least = piece.mark == Mark::fill ? 3 : 2, size = piece.particles.size();
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        const std::size_t next = i + 1 < gaps.size() ? gaps[i + 1] : gaps[0] + size;
        if (next - gaps[i] < least) continue;
        left.push_back(part_of(piece, gaps[i] + 1, next - gaps[i]));
        if (piece.mark == Mark::loop) left.back().mark = Mark::stroke;
    }
}

/// What is left of an open piece with gaps.
void shorten(const Piece& piece, std::span<const std::size_t> gaps, std::vector<Piece>& left) {
    const std::size_t size = piece.particles.size();
    if (piece.mark == Mark::tip) {
        left.push_back(part_of(piece, gaps.back() + 1, size - gaps.back() - 1));
        if (left.back().particles.size() == 1) left.back().mark = Mark::dot;
        return;
    }
    for (std::size_t i = 0, first = 0; i <= gaps.size(); ++i) {
        const std::size_t end = i < gaps.size() ? gaps[i] + 1 : size;
        if (end - first > 1) left.push_back(part_of(piece, first, end - first));
        first = end;
    }
}

void sever(Figure& figure, const Gaps& gaps) {
    std::vector<Piece> left;
    left.reserve(figure.pieces.size());
    for (auto& piece : figure.pieces) {
        const auto found = gaps_of(piece, gaps);
        if (found.empty())
            left.push_back(std::move(piece));
        else if (is_closed(piece.mark))
            open_up(piece, found, left);
        else
            shorten(piece, found, left);
    }
    figure.pieces = std::move(left);
}

} // namespace

template <int D, class Real> void sever(World<D, Real>& world, std::span<const Ends> gone) {
    if (gone.empty()) return;
    std::vector<char> touched(world.figures.size(), 0);
    for (const auto& ends : gone)
        for (const auto id : ends)
            if (const auto row = world.particles.slots.find(id))
                if (const auto figure = world.particles.figure[*row]; figure < touched.size()) touched[figure] = 1;
    const Gaps gaps(gone);
    for (std::size_t i = 0; i < touched.size(); ++i)
        if (touched[i]) sever(world.figures[i], gaps);
}

#define SINEW_SEVER(D, Real) template void sever(World<D, Real>&, std::span<const Ends>);
SINEW_INSTANTIATE(SINEW_SEVER)

} // namespace sinew
