#include "sinew/topology/split_pieces.h"

#include "sinew/topology/slice.h"

#include <algorithm>

namespace sinew {
namespace {

bool is_closed(Mark mark) {
    return mark == Mark::loop || mark == Mark::fill || is_cloth(mark);
}

/// Indices of the particles followed by a gap.
std::vector<std::size_t> gaps_of(const Piece& piece, const Gaps& gaps) {
    std::vector<std::size_t> found;
    const auto& ids = piece.particles;
    if (piece.mark == Mark::dot) return found;
    for (std::size_t i = 0; i + (is_closed(piece.mark) ? 0 : 1) < ids.size(); ++i)
        if (gaps.between(ids[i], ids[(i + 1) % ids.size()])) found.push_back(i);
    return found;
}

/// `count` particles of a piece from number `first` on, cyclically, with the same taper.
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

/// Adds the remaining parts of a closed piece with gaps.
void open_up(const Piece& piece, std::span<const std::size_t> gaps, std::vector<Piece>& left) {
    if (piece.mark == Mark::fill && gaps.size() == 1) return left.push_back(piece);
    const std::size_t min = piece.mark == Mark::fill ? 3 : 2, size = piece.particles.size();
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        const std::size_t next = i + 1 < gaps.size() ? gaps[i + 1] : gaps[0] + size;
        if (next - gaps[i] < min) continue;
        left.push_back(part_of(piece, gaps[i] + 1, next - gaps[i]));
        if (piece.mark == Mark::loop) left.back().mark = Mark::stroke;
    }
}

/// Adds the remaining parts of an open piece with gaps. An end that is left alone stays to be seen as a dot as thick as
/// the piece: the stump of a limb.
void shorten(const Piece& piece, std::span<const std::size_t> gaps, std::vector<Piece>& left) {
    const std::size_t size = piece.particles.size();
    if (piece.mark == Mark::tip || piece.mark == Mark::face) {
        left.push_back(part_of(piece, gaps.back() + 1, size - gaps.back() - 1));
        if (piece.mark == Mark::tip && left.back().particles.size() == 1) left.back().mark = Mark::dot;
        return;
    }
    for (std::size_t i = 0, first = 0; i <= gaps.size(); ++i) {
        const std::size_t end = i < gaps.size() ? gaps[i] + 1 : size;
        const bool is_stump = end - first == 1 && piece.width > 0 && piece.mark != Mark::ring;
        if (end - first > 1 || is_stump) left.push_back(part_of(piece, first, end - first));
        if (is_stump) left.back().mark = Mark::dot;
        first = end;
    }
}

template <int D, class Real> class PieceSplitter {
  public:
    PieceSplitter(const World<D, Real>& world, const Gaps& gaps, const Slicer<D, Real>* slicer)
        : world_(world), gaps_(gaps), slicer_(slicer) {}

    void split_pieces(Figure& figure) const {
        PiecesLeft left;
        left.pieces.reserve(figure.pieces.size());
        for (auto& piece : figure.pieces) {
            if (is_cloth(piece.mark)) {
                cell(figure, piece, left);
                continue;
            }
            const auto found = gaps_of(piece, gaps_);
            if (found.empty())
                left.pieces.push_back(std::move(piece));
            else if (is_closed(piece.mark))
                open_up(piece, found, left.pieces);
            else
                shorten(piece, found, left.pieces);
        }
        figure.pieces = std::move(left.pieces);
        figure.fragments = std::move(left.fragments);
    }

  private:
    const World<D, Real>& world_;
    const Gaps& gaps_;
    const Slicer<D, Real>* slicer_;

    /// True if a side of the cell between two particles was removed.
    bool has_gap(const Figure& figure, const Piece& piece) const {
        if (piece.mark == Mark::surface) return !gaps_of(piece, gaps_).empty();
        const auto& corners = figure.fragments[piece.fragment].corners;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
            if (a.is_particle() && b.is_particle() && gaps_.between(piece.particles[a.of[0]], piece.particles[b.of[0]]))
                return true;
        }
        return false;
    }

    void cell(const Figure& figure, Piece& piece, PiecesLeft& left) const {
        const bool is_whole = piece.mark == Mark::surface, has_gaps = has_gap(figure, piece);
        if (slicer_ && (has_gaps || (!is_whole && slicer_->runs_through(figure, piece))))
            slicer_->slice(figure, piece, left);
        else if (!is_whole && !has_gaps)
            add_unbound(world_, figure, piece, left);
        else if (!has_gaps)
            left.pieces.push_back(std::move(piece));
    }
};

} // namespace

template <int D, class Real>
void split_pieces(World<D, Real>& world, std::span<const Ends> gone, const Slicer<D, Real>* slicer) {
    if (gone.empty()) return;
    std::vector<char> touched(world.figures.size(), 0);
    for (const auto& ends : gone)
        for (const auto id : ends)
            if (const auto row = world.particles.handles.find(id))
                if (const auto figure = world.particles.figure[*row]; figure < touched.size()) touched[figure] = 1;
    const Gaps gaps(gone);
    const PieceSplitter<D, Real> splitter(world, gaps, slicer);
    // pieces of a hand-made figure join particles of others
    const auto joins = [&](const Figure& figure) {
        return std::ranges::any_of(
            figure.pieces, [&](const Piece& piece) { return !is_cloth(piece.mark) && !gaps_of(piece, gaps).empty(); });
    };
    for (std::size_t i = 0; i < touched.size(); ++i)
        if (touched[i] || joins(world.figures[i])) splitter.split_pieces(world.figures[i]);
}

#define SINEW_SPLIT_PIECES(D, Real)                                                                                    \
    template void split_pieces(World<D, Real>&, std::span<const Ends>, const Slicer<D, Real>*);
SINEW_INSTANTIATE(SINEW_SPLIT_PIECES)

} // namespace sinew
