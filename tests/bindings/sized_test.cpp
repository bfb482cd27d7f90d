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

struct Wide {
    std::uint32_t struct_size;
    double number[2];
};
struct Narrow {
    std::uint32_t struct_size, number;
    double later;
};

/// Bytes of the library's stack are none of the caller's business.
TEST(Sized, BytesBeforeTheSecondFieldAreCleared) {
    EXPECT_EQ(place_of_second<Wide>, offsetof(Wide, number));
    EXPECT_EQ(place_of_second<Narrow>, offsetof(Narrow, number));
    EXPECT_EQ(place_of_second<sinew_diagnostic>, offsetof(sinew_diagnostic, source));
    EXPECT_EQ(place_of_second<sinew_particle_state>, offsetof(sinew_particle_state, position));
    EXPECT_EQ(place_of_second<sinew_ray_hit>, offsetof(sinew_ray_hit, share));
    EXPECT_EQ(place_of_second<sinew_figure>, offsetof(sinew_figure, name));
    EXPECT_EQ(place_of_second<sinew_force_spec>, offsetof(sinew_force_spec, kind));
    Wide made{}, out{};
    std::memset(&made, 7, sizeof made);
    std::memset(&out, 9, sizeof out);
    out.struct_size = sizeof out;
    fill_sized(made, &out);
    const auto* bytes = reinterpret_cast<const unsigned char*>(&out);
    for (auto at = sizeof out.struct_size; at < offsetof(Wide, number); ++at) EXPECT_EQ(bytes[at], 0);
    EXPECT_EQ(bytes[offsetof(Wide, number)], 7);
}

} // namespace
} // namespace sinew::c::SINEW_TEST_FILE
