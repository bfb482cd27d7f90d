#include "sinew/math/decimal.h"

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>
#include <string>

/// The C library is the judge of both directions.
namespace sinew::SINEW_TEST_FILE {
namespace {

void expect_parsed_alike(const std::string& text) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(decimal::parse(text)),
              std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)))
        << text;
}

std::string printed(double number, int count) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*e", count - 1, number);
    return text;
}
std::string rounded(double number, int count) {
    const auto [digits, exponent] = decimal::round(number, count);
    char power[8];
    std::snprintf(power, sizeof power, "e%+03d", exponent);
    return digits.substr(0, 1) + (count > 1 ? "." : "") + digits.substr(1) + power;
}

double any_double(std::mt19937_64& random) {
    for (;;)
        if (const double number = std::abs(std::bit_cast<double>(random())); number <= 1.7976931348623157e308)
            return number;
}

TEST(Decimal, ParsesLikeTheCLibrary) {
    for (const char* text : {"0",
                             "-0",
                             "1",
                             "-1.5",
                             "0.1",
                             "1e22",
                             "1e23",
                             "123456789012345678",
                             "9007199254740993",
                             "9007199254740992.5",
                             "2.2250738585072011e-308",
                             "2.2250738585072014e-308",
                             "4.9e-324",
                             "2.4703282292062327e-324",
                             "2.4703282292062328e-324",
                             "1.7976931348623158e308",
                             "1.7976931348623159e308",
                             "1e400",
                             "-1e-400",
                             "1E5",
                             "1e+5",
                             "0.000e99999999999",
                             "179769313486231580793e289",
                             "100000000000000016777215",
                             "100000000000000016777216"})
        expect_parsed_alike(text);
    expect_parsed_alike("0." + std::string(400, '0') + "1e400");
    expect_parsed_alike("1" + std::string(900, '0') + "e-900");
    expect_parsed_alike("9007199254740992" + std::string(900, '0') + "1e-901"); // above a tie by its last digit
    expect_parsed_alike("9007199254740993" + std::string(900, '0') + "1e-901");
    std::mt19937_64 random(1);
    for (int i = 0; i < 3000; ++i) {
        const double number = any_double(random);
        for (const int count : {1, 3, 15, 16, 17, 20, 30}) expect_parsed_alike(printed(number, count));
    }
}

TEST(Decimal, RoundsLikeTheCLibrary) {
    for (const double number : {0.0,
                                1.0,
                                0.5,
                                1.5,
                                2.5,
                                0.125,
                                9.5,
                                99.5,
                                999999.5,
                                1e22,
                                1e23,
                                5e-324,
                                1e-5,
                                0.1,
                                8.5,
                                2.2250738585072014e-308,
                                1.7976931348623157e308,
                                9.999999999999999e22,
                                1e15,
                                12345678.5})
        for (int count = 1; count <= 17; ++count) EXPECT_EQ(rounded(number, count), printed(number, count));
    std::mt19937_64 random(2);
    for (int i = 0; i < 2000; ++i) {
        const double number = any_double(random);
        for (const int count : {1, 2, 15, 17}) EXPECT_EQ(rounded(number, count), printed(number, count));
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
