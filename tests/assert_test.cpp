#include "sinew/assert/assert.h"
#include "sinew/world/edit.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

/// Broken assertions reach the handler with their place, and are checked in the builds that say so.
namespace sinew::SINEW_TEST_FILE {
namespace {

struct Report {
    std::string file;
    int line = 0;
    std::string text;
};
std::vector<Report>& reports() {
    static std::vector<Report> all;
    return all;
}

void collect(const char* file, int line, const char* text) {
    reports().push_back({file, line, text});
}

/// Collects broken assertions instead of aborting.
class Assertion : public testing::Test {
  protected:
    Assertion() { reports().clear(); }
    ~Assertion() override { set_assertion_handler(before_); }

  private:
    AssertionHandler before_ = set_assertion_handler(collect);
};

TEST_F(Assertion, TellsTheHandlerItsPlaceAndText) {
    assertion_failed("some/file.cpp", 12, "a rope has two ends");
    ASSERT_EQ(reports().size(), 1U);
    EXPECT_EQ(reports()[0].file, "some/file.cpp");
    EXPECT_EQ(reports()[0].line, 12);
    EXPECT_EQ(reports()[0].text, "a rope has two ends");
}

TEST_F(Assertion, EvaluatesItsConditionOnlyWhereItIsChecked) {
    int evaluations = 0;
    const auto holds = [&](bool result) { return ++evaluations, result; };
    SINEW_ASSERT(holds(true), "holds");
    EXPECT_TRUE(reports().empty());
    const int line = __LINE__ + 1;
    SINEW_ASSERT(holds(false), "does not hold");
    EXPECT_EQ(evaluations, SINEW_ASSERTIONS ? 2 : 0);
    ASSERT_EQ(reports().size(), SINEW_ASSERTIONS ? 1U : 0U);
    for (const auto& report : reports()) {
        EXPECT_EQ(report.line, line);
        EXPECT_EQ(report.text, "does not hold");
        EXPECT_NE(report.file.find("assert_test.cpp"), std::string::npos);
    }
}

TEST_F(Assertion, FindsATableWhoseColumnsDisagree) {
    if (!SINEW_ASSERTIONS) GTEST_SKIP() << "assertions are not checked in this build";
    World<2, double> world;
    const auto a = add_particle(world, {}), b = add_particle(world, {.position = {{1, 0}}});
    add<Distance>(world, {a, b});
    EXPECT_TRUE(reports().empty());
    std::get<kind_number<Distance, 2>>(world.constraints).multiplier.push_back(0);
    add<Distance>(world, {a, b});
    ASSERT_EQ(reports().size(), 1U);
    EXPECT_NE(reports()[0].file.find("add.cpp"), std::string::npos);
    EXPECT_EQ(reports()[0].text, "the columns of a table have one length");
}

TEST_F(Assertion, ReturnsTheHandlerBefore) {
    EXPECT_EQ(set_assertion_handler(nullptr), collect);
    EXPECT_NE(set_assertion_handler(collect), collect);
}

TEST(AssertionDeathTest, PrintsItsPlaceAndAborts) {
    EXPECT_DEATH(assertion_failed("some/file.cpp", 12, "a rope has two ends"),
                 "some/file.cpp:12: assertion failed: a rope has two ends");
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
