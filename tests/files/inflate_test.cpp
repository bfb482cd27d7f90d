#include "files/in/encoded.h"
#include "files/in/inflate.h"
#include "files/out/deflate.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

using files::deflated;
using files::inflate;

constexpr std::size_t plenty = 1'000'000;

// The squares of 0 to 399, in a block of dynamic codes.
constexpr const char* counted_squares =
    "eNo1VsmRIzEM+08UE8A8JB4iWc4/rwVA78ftbkk8QUDn83P/fuPvd/5+7/v7tfz7dTxjPj8Pnxur9xz8GP9FcBv3zvv8GHdb8ljj"
    "m1vwMO3xRMT9/ETjWxpWs7Dv8cTjv+K36vj8dODE8MQ8eaOZe2jxXhq/8IMwbfjf5T0USCqmp/CeIq0Hg7dDETIPO4rxKjc7+G5+"
    "cNbiIDpLnrV3cNZK31t7hvtdZx0uPz/IjRk6a+JBXy6/XozBm/H4PFQtDuMM1Sac8Ucwl3jMK0r1QbqfnzzMPK9K5KpRsDSpKmXp"
    "/xg7cbgHBrD/qbgvaecVbb6m/TqJOEt+yxlDJWtVxdhqGGerlW19WXb19zGvbtZqlC828n+wDvMO6jl9FgUq9LF9i6M2Pe5Dt3jo"
    "YpGduuZ6C/XhPjq6t9Uh+6LJ1TvLYMOs1FWbbbFyuB65DRcSfASLuA+xw7KsIAWhsltwuKzhTWfh7lbxZhfKglNae66db889oe7W"
    "Fe4q5KHgDwdq5L03FiBKbxvnHMFvNgcUCc28o/xQHGZrR7nbKYHwflHogiEQCw9GMwSl6mlfKJpqbX615rGIRYQ4EGslXDZDnQMs"
    "5S9N3lOgNKCG6AZguPaEA0NePLcIsUrNbQk7hjTRB2uhCsMsKyO82SRrht6wgpiJ0mg8dtrP6O0KvciOO92Ea0yMBsSEePdLD+6a"
    "Bfemd98pQaNHb8M4PV3DlMUcQCey8r4z1xrA2mmsx0p475yCRziorQkGXM6O5Fk+EiMBtHprrsU19oGI0sDKCjAg+jNxSLjRHz7R"
    "OwiNnY4Q76DBjDNSjBRZGvu3c/+eBr8OsRSVO/riNzCiYmnxXoyxZjHiwzyXaM2zDHCPKOAufwJh4tIQa5h6lMACqpTe9JAhHgaL"
    "0HumYkGfR6Qi3k5AH33IEp+Dk2WlD/NLNIVWgEvunGQlsIGdfidZJXZj+MgjQjqs51vsPt83T5IGaYo7Y8+lqvtybT55YJFoBVVC"
    "Dm9jQaUZGRvNtVHUyECEdpbdTonqrrKtq9zLpDy1dSlXlcCDrFmhY+hDpepZywyApd7eKlGpD1XqSrFHONDqGKiAHvpIk/qot30V"
    "S1/1veEdHtqEiXYhpGPpNoSeTmGpU8hCepSVLtUFvMIqdUuhuoXPHqF1FrsDpkWV5grXc4VyTijJepUKgicaD03HRFMMJzU5s3M0"
    "T3o1pRmb0sRNa/4w4Oz0jGYT2zWq94DOxfS3/svz6oBrzPF8VHEQlkgAT3HCPV8CBpb3/c2ul/gEkmG8IFDo196IfKgh8oeFvQJc"
    "MRWiWCpm18no10VrUBmxHJ6SOF4ZZO8+USKes/qDuwGJ/bavOq3c4VnSLtRVUoa7gpTN7sqemJka5St85rPrsdJn6Xv+rT174nxo"
    "WsgfopB/668AzsbnZ+WDVB96rrjwpsH8/L8M+iqRx1cIc3UKcFe9/KtiYEPV03s1zmclDyOg+seSChR09TFs18EZ6h/wuGL6X1tz"
    "7YOcV3nf+o9aXY7eaxlQIm1k2yW/J/dydje//Co+FEr5gwF0ScMuXQ9AU756vfXLt3cJcpPWe28aCIMD8A8tLv63";

std::string of_base64(const std::string& text) {
    return files::from_base64(text).value_or("");
}

TEST(Inflate, ReadsWhatDeflateWrites) {
    std::string noise, stairs;
    for (std::uint32_t i = 0; i < 70'000; ++i) {
        noise += char(i * i * 2654435761U >> 24U);
        stairs += char(i / 300);
    }
    for (const auto& bytes : {std::string(), std::string("a"), std::string(100'000, '\0'), noise, stairs, noise + noise,
                              std::string("abcabcabcabcabcabcabcd")}) {
        const auto read = inflate(deflated(bytes), bytes.size());
        EXPECT_EQ(read.problem, "");
        EXPECT_EQ(read.bytes, bytes);
    }
    EXPECT_LT(deflated(stairs).size(), stairs.size() / 50);
}

// Streams that zlib wrote: fixed codes, stored bytes, a header of gzip, dynamic codes.
TEST(Inflate, ReadsStreamsOfOtherWriters) {
    EXPECT_EQ(inflate(of_base64("eJzLSM3JyVcozy/KSQEAGgsEXQ=="), plenty).bytes, "hello world");
    EXPECT_EQ(inflate(of_base64("eAEBCwD0/2hlbGxvIHdvcmxkGgsEXQ=="), plenty).bytes, "hello world");
    EXPECT_EQ(inflate(of_base64("H4sIAAAAAAACA8tIzcnJVyjPL8pJAQCFEUoNCwAAAA=="), plenty).bytes, "hello world");
    const auto dynamic = inflate(of_base64(counted_squares), plenty);
    std::string counted;
    for (int i = 0; i < 400; ++i) counted += std::to_string(i * i) + (i % 7 == 0 ? ";\n" : ", ");
    EXPECT_EQ(dynamic.problem, "");
    EXPECT_EQ(dynamic.bytes, counted);
}

TEST(Inflate, DamageIsToldWithItsByte) {
    const auto whole = deflated("hello world, hello world, hello world");
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto cut = inflate(std::string_view(whole).substr(0, size), plenty);
        EXPECT_NE(cut.problem, "") << size;
        EXPECT_LE(cut.at, size);
    }
    EXPECT_NE(inflate(whole, 20).problem.find("more than 20"), std::string::npos);
    auto wrong = whole;
    wrong.back() = char(wrong.back() + 1);
    EXPECT_NE(inflate(wrong, plenty).problem.find("checksum"), std::string::npos);
    EXPECT_NE(inflate("\x78\x9c\x07", plenty).problem, ""); // no kind of block
    EXPECT_NE(inflate(std::string_view("\x78\x01\x63\0\x02", 5), plenty).problem,
              ""); // a copy from before the beginning
    EXPECT_NE(inflate("plain text", plenty).problem.find("zlib"), std::string::npos);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
