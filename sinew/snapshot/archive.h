#pragma once

#include "sinew/snapshot/column_pack.h"
#include "sinew/table/column.h"
#include "sinew/table/id_list.h"
#include "sinew/table/limit_columns.h"
#include "sinew/table/name_table.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>

/// Reading and writing as one text: archive(writer, value) writes, archive(reader, value) reads. A writer changes
/// nothing.
namespace sinew::snapshot {

template <class Archive, class... T> void archive_all(Archive& at, T&... values) {
    (archive(at, values), ...);
}

/// Number of the enumerators of a type, counted from 0.
template <class E> struct Enumerators;

template <class T> inline constexpr bool is_plain = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// True for a type whose bytes are its value, whatever they are.
template <class T> struct IsPacked : std::bool_constant<is_plain<T>> {};
template <int D, class Real> struct IsPacked<Vec<D, Real>> : std::true_type {};
template <class T, std::size_t N> struct IsPacked<std::array<T, N>> : IsPacked<T> {};

template <class Archive, class T>
requires(IsPacked<T>::value) void archive(Archive& at, T& value) {
    if constexpr (Archive::is_reading)
        value = at.template number<T>();
    else
        at.number(value);
}
/// Sizes have 64 bits, whatever the machine's.
template <class Archive>
requires(!std::is_same_v<std::size_t, std::uint64_t>) void archive(Archive& at, std::size_t& value) {
    auto wide = std::uint64_t(value);
    archive(at, wide);
    if constexpr (Archive::is_reading) value = std::size_t(wide);
}
template <class Archive> void archive(Archive& at, bool& value) {
    if constexpr (Archive::is_reading) {
        const auto byte = at.template number<std::uint8_t>();
        if (byte > 1) at.fail("a flag is neither 0 nor 1");
        value = byte == 1;
    } else {
        at.number(std::uint8_t(value));
    }
}
template <class Archive, class E>
requires(std::is_enum_v<E>) void archive(Archive& at, E& value) {
    if constexpr (Archive::is_reading) {
        const auto byte = at.template number<std::uint8_t>();
        if (byte >= Enumerators<E>::count) at.fail("an unknown word of a list");
        value = E(byte < Enumerators<E>::count ? byte : 0);
    } else {
        at.number(std::uint8_t(value));
    }
}
template <class Archive> void archive(Archive& at, std::string& text) {
    if constexpr (Archive::is_reading) {
        text.resize(at.listed(1));
        at.read(text.data(), text.size());
    } else {
        at.count(text.size());
        at.append(text.data(), text.size());
    }
}

// --- lists -----------------------------------------------------------------------------------------------------------

template <class Archive, class T> void archive(Archive& at, std::vector<T>& list) {
    if constexpr (IsPacked<T>::value) {
        if constexpr (Archive::is_reading)
            unpack_into(at, list);
        else
            pack(at, std::span<const T>(list));
    } else if constexpr (Archive::is_reading) {
        list.clear();
        list.resize(at.listed(sizeof(T)));
        for (auto& entry : list) archive(at, entry);
    } else {
        at.count(list.size());
        for (auto& entry : list) archive(at, entry);
    }
}
template <class Archive, class T> void archive(Archive& at, Column<T>& column) {
    if constexpr (Archive::is_reading) {
        column = {};
        unpack<T>(
            at,
            [&](std::size_t rows, const T& first, const T& step) {
                if constexpr (!is_counted<T>)
                    column.append(rows, first);
                else
                    for (std::uint32_t i = 0; i < rows; ++i) column.push_back(stepped(first, step, i));
            },
            [&](std::size_t rows) {
                while (rows-- > 0) column.push_back(at.template number<T>());
            });
    } else if (!column.each().empty() || max_runs<T>(column.size(), at.is_compact()) == 0) {
        const auto rows = column.rows();
        pack(at, std::span<const T>(rows));
    } else { // as pack() does for equal rows
        const T value = column[0];
        at.count(column.size());
        at.number(Packing::runs);
        at.count(column.size());
        at.number(value);
        if constexpr (is_counted<T>) at.number(T{});
    }
}
/// Lower limits, and upper ones where they differ.
template <class Archive, class Real> void archive(Archive& at, LimitColumns<Real>& limits) {
    std::vector<Real> low, high;
    if constexpr (!Archive::is_reading) {
        pack(at, std::span<const Real>(limits.lows()));
        const bool is_apart =
            !std::ranges::equal(limits.lows(), limits.highs(), are_same_bits<Real>); // however they are stored
        pack(at, is_apart ? std::span<const Real>(limits.highs()) : std::span<const Real>());
    } else {
        unpack_into(at, low);
        unpack_into(at, high);
        if (!high.empty() && high.size() != low.size()) at.fail("lower and upper limits are not as many");
        limits = {};
        if (at.failed()) return;
        limits.resize(low.size());
        for (std::size_t row = 0; row < low.size(); ++row)
            limits.set(row, low[row], high.empty() ? low[row] : high[row]);
    }
}

/// Ids as whole numbers, which mostly count up.
template <class Tag> std::array<std::uint32_t, 2> words(const Id<Tag>& id) {
    return {id.index, id.generation};
}
inline std::array<std::uint32_t, 3> words(const ConstraintId& id) {
    return {std::uint32_t(id.kind), id.id.index, id.id.generation};
}
template <class Tag> Id<Tag> id_of(const std::array<std::uint32_t, 2>& words, const Id<Tag>&) {
    return {words[0], words[1]};
}
inline ConstraintId id_of(const std::array<std::uint32_t, 3>& words, const ConstraintId&) {
    return {int(words[0]), {words[1], words[2]}};
}
template <class Archive, class IdT> void archive(Archive& at, IdList<IdT>& ids) {
    using Words = decltype(words(IdT{}));
    std::vector<Words> all;
    if constexpr (Archive::is_reading) {
        unpack_into(at, all);
        ids.clear();
        for (const auto& one : all) ids.push_back(id_of(one, IdT{}));
    } else {
        all.reserve(ids.size());
        for (const auto id : ids) all.push_back(words(id));
        pack(at, std::span<const Words>(all));
    }
}
template <class Archive, class Named> void archive(Archive& at, NameTable<Named>& names) {
    if constexpr (Archive::is_reading) {
        names = {};
        for (auto left = at.listed(sizeof(typename NameTable<Named>::Entry)); left > 0 && !at.failed(); --left) {
            std::string name;
            Named named{};
            archive_all(at, name, named);
            names.emplace_back(name, named);
        }
    } else {
        at.count(names.size());
        for (auto [name, named] : names) archive_all(at, name, named);
    }
}

// --- choices ---------------------------------------------------------------------------------------------------------

template <class Archive, class T> void archive(Archive& at, std::optional<T>& value) {
    bool has = value.has_value();
    archive(at, has);
    if constexpr (Archive::is_reading) value = has ? std::optional<T>(T{}) : std::nullopt;
    if (has) archive(at, *value);
}
/// Makes the alternative of a number the one that is held.
template <class... T> bool hold_alternative(std::variant<T...>& value, std::size_t number) {
    std::size_t i = 0;
    return ((i++ == number ? (value.template emplace<T>(), true) : false) || ...);
}
template <class Archive, class... T> void archive(Archive& at, std::variant<T...>& value) {
    if constexpr (Archive::is_reading) {
        if (!hold_alternative(value, at.template number<std::uint8_t>())) return at.fail("an unknown sort");
    } else {
        at.number(std::uint8_t(value.index()));
    }
    std::visit([&](auto& held) { archive(at, held); }, value);
}

// --- ids -------------------------------------------------------------------------------------------------------------

template <class Archive, class Tag> void archive(Archive& at, Id<Tag>& id) {
    archive_all(at, id.index, id.generation);
}
template <class Archive> void archive(Archive& at, ConstraintId& id) {
    archive_all(at, id.kind, id.id);
}
template <class Archive, class Tag> void archive(Archive& at, HandleMap<Tag>& handles) {
    HandleMap<Tag>::fields(handles,
                           [&](auto& rows, auto& plain, auto& generation, auto& indices, auto& entries, auto& free) {
                               archive_all(at, rows, plain, generation, indices);
                               using Entry = typename HandleMap<Tag>::Entry;
                               std::vector<std::array<std::uint32_t, 2>> pairs;
                               if constexpr (Archive::is_reading) {
                                   archive(at, pairs);
                                   entries.clear();
                                   for (const auto& [row, stamp] : pairs) entries.push_back(Entry{row, stamp});
                               } else {
                                   for (const auto& [row, stamp] : entries) pairs.push_back({row, stamp});
                                   archive(at, pairs);
                               }
                               archive(at, free);
                           });
    if constexpr (Archive::is_reading)
        if (!handles.is_sound()) at.fail("handles and rows do not belong together");
}

} // namespace sinew::snapshot
