#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/block.h"

#include <algorithm>
#include <numeric>

/// Programs of blocks: trees and figures with few loops, of rigid distances, whose joints have limits. Blocks of equal
/// programs are solved side by side.
namespace sinew::detail {

/// The program in a list of numbers.
inline BlockProgram read_program(const std::uint32_t* numbers) {
    BlockProgram program;
    for (auto* count : {&program.unknowns, &program.nodes, &program.entries, &program.links, &program.planes,
                        &program.ranges, &program.folds})
        *count = *numbers++;
    const auto read = [&]<class Row>(const Row*& rows, std::size_t count) {
        rows = reinterpret_cast<const Row*>(numbers);
        numbers += count * (sizeof(Row) / sizeof(std::uint32_t));
    };
    read(program.link, program.links);
    read(program.plane, program.planes);
    read(program.range, program.ranges);
    read(program.fold, program.folds);
    read(program.first_entry, program.unknowns + 1);
    read(program.entry_node, program.entries);
    program.pairs = numbers;
    return program;
}

template <int D> class ProgramFinder {
  public:
    ProgramFinder(Blocks<D>& blocks, Block& block)
        : blocks_(blocks), programs_(blocks.programs), block_(block),
          first_entry_(blocks.first_entry[block.first_node]) {}

    /// Appends the block's program to the programs, if the block may be solved side by side with others.
    void run() {
        block_.program = Blocks<D>::none;
        if (!is_plain()) return;
        const auto first = programs_.numbers.size();
        write();
        const auto size = programs_.numbers.size() - first;
        block_.program = std::uint32_t(programs_.list.size());
        programs_.list.push_back(
            {.first = std::uint32_t(first), .size = std::uint32_t(size), .hash = hash_from(first)});
    }

  private:
    Blocks<D>& blocks_;
    Programs<D>& programs_;
    Block& block_;
    std::uint32_t first_entry_;

    using Sizes = Programs<D>;

    std::span<const DistanceRow<D>> links() const {
        return std::span(std::as_const(blocks_.links)).subspan(block_.first_link, block_.links);
    }
    std::span<const AngleRow<D>> bends() const {
        return std::span(std::as_const(blocks_.bends)).subspan(block_.first_bend, block_.bends);
    }
    std::uint32_t entries() const { return std::uint32_t(blocks_.entries.size()) - first_entry_; }

    bool is_plain() const {
        if (block_.chain != Blocks<D>::none || block_.ways > 0 || block_.springy || block_.is_motorized ||
            block_.load_tethers > 0 || block_.braced())
            return false;
        if (block_.nodes > Sizes::max_nodes || entries() > Sizes::max_entries ||
            block_.links + block_.bends > Sizes::max_rows || block_.links == 0)
            return false;
        return std::all_of(links().begin(), links().end(), rides_as_link) &&
               std::all_of(bends().begin(), bends().end(), rides_as_bend);
    }
    static bool rides_as_link(const DistanceRow<D>& link) {
        constexpr double far = 1e12; // as good as no limit
        const bool is_stick = link.low == link.high, is_string = link.low == 0;
        return link.is_range() || (link.length == link.high && link.high < far && (is_stick || is_string));
    }
    static bool rides_as_bend(const AngleRow<D>& bend) {
        return bend.replaces_link || (bend.is_fold() && bend.one_sided());
    }

    std::uint32_t node(std::uint32_t i) const { return i - block_.first_node; }
    std::uint32_t entry(std::uint32_t i) const { return i == Blocks<D>::none ? i : i - first_entry_; }
    template <class... Each> void put(Each... each) { (programs_.numbers.push_back(std::uint32_t(each)), ...); }

    void write() {
        const auto planes = block_.flat_squares;
        put(block_.unknowns, block_.nodes, entries(), block_.links - block_.ranges, planes, block_.ranges,
            block_.bends - planes);
        for (const auto& link : links())
            if (!link.is_range()) put(node(link.a), node(link.b), entry(link.entry), link.low < link.high);
        for (const auto& bend : bends().first(planes)) {
            put_nodes(bend);
            for (const auto each : bend.entries) put(entry(each));
        }
        for (const auto& link : links())
            if (link.is_range()) put(node(link.a), node(link.b));
        for (const auto& bend : bends().subspan(planes)) put_nodes(bend);
        for (std::uint32_t i = 0; i <= block_.unknowns; ++i) put(first_entry_of(i) - first_entry_);
        for (std::uint32_t e = 0; e < entries(); ++e) put(node(blocks_.entries[first_entry_ + e].node));
        const auto first_pair = blocks_.first_pair[block_.first_node];
        for (auto i = std::size_t(first_pair); i < blocks_.pairs.size(); ++i) put(entry(blocks_.pairs[i]));
    }
    void put_nodes(const AngleRow<D>& bend) {
        for (const auto i : bend.nodes) put(node(i));
    }
    std::uint32_t first_entry_of(std::uint32_t i) const {
        return i < block_.unknowns ? blocks_.first_entry[block_.first_node + i] : std::uint32_t(blocks_.entries.size());
    }

    /// Hash of the numbers from an index on (Fowler, Noll and Vo).
    std::uint64_t hash_from(std::size_t first) const {
        return std::accumulate(programs_.numbers.begin() + std::ptrdiff_t(first), programs_.numbers.end(),
                               std::uint64_t(14695981039346656037U),
                               [](std::uint64_t hash, std::uint32_t each) { return (hash ^ each) * 1099511628211U; });
    }
};

/// Lists the blocks that have programs, those of equal programs together, and makes room to solve them in so many parts
/// at the same time.
template <int D> void order_programs(Blocks<D>& blocks, std::size_t parts) {
    auto& programs = blocks.programs;
    auto& turns = programs.turns;
    turns.clear();
    for (std::uint32_t i = 0; i < blocks.list.size(); ++i)
        if (blocks.list[i].program != Blocks<D>::none) turns.push_back({i, 0});
    const auto program = [&](const ProgramTurn& turn) -> const ProgramNumbers& {
        return programs.list[blocks.list[turn.block].program];
    };
    const auto numbers = [&](const ProgramTurn& turn) {
        return std::span(std::as_const(programs.numbers)).subspan(program(turn).first, program(turn).size);
    };
    sinew::sort(turns.begin(), turns.end(), [&](const ProgramTurn& a, const ProgramTurn& b) {
        return program(a).hash != program(b).hash ? program(a).hash < program(b).hash : a.block < b.block;
    });
    std::size_t largest = 0, max_nodes = 0;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const bool alike = i > 0 && program(turns[i]).hash == program(turns[i - 1]).hash &&
                           std::ranges::equal(numbers(turns[i]), numbers(turns[i - 1]));
        turns[i].group = i == 0 ? 0 : turns[i - 1].group + !alike;
        const auto read = read_program(numbers(turns[i]).data());
        largest = std::max(largest, ProgramPack<D>::size_of(read));
        max_nodes = std::max<std::size_t>(max_nodes, read.nodes);
    }
    if (turns.empty()) return;
    if (programs.spaces.size() < parts) programs.spaces.resize(parts);
    for (auto& space : programs.spaces) space.make_room(largest, max_nodes);
}

} // namespace sinew::detail
