// SPDX-License-Identifier: Apache-2.0
#include "base/BlobStore.h"

#include "base/Hash.h"
#include "base/Log.h"
#include "tests/base/BlobStoreFuzzBody.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace filament_core {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }
std::string textOf(std::span<const std::byte> bytes) {
    return { reinterpret_cast<const char*>(bytes.data()), bytes.size() };
}

class BlobStoreTest : public testing::Test {
protected:
    void SetUp() override {
        mBefore = setLogSink([this](Severity, std::string_view line) { mLines.emplace_back(line); });
    }
    void TearDown() override {
        setLogSink(mBefore);
        fs::remove_all(mFolder);
    }

    BlobStore open(uint64_t identity = 7, uint64_t maxBytes = 1000) const { return { mFile, identity, maxBytes }; }
    void fill() const {
        BlobStore store = open();
        store.put(1, bytesOf("one"));
        store.put(2, bytesOf("two, which is longer"));
        store.save();
    }
    std::string file() const {
        std::ifstream in(mFile, std::ios::binary);
        return { std::istreambuf_iterator<char>(in), {} };
    }
    void write(std::string const& bytes) const { std::ofstream(mFile, std::ios::binary) << bytes; }

    const fs::path mFolder = fs::temp_directory_path() / ("blob_store_test_" + std::to_string(getpid()));
    const fs::path mFile = mFolder / "deeper" / "store";
    LogSink mBefore;
    std::vector<std::string> mLines;
};

TEST_F(BlobStoreTest, FindsInTheNextRunWhatWasPutInThisOne) {
    fill();
    BlobStore next = open();
    EXPECT_EQ(textOf(next.find(1)), "one");
    EXPECT_EQ(textOf(next.find(2)), "two, which is longer");
    EXPECT_THAT(next.find(3), IsEmpty());
    EXPECT_THAT(mLines, IsEmpty()) << "a file that is not there yet is no reason to warn";
}

TEST_F(BlobStoreTest, WritesNothingWhereNothingChanged) {
    fill();
    fs::remove(mFile);
    BlobStore empty = open();
    empty.save();
    EXPECT_FALSE(fs::exists(mFile));
    fill();
    const auto written = fs::last_write_time(mFile);
    BlobStore next = open();
    next.put(1, bytesOf("one"));
    next.save();
    EXPECT_EQ(fs::last_write_time(mFile), written);
}

TEST_F(BlobStoreTest, TakesNothingFromADamagedFileAndSaysSoOnce) {
    fill();
    const std::string good = file();
    for (size_t at = 0; at < good.size(); ++at) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ 0x10);
        write(bad);
        mLines.clear();
        EXPECT_EQ(open().size(), 0u) << at;
        EXPECT_THAT(mLines, ElementsAre(HasSubstr("is damaged or from another device"))) << at;
        write(good.substr(0, at));
        EXPECT_EQ(open().size(), 0u) << at;
    }
}

TEST_F(BlobStoreTest, SurvivesEntriesThatLieAboutTheirSizeUnderAValidChecksum) {
    fill();
    std::string lying = file();
    const uint64_t huge = ~uint64_t{ 0 };
    std::memcpy(lying.data() + 24 + 8, &huge, 8);
    const uint64_t checksum = hashBytes(bytesOf(std::string_view(lying).substr(24)));
    std::memcpy(lying.data() + 16, &checksum, 8);
    write(lying);
    EXPECT_EQ(open().size(), 0u);
    EXPECT_THAT(mLines, testing::SizeIs(1));
}

TEST_F(BlobStoreTest, TakesNothingThatBelongsToAnotherDevice) {
    fill();
    EXPECT_EQ(open(8).size(), 0u);
    EXPECT_THAT(mLines, ElementsAre(HasSubstr("store")));
}

TEST_F(BlobStoreTest, StaysWithinItsLimitByForgettingWhatWasNotAskedForFirst) {
    fill();
    BlobStore next = open(7, 24 + 2 * 16 + 20 + 20); // header, two entries, and as many bytes
    EXPECT_EQ(textOf(next.find(2)), "two, which is longer");
    next.put(3, bytesOf("three, just as long."));
    next.save();
    BlobStore last = open();
    EXPECT_THAT(last.find(1), IsEmpty());
    EXPECT_EQ(last.size(), 2u);
    EXPECT_LE(fs::file_size(mFile), 24u + 2 * 16 + 40);
}

TEST_F(BlobStoreTest, RemovesWhatKilledWritersLeftAndNothingElse) {
    using namespace std::chrono_literals;
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child); // its id names no process now
    fs::create_directories(mFile.parent_path());
    const auto put = [&](std::string const& name, std::chrono::seconds age) {
        const fs::path path = mFile.parent_path() / name;
        std::ofstream(path) << "half";
        fs::last_write_time(path, fs::file_time_type::clock::now() - age);
        return path;
    };
    const std::string gone = std::to_string(child), alive = std::to_string(getpid());
    const fs::path left = put("store." + gone, 2min), old = put("store." + alive, 2h);
    const fs::path other = put("other." + gone, 2min), fresh = put("store." + gone + "0", 1s),
                   backup = put("store.1b", 2h);
    fill();
    EXPECT_FALSE(fs::exists(left) || fs::exists(old));
    EXPECT_TRUE(fs::exists(other) && fs::exists(fresh) && fs::exists(backup) && fs::exists(mFile));
    EXPECT_THAT(mLines, IsEmpty());
}

// Anyone can compute the checksum: what the entries claim about themselves is checked, too.
TEST_F(BlobStoreTest, ReadsDamagedEntriesWithARightChecksumOrNone) {
    fs::create_directories(mFile.parent_path());
    std::vector<std::byte> good;
    for (uint64_t key = 1; key < 4; ++key) {
        const uint64_t entry[2] = { key, 5 * key };
        good.insert(good.end(), std::as_bytes(std::span(entry)).begin(), std::as_bytes(std::span(entry)).end());
        good.resize(good.size() + 5 * key, std::byte{ 7 });
    }
    EXPECT_TRUE(test::fuzzBlobStore(good, mFile));
    std::mt19937 random(2);
    size_t stores = 0;
    for (int round = 0; round < 500; ++round) {
        std::vector<std::byte> bad = good;
        for (auto i = 1 + random() % 3; i > 0; --i) bad[random() % bad.size()] = static_cast<std::byte>(random());
        if (random() % 4 == 0) bad.resize(random() % bad.size());
        stores += test::fuzzBlobStore(bad, mFile);
    }
    EXPECT_GT(stores, 50u);
    EXPECT_LT(stores, 450u);
}

TEST_F(BlobStoreTest, WarnsWhereItCannotWrite) {
    fs::create_directories(mFolder);
    std::ofstream(mFolder / "deeper") << "a file where a folder must be";
    BlobStore store = open();
    store.put(1, bytesOf("one"));
    store.save();
    EXPECT_THAT(mLines, ElementsAre(HasSubstr("cannot be written")));
}

} // namespace
} // namespace filament_core
