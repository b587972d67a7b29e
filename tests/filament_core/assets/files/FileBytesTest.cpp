// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/files/FileBytes.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"

#include <chrono>
#include <csignal>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

namespace filament_core::assets {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::vector<std::byte> bytesOf(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return { bytes.begin(), bytes.end() };
}

std::string textOf(fs::path const& path) {
    const auto bytes = readFileBytes(path);
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : bytes.error().message;
}

size_t entries(fs::path const& folder) {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// While it lives, files stop growing at `bytes`, as on a full disk.
class FullDisk {
public:
    explicit FullDisk(size_t bytes) : mHandler(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &mBefore);
        const rlimit limit{ bytes, mBefore.rlim_max };
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &mBefore);
        std::signal(SIGXFSZ, mHandler);
    }
    FullDisk(FullDisk const&) = delete;

private:
    rlimit mBefore{};
    void (*mHandler)(int);
};

TEST(ReplaceFile, AFullDiskLeavesTheOldFileAndNothingElse) {
    const TemporaryFolder folder;
    ASSERT_TRUE(replaceFile(folder / "file", bytesOf("the old one")));
    const std::vector<std::byte> next(300, std::byte{ 'n' });
    for (size_t room = 0; room < next.size(); ++room) {
        const auto written = [&] {
            const FullDisk disk(room);
            return replaceFile(folder / "file", next);
        }();
        ASSERT_FALSE(written) << room;
        EXPECT_NE(written.error().message.find("File too large"), std::string::npos) << written.error().message;
        EXPECT_EQ(textOf(folder / "file"), "the old one");
    }
    EXPECT_EQ(entries(folder.path()), 1u);
    const FullDisk disk(next.size());
    EXPECT_TRUE(replaceFile(folder / "file", next));
}

TEST(ReplaceFile, ALinkStaysAndWhatItNamesIsReplaced) {
    const TemporaryFolder folder;
    ASSERT_TRUE(replaceFile(folder / "store" / "file", bytesOf("old")));
    fs::create_symlink("store/file", folder / "first");
    fs::create_symlink("first", folder / "second");
    ASSERT_TRUE(replaceFile(folder / "second", bytesOf("new")));
    EXPECT_TRUE(fs::is_symlink(folder / "second"));
    EXPECT_TRUE(fs::is_symlink(folder / "first"));
    EXPECT_EQ(textOf(folder / "store" / "file"), "new");
    EXPECT_EQ(entries(folder / "store"), 1u);
}

TEST(ReplaceFile, ALinkToNothingGetsItsFile) {
    const TemporaryFolder folder;
    fs::create_symlink("made/later", folder / "link");
    ASSERT_TRUE(replaceFile(folder / "link", bytesOf("text")));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(textOf(folder / "made" / "later"), "text");
}

TEST(ReplaceFile, LinksInACircleAndFoldersAreErrors) {
    const TemporaryFolder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    EXPECT_EQ(replaceFile(folder / "a", {}).error().code, ErrorCode::Unreadable);
    const auto written = replaceFile(folder.path(), bytesOf("text"));
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message.find("it is a directory"), std::string::npos) << written.error().message;
}

// As root, renaming over /dev/null would replace it for the whole system.
TEST(ReplaceFile, WhatIsNoRegularFileIsWrittenInto) {
    const TemporaryFolder folder;
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    ASSERT_TRUE(replaceFile(pipe, bytesOf("through")));
    char text[16] = {};
    EXPECT_EQ(::read(reader, text, sizeof text), 7);
    EXPECT_STREQ(text, "through");
    ::close(reader);
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(entries(folder.path()), 1u);

    fs::create_symlink("/dev/full", folder / "full");
    const auto full = replaceFile(folder / "full", bytesOf("x"));
    ASSERT_FALSE(full);
    EXPECT_NE(full.error().message.find("No space left"), std::string::npos) << full.error().message;
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(ReplaceFile, WritesToAnOpenDescriptorThroughProc) {
    const TemporaryFolder folder;
    const fs::path file = folder / "gone";
    const int open = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    ASSERT_GE(open, 0);
    fs::remove(file); // as a pipe, it has no name
    ASSERT_TRUE(replaceFile(fmt::format("/proc/self/fd/{}", open), bytesOf("abc")));
    char text[4] = {};
    EXPECT_EQ(::pread(open, text, 3, 0), 3);
    EXPECT_STREQ(text, "abc");
    ::close(open);
    EXPECT_EQ(entries(folder.path()), 0u);
}

TEST(ReplaceFile, KeepsThePermissionsOfTheFile) {
    const TemporaryFolder folder;
    ASSERT_TRUE(replaceFile(folder / "secret", bytesOf("a")));
    fs::permissions(folder / "secret", fs::perms::owner_read | fs::perms::owner_write);
    ASSERT_TRUE(replaceFile(folder / "secret", bytesOf("b")));
    EXPECT_EQ(fs::status(folder / "secret").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(Leftovers, OfKilledWritersAreRemovedAndThoseOfLiveOnesAreKept) {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child); // its id names no process now
    const auto put = [&](std::string const& name, std::chrono::seconds age) {
        ASSERT_TRUE(replaceFile(folder / name, bytesOf("half")));
        fs::last_write_time(folder / name, fs::file_time_type::clock::now() - age);
    };
    put(fmt::format("a.env.{}-0", child), 2min);
    put(fmt::format("b.env.{}-12", ::getpid()), 2h);
    put(fmt::format("fresh.env.{}-0", child), 1s);
    put(fmt::format("alive.env.{}-0", ::getpid()), 2min);
    put("0123456789abcdef.env", 24h);
    put("notes-2.txt", 24h);
    EXPECT_EQ(removeLeftovers(folder.path()), 2u);
    EXPECT_EQ(entries(folder.path()), 4u);
    EXPECT_EQ(removeLeftovers(folder / "missing"), 0u);
}

} // namespace
} // namespace filament_core::assets
