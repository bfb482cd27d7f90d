#pragma once

#include "sinew/snapshot/bytes.h"

#include <array>

/// Packed columns: rows as they are, or runs of rows that repeat; of whole numbers, that grow by the same step.
namespace sinew::snapshot {

/// Whole numbers, of which a row may be the one before plus a step.
template <class T> inline constexpr std::size_t words_of = 0;
template <> inline constexpr std::size_t words_of<std::uint32_t> = 1;
template <std::size_t N> inline constexpr std::size_t words_of<std::array<std::uint32_t, N>> = N;
template <class T> inline constexpr bool is_counted = words_of<T> != 0;

enum class Packing : std::uint8_t { rows, runs };

template <class T> T step_between(const T& from, const T& to) {
    if constexpr (std::is_integral_v<T>) {
        return to - from;
    } else {
        T step{};
        for (std::size_t i = 0; i < step.size(); ++i) step[i] = to[i] - from[i];
        return step;
    }
}
template <class T> T stepped(const T& from, const T& step, std::uint32_t times) {
    if constexpr (std::is_integral_v<T>) {
        return from + step * times;
    } else {
        T to{};
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + step[i] * times;
        return to;
    }
}
template <class T> bool are_same_bits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Calls visit(first row, step, rows) for each run of a column; stops where visit returns false.
template <class T, class Visit> bool each_run(std::span<const T> column, Visit&& visit) {
    for (std::size_t first = 0; first < column.size();) {
        std::size_t end = first + 1;
        T step{};
        if constexpr (is_counted<T>) {
            if (end < column.size()) step = step_between(column[first], column[end]);
            while (end < column.size() && step_between(column[end - 1], column[end]) == step) ++end;
        } else {
            while (end < column.size() && are_same_bits(column[end - 1], column[end])) ++end;
        }
        if (!visit(column[first], step, end - first)) return false;
        first = end;
    }
    return true;
}

/// Bytes of a run, with a count of two digits.
template <class T> inline constexpr std::size_t run_size = 2 + sizeof(T) * (is_counted<T> ? 2 : 1);

/// Most runs that a column is packed in: they take less than its rows. Unless `compact`, one, of a column whose rows
/// are equal.
template <class T> std::size_t max_runs(std::size_t rows, bool compact) {
    const auto max = rows * sizeof(T) / run_size<T>;
    return compact ? max : std::min<std::size_t>(max, 1);
}

template <class T> bool is_worth_runs(std::span<const T> column, bool compact) {
    const auto max = max_runs<T>(column.size(), compact);
    std::size_t runs = 0;
    return each_run(column, [&](const T&, const T&, std::size_t) { return ++runs <= max; });
}

template <class T> void pack(ByteWriter& writer, std::span<const T> column) {
    static_assert(std::is_trivially_copyable_v<T>);
    writer.count(column.size());
    if (column.empty()) return;
    if (!is_worth_runs(column, writer.is_compact())) {
        writer.number(Packing::rows);
        return writer.append(column.data(), column.size_bytes());
    }
    writer.number(Packing::runs);
    each_run(column, [&](const T& first, const T& step, std::size_t rows) {
        writer.count(rows);
        writer.number(first);
        if constexpr (is_counted<T>) writer.number(step);
        return true;
    });
}

/// Calls append(rows, value, step) for each run, or all(rows) where the rows lie as they are. Rows take memory from the
/// budget.
template <class T, class Append, class All> void unpack(ByteReader& reader, Append&& append, All&& all) {
    const auto size = reader.room_for(reader.count(), sizeof(T));
    if (size == 0) return;
    const auto packing = reader.number<std::uint8_t>();
    if (packing > std::uint8_t(Packing::runs)) return reader.fail("an unknown way to pack a column");
    if (packing == std::uint8_t(Packing::rows)) {
        if (size * sizeof(T) > reader.left()) return reader.fail("ends within a column");
        return all(size);
    }
    for (std::size_t row = 0; row < size && !reader.failed();) {
        const auto rows = reader.count();
        if (rows == 0 || rows > size - row) return reader.fail("the runs of a column do not add up to its rows");
        const T first = reader.number<T>();
        T step{};
        if constexpr (is_counted<T>) step = reader.number<T>();
        if (!reader.failed()) append(std::size_t(rows), first, step);
        row += std::size_t(rows);
    }
}

template <class T> void unpack_into(ByteReader& reader, std::vector<T>& column) {
    column.clear();
    unpack<T>(
        reader,
        [&](std::size_t rows, const T& first, const T& step) {
            if constexpr (is_counted<T>)
                for (std::uint32_t i = 0; i < rows; ++i) column.push_back(stepped(first, step, i));
            else
                column.insert(column.end(), rows, first);
        },
        [&](std::size_t size) {
            column.resize(size);
            reader.read(column.data(), size * sizeof(T));
        });
}

} // namespace sinew::snapshot
