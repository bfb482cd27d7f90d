#include "bindings/c/native/sized.h"

#include <gtest/gtest.h>

/// Structs of callers that are older or younger than the library.
namespace sinew::c::SINEW_TEST_FILE {
namespace {

struct FirstVersion {
    std::uint32_t struct_size;
    std::uint32_t number;
};
struct SecondVersion {
    std::uint32_t struct_size;
    std::uint32_t number;
    double later;
};

TEST(Sized, AStructOfAnOlderVersionIsFilledUpWithDefaults) {
    const FirstVersion given{sizeof given, 7}, too_short{sizeof given - 1, 7};
    SecondVersion taken{0, 0, 99};
    EXPECT_STREQ(copy_sized(&given, sizeof(FirstVersion), taken), nullptr);
    EXPECT_EQ(taken.number, 7U);
    EXPECT_EQ(taken.later, 0);
    EXPECT_STREQ(copy_sized(&too_short, sizeof(FirstVersion), taken), "struct_size is not the size of the struct");
}

TEST(Sized, AFieldOfALaterVersionIsRefusedUnlessItIsZero) {
    SecondVersion given{sizeof given, 7, 0};
    FirstVersion taken{};
    EXPECT_STREQ(copy_sized(&given, sizeof taken, taken), nullptr);
    EXPECT_EQ(taken.number, 7U);
    given.later = 1;
    EXPECT_NE(copy_sized(&given, sizeof taken, taken), nullptr);
}

TEST(Sized, AStructOfAnOlderVersionIsFilledNoFurtherThanItGoes) {
    struct {
        SecondVersion filled;
        double beyond;
    } older{{sizeof(FirstVersion), 0, 5}, 6};
    fill_sized(SecondVersion{0, 7, 8}, &older.filled);
    EXPECT_EQ(older.filled.struct_size, sizeof(FirstVersion));
    EXPECT_EQ(older.filled.number, 7U);
    EXPECT_EQ(older.filled.later, 5);
    EXPECT_EQ(older.beyond, 6);
}

} // namespace
} // namespace sinew::c::SINEW_TEST_FILE
