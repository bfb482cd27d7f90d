#include "sinew/scene/json.h"

#include "tests/cpu_time.h"
#include "tests/scene/laws.h"
#include "tests/scene/sample.h"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>
#include <string>

namespace sinew::SINEW_TEST_FILE {
namespace {

struct Parsed {
    Diagnostics diagnostics;
    std::optional<json::Value> value;
};

Parsed parsed(std::string text, const Limits& limits = {}) {
    Parsed result;
    const auto source = result.diagnostics.add_source("a.json", std::move(text));
    result.value = json::parse(source, result.diagnostics, limits);
    return result;
}

/// The first line of the message, without the name of the file.
std::string first_error(std::string text, const Limits& limits = {}) {
    const auto message = to_text(parsed(std::move(text), limits).diagnostics);
    return message.substr(0, message.find('\n')).substr(message.empty() ? 0 : 7);
}

// --- what is read -----------------------------------------------------------------------------------------------

TEST(Json, KeepsTheOrderOfTheDocument) {
    const auto value = parsed(R"({"z": 1, "a": [true, null, "x"], "m": {"k": 2.5}})").value;
    ASSERT_TRUE(value);
    EXPECT_EQ(json::to_text(*value), R"({"z": 1, "a": [true, null, "x"], "m": {"k": 2.5}})");
}

TEST(Json, AllowsComments) {
    EXPECT_EQ(parsed("// one\n{ /* two */ \"a\" // three\n : 1 }\n// four").value, parsed("{\"a\": 1}").value);
}

TEST(Json, AByteOrderMarkIsNoPartOfTheText) {
    EXPECT_EQ(parsed("\xEF\xBB\xBF[1]").value, parsed("[1]").value);
}

TEST(Json, WholeNumbersAreExactWhateverTheyLookLike) {
    const auto integer = [](std::string text) { return parsed(std::move(text)).value->as<json::Number>()->integer; };
    EXPECT_EQ(integer("9007199254740993"), 9007199254740993);
    EXPECT_EQ(integer("-9223372036854775808"), INT64_MIN);
    EXPECT_EQ(integer("3.0"), 3);
    EXPECT_EQ(integer("1e9"), 1000000000);
    EXPECT_EQ(integer("3.5"), std::nullopt);
    EXPECT_EQ(integer("9223372036854775808"), std::nullopt);
    EXPECT_EQ(parsed("18446744073709551615").value->as<json::Number>()->value, 18446744073709551615.0);
}

// A scene written down and read again is the same to the last bit.
TEST(Json, NegativeZeroIsZero) {
    for (const auto* const text : {"-0.0", "-0", "-0e3", "-1e-400"}) {
        const auto value = parsed(text).value;
        ASSERT_TRUE(value) << text;
        EXPECT_FALSE(std::signbit(value->as<json::Number>()->value)) << text;
    }
}

TEST(Json, EveryValueAndKeyKnowsItsBytes) {
    const std::string text = "{ \"a\" : [1, -2.5e3 , \"b\\\"c\"], // d\n \"größe\":{\"x\":null} }";
    const auto result = parsed(text);
    ASSERT_TRUE(result.value);
    const auto at = [&](std::string_view pointer) {
        return result.diagnostics.text(json::find(*result.value, pointer)->span);
    };
    EXPECT_EQ(at(""), text);
    EXPECT_EQ(at("/a"), "[1, -2.5e3 , \"b\\\"c\"]");
    EXPECT_EQ(at("/a/0"), "1");
    EXPECT_EQ(at("/a/1"), "-2.5e3");
    EXPECT_EQ(at("/a/2"), "\"b\\\"c\"");
    EXPECT_EQ(at("/größe"), "{\"x\":null}");
    EXPECT_EQ(at("/größe/x"), "null");
    EXPECT_EQ(result.diagnostics.text(json::find(*result.value->as<json::Object>(), "größe")->key_span), "\"größe\"");
}

TEST(Json, PointersNameMembersAndElements) {
    const auto value = *parsed(R"({"a/b": {"~": [10, 20]}})").value;
    EXPECT_EQ(*json::find(value, "/a~1b/~0/1"), json::Value(20));
    EXPECT_EQ(json::find(value, "/a~1b/~0/2"), nullptr);
    EXPECT_EQ(json::find(value, "/a~1b/x"), nullptr);
    EXPECT_EQ(json::find(value, "/a~1b/~0/1/2"), nullptr);
}

TEST(Json, NumbersAreWrittenAsShortAsTheyReadBack) {
    EXPECT_EQ(json::to_text(json::Array{0.1, 1e-6, 1e22, -2.5e-300, 1e6, 123456789}),
              "[0.1, 1e-6, 1e22, -2.5e-300, 1000000, 123456789]");
}

TEST(Json, LongValuesAreWrittenOneItemALine) {
    json::Array items(30, "some text");
    const auto text = json::to_text(json::Object{{"items", items}, {"short", json::Array{1, 2}}});
    EXPECT_NE(text.find("{\n  \"items\": [\n    \"some text\",\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\n  \"short\": [1, 2]\n}"), std::string::npos) << text;
    EXPECT_EQ(parsed(text).value, json::Value(json::Object{{"items", items}, {"short", json::Array{1, 2}}}));
}

// --- what is refused, and where ---------------------------------------------------------------------------------

TEST(Json, SyntaxErrorsAreWhereTheyAre) {
    EXPECT_EQ(first_error(""), "1:1: error: the file is empty at /");
    EXPECT_EQ(first_error("  // nothing\n"), "2:1: error: the file is empty at /");
    EXPECT_EQ(first_error("{\"a\": [1,\n"), "2:1: error: the file ends too early at /a/1");
    EXPECT_EQ(first_error("{\"a\":1,}"), "1:7: error: a comma before \"}\" at /");
    EXPECT_EQ(first_error("[1,,2]"), "1:4: error: expected a value, found \",\" at /1");
    EXPECT_EQ(first_error("[1 2]"), "1:4: error: expected \",\" or \"]\", found \"2\" at /1");
    EXPECT_EQ(first_error("{\"a\": [0, -9.81}}"), "1:16: error: expected \",\" or \"]\", found \"}\" at /a/2");
    EXPECT_EQ(first_error("{\"a\":1 \"b\":2}"), "1:8: error: expected \",\" or \"}\", found the string \"b\" at /");
    EXPECT_EQ(first_error("{\"a\" 1}"), "1:6: error: expected \":\" after the key, found \"1\" at /a");
    EXPECT_EQ(first_error("{a: 1}"), "1:2: error: expected a key in double quotes, found \"a\" at /");
    EXPECT_EQ(first_error("{\"a\": 1} x"), "1:10: error: expected the end of the file, found \"x\" at /");
    EXPECT_EQ(first_error("{\"a\": tru}"), "1:7: error: expected a value, found \"tru\" at /a");
    EXPECT_EQ(first_error("[01]"), "1:2: error: expected a value, found \"01\" at /1");
    EXPECT_EQ(first_error("[1, /* open"), "1:5: error: the comment is not closed at /1");
    EXPECT_EQ(first_error("[1] /* open"), "1:5: error: the comment is not closed at /");
    EXPECT_EQ(first_error(std::string("{}\0{}", 5)),
              "1:3: error: expected the end of the file, found \"\\u0000\" at /");
}

TEST(Json, StringsThatAreNoStringsAreShownTheirCharacter) {
    EXPECT_EQ(first_error("[\"a\tb\"]"), "1:4: error: a control character inside a string at /0");
    EXPECT_EQ(first_error("[\"a\\q\"]"), "1:4: error: unknown escape in a string at /0");
    EXPECT_EQ(first_error("[\"abc\n]"), "1:2: error: the string is not closed on its line at /0");
    EXPECT_EQ(first_error("[\"\\ud800\"]").substr(0, 16), "1:2: error: inva");
    EXPECT_EQ(first_error("[\"\xFF\"]"), "1:3: error: the byte 0xff is not UTF-8 at /");
    EXPECT_EQ(first_error("[\"\xC0\x80\"]"), "1:3: error: the byte 0xc0 is not UTF-8 at /");
    EXPECT_EQ(first_error("\xFF\xFE{\0}"), "1:1: error: the byte 0xff is not UTF-8 at /");
}

TEST(Json, NumbersAreFinite) {
    EXPECT_EQ(first_error("[1, 1e400]"), "1:5: error: the number 1e400 is too large at /1");
    EXPECT_EQ(first_error("[-1e400]"), "1:2: error: the number -1e400 is too large at /0");
    EXPECT_EQ(first_error("{\"a\": NaN}"), "1:7: error: expected a value, found \"NaN\" at /a");
    EXPECT_EQ(first_error("[-Infinity]"), "1:2: error: expected a value, found \"-Infinity\" at /0");
    EXPECT_EQ(*parsed("1e-400").value, json::Value(0));
}

TEST(Json, APropertyTwiceIsAnErrorAtTheSecond) {
    auto result = parsed("{\"a\": 1, \"b\": {\"a\": 2, \"c\": 3, \"c\": 4}, \"a\": 5}");
    const auto text = to_text(result.diagnostics);
    EXPECT_NE(text.find("a.json:1:32: error: duplicate property \"c\" at /b\n"), std::string::npos) << text;
    EXPECT_NE(text.find("a.json:1:41: error: duplicate property \"a\" at /\n"), std::string::npos) << text;
    EXPECT_EQ(*result.value, *parsed("{\"a\": 1, \"b\": {\"a\": 2, \"c\": 3}}").value);
}

TEST(Json, LimitsAreStatedWithTheirNumbers) {
    EXPECT_EQ(first_error("[1,2,3]", {.bytes = 6}), "1:1: error: a file of 7 bytes, at most 6 are allowed at /");
    EXPECT_EQ(first_error("[[[1]]]", {.depth = 2}), "1:3: error: objects and arrays more than 2 deep at /0/0");
    EXPECT_EQ(first_error("[1,2,3]", {.values = 3}), "1:6: error: more than 3 values at /2");
    EXPECT_EQ(first_error("[\"abcd\"]", {.string_bytes = 3}),
              "1:2: error: a string of 4 bytes, at most 3 are allowed at /0");
    EXPECT_EQ(first_error("{\"abcd\": 1}", {.string_bytes = 3}),
              "1:2: error: a string of 4 bytes, at most 3 are allowed at /abcd");
    EXPECT_EQ(first_error("[[[1]]]", {.depth = 3, .values = 4}), "");
    EXPECT_EQ(first_error("[" + std::string(1000, '1') + "]"),
              "1:2: error: the number 1111111111111111111111111111111111111111... is too large at /0");
    EXPECT_EQ(first_error("[" + std::string(1001, '1') + "]", {.string_bytes = 1000}),
              "1:2: error: a word or number of 1001 bytes, at most 1000 are allowed at /");
}

struct Hostile {
    const char* name;
    std::string_view before, repeated, after;
    std::size_t bytes = std::size_t(Limits{}.bytes);

    std::string text() const {
        std::string text(before);
        text.reserve(bytes);
        while (text.size() + repeated.size() + after.size() < bytes) text += repeated;
        return text += after;
    }
};

class HostileFile : public testing::TestWithParam<Hostile> {};

TEST_P(HostileFile, IsRefusedInASecond) {
    const auto text = GetParam().text();
    const double seconds = test::cpu_seconds([&] {
        const auto result = parsed(text);
        EXPECT_FALSE(result.diagnostics.ok());
        EXPECT_LT(to_text(result.diagnostics).size(), 200'000u);
    });
    // A second is meant for the user's build; debug builds and sanitizers are allowed the tenfold.
    EXPECT_LT(seconds, 10.0);
}

const Hostile hostile_files[] = {
    {"Nesting", "", "[", ""},          {"NestedObjects", "", "{\"a\":", ""},
    {"Zeros", "[", "0,", "0]"},        {"EqualKeys", "{", "\"a\":0,", "\"a\":0}", 2'000'000},
    {"LongString", "\"", "x", "\""},   {"LongNumber", "", "9", ""},
    {"Comments", "", "//\n", ""},      {"OpenComment", "/*", "*", ""},
    {"Backslashes", "\"", "\\\\", ""}, {"Newlines", "", "\n", "x"},
};

std::string name_of_file(const testing::TestParamInfo<Hostile>& file) {
    return file.param.name;
}

INSTANTIATE_TEST_SUITE_P(Json, HostileFile, testing::ValuesIn(hostile_files), name_of_file);

// --- laws -------------------------------------------------------------------------------------------------------

rc::Gen<json::Value> any_value(int depth) {
    using namespace rc;
    const auto text = gen::map(gen::container<std::string>(gen::inRange<char>(0, 127)),
                               [](std::string s) { return json::Value(std::move(s)); });
    const auto number = gen::oneOf(
        gen::map(gen::arbitrary<std::int64_t>(), [](auto n) { return json::Value(n); }),
        gen::map(gen::arbitrary<double>(), [](double n) { return is_finite(n) ? json::Value(n) : json::Value(0.5); }));
    const auto leaf = gen::oneOf(gen::just(json::Value()),
                                 gen::map(gen::arbitrary<bool>(), [](bool b) { return json::Value(b); }), number, text);
    if (depth == 0) return leaf;
    const auto array = gen::mapcat(gen::inRange<std::size_t>(0, 4), [depth](std::size_t size) {
        return gen::map(gen::container<json::Array>(size, any_value(depth - 1)),
                        [](json::Array a) { return json::Value(std::move(a)); });
    });
    const auto object = gen::map(array, [](const json::Value& items) {
        json::Object members;
        for (const auto& item : *items.as<json::Array>()) members.push_back({concat("k", members.size()), item});
        return json::Value(std::move(members));
    });
    return gen::oneOf(leaf, array, object);
}

RC_GTEST_PROP(JsonLaw, WhatIsWrittenReadsBackAsTheSame, ()) {
    const auto value = *any_value(4);
    RC_ASSERT(parsed(json::to_text(value)).value == value);
}

RC_GTEST_PROP(JsonLaw, EverySpanReadAloneGivesItsValue, ()) {
    const auto text = json::to_text(*any_value(4));
    const auto result = parsed(text);
    RC_ASSERT(result.value.has_value());
    laws::each_value(*result.value, [&](const json::Value& value) {
        RC_ASSERT(parsed(std::string(result.diagnostics.text(value.span))).value == value);
    });
}

TEST(JsonLaw, EverySpanOfACommentedSceneReadAloneGivesItsValue) {
    const auto result = parsed(std::string(sample::good_scene));
    ASSERT_TRUE(result.value);
    laws::each_value(*result.value, [&](const json::Value& value) {
        EXPECT_EQ(parsed(std::string(result.diagnostics.text(value.span))).value, value);
    });
}

/// Text is either read or refused with a place inside it.
void expect_value_or_place(const std::string& text) {
    const auto result = parsed(text);
    RC_ASSERT(result.value.has_value() || !result.diagnostics.ok());
    for (const auto& diagnostic : result.diagnostics.in_order()) {
        RC_ASSERT(diagnostic.span.begin <= diagnostic.span.end);
        RC_ASSERT(diagnostic.span.end <= text.size());
    }
    RC_ASSERT(to_text(result.diagnostics).empty() == result.diagnostics.ok());
}

RC_GTEST_PROP(JsonLaw, AnyBytesAreReadOrRefused, (const std::string& text)) {
    expect_value_or_place(text);
}

RC_GTEST_PROP(JsonLaw, AnyTokensAreReadOrRefused, ()) {
    const auto tokens = *rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(std::vector<std::string>{
        "{",   "}",   "[", "]",  ",",  ":",  "\"a\"", "\"b\"", "1",  "-",        "0",    "2.5", "1e999", "true",
        "nul", "NaN", " ", "\n", "//", "/*", "*/",    "\"",    "\\", "\xC3\xA4", "\xFF", "'",   "+1"}));
    std::string text;
    for (const auto& token : tokens) text += token;
    expect_value_or_place(text);
}

RC_GTEST_PROP(JsonLaw, AcceptsWhatNlohmannAcceptsApartFromDuplicates, ()) {
    std::string text(sample::good_scene);
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    text.replace(at, *rc::gen::inRange<std::size_t>(0, 3),
                 *rc::gen::container<std::string>(rc::gen::elementOf(std::string("{}[],:\"0-e.x \n"))));
    auto result = parsed(text);
    const bool accepted = nlohmann::json::accept(text, true);
    RC_ASSERT(result.value.has_value() == accepted);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
