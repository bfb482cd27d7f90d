#include "sinew/math/decimal.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace sinew::decimal {
namespace {

/// Natural number of any size: 32 bits a word, the lowest first, no leading zeros.
class Natural {
  public:
    explicit Natural(std::uint64_t value) : words_{std::uint32_t(value), std::uint32_t(value >> 32)} { trim(); }

    bool is_zero() const { return words_.empty(); }
    int bits() const { return words_.empty() ? 0 : int(words_.size() * 32) - std::countl_zero(words_.back()); }

    /// this * factor + more
    void multiply(std::uint32_t factor, std::uint32_t more = 0) {
        std::uint64_t carry = more;
        for (auto& word : words_) {
            carry += std::uint64_t(word) * factor;
            word = std::uint32_t(carry);
            carry >>= 32;
        }
        if (carry > 0) words_.push_back(std::uint32_t(carry));
    }
    void multiply_by_ten_to(int power) {
        for (; power > 0; --power) multiply(10);
    }
    void shift(int count) {
        if (is_zero()) return;
        for (; count >= 32; count -= 32) words_.insert(words_.begin(), 0);
        multiply(std::uint32_t(1) << count);
    }
    /// Subtracts a number that is not larger.
    void subtract(const Natural& other) {
        std::int64_t borrow = 0;
        for (std::size_t i = 0; i < words_.size(); ++i) {
            borrow += std::int64_t(words_[i]) - (i < other.words_.size() ? other.words_[i] : 0);
            words_[i] = std::uint32_t(borrow);
            borrow >>= 32;
        }
        trim();
    }
    friend bool operator<(const Natural& a, const Natural& b) {
        if (a.words_.size() != b.words_.size()) return a.words_.size() < b.words_.size();
        return std::lexicographical_compare(a.words_.rbegin(), a.words_.rend(), b.words_.rbegin(), b.words_.rend());
    }

  private:
    std::vector<std::uint32_t> words_;

    void trim() {
        while (!words_.empty() && words_.back() == 0) words_.pop_back();
    }
};

/// Digits of a text as a whole number, and the power of ten that it is to be multiplied by.
struct Scanned {
    Natural digits{0};
    std::uint64_t few = 0; ///< the same if there are at most 18 digits
    int count = 0;
    int power = 0;
    bool is_negative = false;
};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

constexpr int max_power = 100'000; ///< beyond any that matters, with any number of digits that is kept

int exponent_of(std::string_view text) {
    const bool is_negative = text.starts_with('-');
    int power = 0;
    for (const char c : text)
        if (is_digit(c)) power = std::min(10 * power + (c - '0'), max_power);
    return is_negative ? -power : power;
}

/// Digits beyond the 800th cannot change the nearest number, except that there are any.
Scanned scan(std::string_view text) {
    constexpr int max_digits = 800;
    Scanned scanned;
    scanned.is_negative = text.starts_with('-');
    bool is_behind_point = false, is_more = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == 'e' || c == 'E') {
            scanned.power += exponent_of(text.substr(i + 1));
            break;
        }
        is_behind_point = is_behind_point || c == '.';
        if (!is_digit(c)) continue;
        const bool is_kept = scanned.count < max_digits;
        scanned.power += int(!is_kept) - int(is_behind_point);
        is_more = is_more || (!is_kept && c != '0');
        if (!is_kept || (scanned.count == 0 && c == '0')) continue;
        if (++scanned.count <= 18) scanned.few = 10 * scanned.few + std::uint64_t(c - '0');
        scanned.digits.multiply(10, std::uint32_t(c - '0'));
    }
    if (is_more) scanned.digits.multiply(10, 1), --scanned.power;
    return scanned;
}

/// The double nearest to a quotient of positive numbers, by long division.
double nearest(Natural above, Natural below) {
    int exponent = above.bits() - below.bits();
    exponent > 0 ? below.shift(exponent) : above.shift(-exponent);
    if (above < below) above.shift(1), --exponent; // 1 <= above / below < 2
    if (exponent > 1023) return std::numeric_limits<double>::infinity();
    const bool is_normal = exponent >= -1022;
    const int bits = is_normal ? 53 : std::max(53 + exponent + 1022, -1);
    if (bits < 0) return 0;
    std::uint64_t mantissa = 0;
    for (int i = 0; i < bits; ++i) {
        const bool bit = !(above < below);
        if (bit) above.subtract(below);
        mantissa = 2 * mantissa + bit;
        above.shift(1);
    }
    const bool is_above_half = below < above, is_half = !is_above_half && !(above < below);
    mantissa += is_above_half || (is_half && mantissa % 2 == 1);
    return std::bit_cast<double>(is_normal ? (std::uint64_t(exponent + 1022) << 52) + mantissa : mantissa);
}

/// Powers of ten up to 22 and numbers of 15 digits are exact: one rounding.
double quick(std::uint64_t digits, int power) {
    double scale = 1;
    for (int i = power < 0 ? -power : power; i > 0; --i) scale *= 10;
    return power < 0 ? double(digits) / scale : double(digits) * scale;
}

} // namespace

double parse(std::string_view text) {
    auto [digits, few, count, power, is_negative] = scan(text);
    double size = 0;
    if (digits.is_zero() || count + power < -400) {
        size = 0;
    } else if (count + power > 400) {
        size = std::numeric_limits<double>::infinity();
    } else if (count <= 15 && power >= -22 && power <= 22) {
        size = quick(few, power);
    } else {
        Natural below{1};
        power < 0 ? below.multiply_by_ten_to(-power) : digits.multiply_by_ten_to(power);
        size = nearest(std::move(digits), std::move(below));
    }
    return is_negative ? -size : size;
}

Digits round(double number, int count) {
    if (number == 0) return {std::string(std::size_t(count), '0'), 0};
    const auto bits = std::bit_cast<std::uint64_t>(number);
    const int stored = int(bits >> 52 & 0x7ff), power = std::max(stored, 1) - 1075;
    Natural above{(bits & ((std::uint64_t(1) << 52) - 1)) | std::uint64_t(stored > 0) << 52}, below{1};
    int exponent = (above.bits() + power - 1) * 30103 / 100000 - (number < 1); // of ten, or one less or more
    power > 0 ? above.shift(power) : below.shift(-power);
    exponent > 0 ? below.multiply_by_ten_to(exponent) : above.multiply_by_ten_to(-exponent);
    for (; above < below; --exponent) above.multiply(10);
    for (Natural ten = below; ten.multiply(10), !(above < ten); ++exponent) below = ten;

    Digits digits{{}, exponent};
    for (int i = 0; i < count; ++i) {
        char digit = '0';
        for (; !(above < below); ++digit) above.subtract(below);
        digits.digits += digit;
        above.multiply(10);
    }
    below.multiply(5); // half of the factor of `above`
    const bool is_odd = (digits.digits.back() - '0') % 2 == 1;
    if (below < above || (is_odd && !(above < below))) {
        auto last = digits.digits.rbegin();
        for (; last != digits.digits.rend() && *last == '9'; ++last) *last = '0';
        if (last != digits.digits.rend())
            ++*last;
        else
            digits.digits.insert(0, "1").pop_back(), ++digits.exponent;
    }
    return digits;
}

} // namespace sinew::decimal
