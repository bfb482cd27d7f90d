#include "sinew/snapshot/compare.h"

#include "sinew/snapshot/world_visitors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sinew {
namespace {

/// Numbers of a field, so many a row.
struct Numbers {
    std::string name;
    std::size_t width = 1;
    std::vector<double> all;
};

/// Lists the numbers of all fields that decide a step; of a field that is no column, the bytes.
class NumberLister {
  public:
    std::vector<Numbers> list;

    void enter(std::string_view part) { part_ = part; }
    template <class T> void fixed(std::string_view name, const T& field) { put(name, field); }
    template <class T> void moving(std::string_view name, const T& field) { put(name, field); }
    template <class T> void noted(std::string_view, const T&) {}
    template <class T> void derived(std::string_view, const T&) {}

  private:
    std::string part_;

    Numbers& begin(std::string_view name, std::size_t width = 1) {
        list.push_back({part_ + "." + std::string(name), width, {}});
        return list.back();
    }
    template <class T>
    requires std::is_arithmetic_v<T>
    void put(std::string_view name, const T& value) { begin(name).all.push_back(double(value)); }
    template <int D, class Real> void put(std::string_view name, const std::vector<Vec<D, Real>>& column) {
        auto& numbers = begin(name, D);
        for (const auto& row : column)
            for (int i = 0; i < D; ++i) numbers.all.push_back(double(row[i]));
    }
    template <class T>
    requires std::is_arithmetic_v<T>
    void put(std::string_view name, const std::vector<T>& column) {
        begin(name).all.assign(column.begin(), column.end());
    }
    template <class T> void put(std::string_view name, const Column<T>& column) {
        auto& numbers = begin(name);
        for (std::size_t row = 0; row < column.size(); ++row) numbers.all.push_back(double(column[row]));
    }
    template <int N, class Real> void put(std::string_view name, const Column<Vec<N, Real>>& column) {
        auto& numbers = begin(name, N);
        for (std::size_t row = 0; row < column.size(); ++row)
            for (int i = 0; i < N; ++i) numbers.all.push_back(double(column[row][i]));
    }
    template <int D, class Real> void put(std::string_view name, const Column<collide::Rotation<D, Real>>& column) {
        auto& numbers = begin(name, D == 2 ? 2 : 4);
        for (std::size_t row = 0; row < column.size(); ++row)
            for (std::size_t i = 0; i < numbers.width; ++i) numbers.all.push_back(double(column[row].number[int(i)]));
    }
    template <class Real> void put(std::string_view name, const LimitColumns<Real>& limits) {
        auto& numbers = begin(name, 2);
        for (std::size_t row = 0; row < limits.size(); ++row) {
            numbers.all.push_back(double(limits.low(row)));
            numbers.all.push_back(double(limits.high(row)));
        }
    }
    /// Generations of handles belong to a process.
    template <class Tag> void put(std::string_view, const HandleMap<Tag>&) {}
    void put(std::string_view, const std::vector<Figure>&) {}
    void put(std::string_view, const NameTable<FigureIndex>&) {}
    template <int D, class Real> void put(std::string_view name, const std::vector<Pin<D, Real>>& pins) {
        auto& numbers = begin(name, 2 * D);
        for (const auto& pin : pins)
            for (const auto* at : {&pin.target, &pin.multiplier})
                for (int i = 0; i < D; ++i) numbers.all.push_back(double((*at)[i]));
    }
    template <int D, class Real>
    void put(std::string_view name, const std::vector<collide::Collider<D, Real>>& colliders) {
        auto& numbers = begin(name, D);
        for (const auto& collider : colliders)
            for (int i = 0; i < D; ++i) numbers.all.push_back(double(collider.target.position[i]));
    }
    template <int D, class Real> void put(std::string_view name, const ForceTable<D, Real>& forces) {
        put(name, std::vector<Force<D, Real>>(forces.begin(), forces.end()));
    }
    template <class T> void put(std::string_view name, const T& value) {
        std::vector<std::byte> bytes;
        snapshot::ByteWriter writer(bytes, false);
        archive(writer, const_cast<T&>(value)); // a writer changes nothing
        auto& numbers = begin(name);
        for (const auto byte : bytes) numbers.all.push_back(double(std::to_integer<int>(byte)));
    }
};

bool are_equal(double a, double b) {
    return are_same(a, b) || (std::isnan(a) && std::isnan(b));
}

std::optional<WorldDifference> compared(const Numbers& a, const Numbers& b) {
    WorldDifference found{.field = a.name};
    const auto count = std::max(a.all.size(), b.all.size());
    constexpr double none = std::numeric_limits<double>::quiet_NaN(); // a row that one of them has not
    std::size_t last_row = ~std::size_t(0);
    for (std::size_t i = 0; i < count; ++i) {
        const double x = i < a.all.size() ? a.all[i] : none, y = i < b.all.size() ? b.all[i] : none;
        if (are_equal(x, y)) continue;
        if (found.rows == 0) found.row = i / a.width, found.component = i % a.width, found.first = x, found.second = y;
        if (i / a.width != last_row) ++found.rows, last_row = i / a.width;
        if (const double apart = std::fabs(x - y); apart > found.most) found.most = apart;
    }
    return found.rows > 0 ? std::optional(found) : std::nullopt;
}

} // namespace

template <int D, class Real>
std::optional<WorldDifference> difference(const World<D, Real>& first, const World<D, Real>& second) {
    NumberLister a, b;
    visit_fields(first, a);
    visit_fields(second, b);
    for (std::size_t i = 0; i < a.list.size(); ++i)
        if (auto found = compared(a.list[i], b.list[i])) return found;
    return std::nullopt;
}

#define SINEW_DIFFERENCE(D, Real)                                                                                      \
    template std::optional<WorldDifference> difference(const World<D, Real>&, const World<D, Real>&);
SINEW_INSTANTIATE(SINEW_DIFFERENCE)

} // namespace sinew
