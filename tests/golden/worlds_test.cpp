#include "tests/paths.h"
#include "tests/worlds.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <thread>

/// The same bits on every compiler, processor and thread. After a change that is meant to change the numbers, renew
/// worlds.txt with   SINEW_RENEW_GOLDEN=1 build/tests/sinew_tests --gtest_filter='SameBits.*'
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

const std::string table_path = test::source_dir() + "/tests/golden/worlds.txt";

/// The hash of a world of everything after a second.
template <int D, class Real> std::uint64_t future_of(Mode mode) {
    auto world = menagerie<D, Real>(mode);
    run(world, 1);
    return state_hash(world);
}

std::map<std::string, std::uint64_t> futures() {
    std::map<std::string, std::uint64_t> hashes;
    for (const auto& [mode, name] : {std::pair{Mode::physical, "physical"}, {Mode::classic, "classic"}}) {
        hashes[std::string("2D_float_") + name] = future_of<2, float>(mode);
        hashes[std::string("2D_double_") + name] = future_of<2, double>(mode);
        hashes[std::string("3D_float_") + name] = future_of<3, float>(mode);
        hashes[std::string("3D_double_") + name] = future_of<3, double>(mode);
    }
    return hashes;
}

TEST(SameBits, AsInTheTable) {
    const auto now = futures();
    if (std::getenv("SINEW_RENEW_GOLDEN")) {
        std::ofstream table(table_path);
        for (const auto& [name, hash] : now) table << name << ' ' << std::hex << hash << '\n';
    }
    std::map<std::string, std::uint64_t> recorded;
    std::ifstream table(table_path);
    std::string name;
    std::uint64_t hash = 0;
    while (table >> name >> std::hex >> hash) recorded[name] = hash;
    EXPECT_EQ(now, recorded);
}

TEST(SameBits, WhateverElseRunsBesideIt) {
    const auto alone = futures();
    for (int threads = 1; threads <= 8; ++threads) {
        std::vector<std::map<std::string, std::uint64_t>> found(static_cast<std::size_t>(threads));
        std::vector<std::thread> workers;
        for (auto& result : found) workers.emplace_back([&result] { result = futures(); });
        for (auto& worker : workers) worker.join();
        for (const auto& result : found) EXPECT_EQ(result, alone);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
