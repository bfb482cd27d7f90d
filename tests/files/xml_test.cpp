#include "files/in/import.h"
#include "files/in/xml.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

using files::XmlDocument;

std::string refusal_of(const std::string& text) {
    try {
        const XmlDocument document(text);
    } catch (const files::ImportError& error) {
        return error.place + " " + error.message;
    }
    return "accepted";
}

TEST(Xml, ElementsAttributesAndTextsAreThoseOfTheFile) {
    const XmlDocument document(
        "\xef\xbb\xbf<?xml version='1.0' encoding='UTF-8'?>\n<!-- <no> -->\n"
        "<!DOCTYPE a [<!-- ] --> <!ENTITY who \"w&#246;rld\"> <!ELEMENT a ANY>]>\n"
        "<a x='1' y:z = \"&lt;&amp;&#x41;&who;\"\n>hello <b/><![CDATA[<&]]>&gt;<c d=''>t</c ></a>\n");
    const auto& root = document.root();
    EXPECT_EQ(root.name, "a");
    EXPECT_EQ(root.value("x"), "1");
    EXPECT_EQ(root.value("y:z"), "<&Aw\xc3\xb6rld");
    EXPECT_EQ(root.text, "hello <&>");
    ASSERT_EQ(root.children.size(), 2U);
    EXPECT_EQ(root.children[1].text, "t");
    EXPECT_TRUE(root.children[1].has("d"));
    EXPECT_FALSE(root.has("d"));
    EXPECT_EQ(root.child("c"), &root.children[1]);
    EXPECT_EQ(root.child("e"), nullptr);
    EXPECT_EQ(document.place_of(root), "4:2");
    EXPECT_EQ(document.place_of(root.children[1]), "5:31");
}

TEST(Xml, LatinTextsBecomeUtf8) {
    const XmlDocument document("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><a b=\"\xe9\">\xfc</a>");
    EXPECT_EQ(document.root().value("b"), "\xc3\xa9");
    EXPECT_EQ(document.root().text, "\xc3\xbc");
}

TEST(Xml, FaultsAreToldWithTheirPlace) {
    const std::pair<const char*, const char*> faults[] = {
        {"", "1:1 the XML has no element"},
        {"<a>\n <b>\n</a>", "3:1 expected </b>, found </a>"},
        {"<a>\n <b", "2:3 the XML breaks off in <b>"},
        {"<a>\n <b>", "2:3 the XML breaks off: <b> is not closed"},
        {"<a/>\n<b/>", "2:1 the XML has a second element"},
        {"<a/> b", "1:6 there is text outside"},
        {"b <a/>", "1:1 there is text outside"},
        {"<a b=1/>", "1:4 the value of b is in quotes"},
        {"<a b/>", "1:4 an attribute of <a> is name=\"value\""},
        {"<a b='1' b='2'/>", "1:10 the attribute b is there twice"},
        {"<a b='<c>'/>", "1:4 the value of b has a <"},
        {"<a b='1/>", "1:7 the XML breaks off in an attribute"},
        {"<a>x < y</a>", "1:6 an element begins with its name"},
        {"<a>\n&nbsp;</a>", "2:1 the entity &nbsp; is not known"},
        {"<a>&#0;</a>", "1:4 &#0; is no character"},
        {"<a>&#xd800;</a>", "1:4 &#xd800; is no character"},
        {"<a>this & that</a>", "1:9 an & begins a reference"},
        {"<a><!-- ", "1:8 the XML breaks off in a comment"},
        {"<!DOCTYPE a [<!ENTITY b 'c'>", "1:1 the XML breaks off in the document type"},
        {"</a>", "1:1 </a> closes nothing"},
        {"<a></b></a>", "1:4 expected </a>, found </b>"},
        {"<?xml version='1.0' encoding='EBCDIC'?><a/>", "1:1 the XML is in the encoding \"EBCDIC\""},
        {"\xff\xfe<a/>", "1:1 the XML is UTF-16"},
    };
    for (const auto& [text, message] : faults)
        EXPECT_EQ(refusal_of(text).substr(0, std::string(message).size()), message) << text;
}

TEST(Xml, SizesAreLimited) {
    std::string deep, wide = "<a", many = "<a>";
    for (int i = 0; i < 100; ++i) deep += "<a>";
    EXPECT_NE(refusal_of(deep).find("deep"), std::string::npos);
    for (int i = 0; i < 300; ++i) wide += " b" + std::to_string(i) + "=''";
    EXPECT_NE(refusal_of(wide + "/>").find("256 attributes"), std::string::npos);
    for (int i = 0; i < 1'000'001; ++i) many += "<b/>";
    EXPECT_NE(refusal_of(many + "</a>").find("1000000 elements"), std::string::npos);
    std::string bomb = "<!DOCTYPE a [<!ENTITY b '" + std::string(100'000, 'x') + "'>]><a>";
    for (int i = 0; i < 11; ++i) bomb += "&b;";
    EXPECT_NE(refusal_of(bomb + "</a>").find("entities stand for"), std::string::npos);
    std::string levels = "<!DOCTYPE a [<!ENTITY e0 'xxxxxxxxxx'>";
    for (int i = 1; i < 40; ++i) {
        const auto one = "&e" + std::to_string(i - 1) + ";";
        levels += "<!ENTITY e" + std::to_string(i) + " '" + one + one + "'>";
    }
    EXPECT_NE(refusal_of(levels + "]><a>&e39;</a>").find("entities stand for"), std::string::npos);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
