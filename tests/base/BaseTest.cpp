// SPDX-License-Identifier: Apache-2.0
#include "base/Arena.h"
#include "base/Fifo.h"
#include "base/Handle.h"
#include "base/Hash.h"
#include "base/Log.h"
#include "base/OutOfMemory.h"
#include "base/Result.h"
#include "base/Suggest.h"

#include <filament_core/Version.h>

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <thread>

namespace filament_core {
namespace {

TEST(Arena, KeepsItsBlocksSoThatASecondFrameReservesNothing) {
    Arena arena(1024);
    for (int i = 0; i < 100; ++i) arena.array<uint64_t>(17);
    const size_t reserved = arena.bytesReserved();
    arena.reset();
    EXPECT_EQ(arena.bytesUsed(), 0u);
    for (int i = 0; i < 100; ++i) arena.array<uint64_t>(17);
    EXPECT_EQ(arena.bytesReserved(), reserved);
}

TEST(Arena, AlignsAndValueInitialises) {
    Arena arena(256);
    arena.allocate(1, 1);
    struct alignas(64) Line {
        float values[16];
    };
    for (int round = 0; round < 5; ++round) {
        const std::span<Line> lines = arena.array<Line>(3);
        EXPECT_EQ(reinterpret_cast<uintptr_t>(lines.data()) % 64, 0u);
        for (Line const& line : lines) {
            for (float value : line.values) EXPECT_EQ(value, 0.0f);
        }
    }
}

TEST(Arena, ServesARequestLargerThanItsBlocks) {
    Arena arena(64);
    const std::span<std::byte> large = arena.array<std::byte>(100'000);
    large.back() = std::byte{ 1 };
    EXPECT_EQ(large.size(), 100'000u);
}

TEST(Arena, FillsOneBlockFromTheSecondFrameOnWhateverTheOrderOfTheRequests) {
    Arena arena(64);
    for (size_t count : { 1000, 10, 5000, 300 }) arena.arrayForOverwrite<uint64_t>(count);
    arena.reset();
    const size_t reserved = arena.bytesReserved();
    const std::byte* first = arena.arrayForOverwrite<std::byte>(1).data();
    for (size_t count : { 5000, 300, 10, 1000 }) {
        const std::span<uint64_t> array = arena.arrayForOverwrite<uint64_t>(count);
        EXPECT_LT(static_cast<size_t>(reinterpret_cast<std::byte*>(array.data()) - first), reserved);
    }
    EXPECT_EQ(arena.bytesReserved(), reserved);
}

TEST(Arena, AFrameThatGrowsALittleEveryTimeSeldomReservesMore) {
    Arena arena(1024);
    size_t reserved = 0, changes = 0;
    for (size_t frame = 0; frame < 1000; ++frame) {
        for (int array = 0; array < 5; ++array) arena.arrayForOverwrite<uint64_t>(1000 + frame);
        arena.reset();
        changes += arena.bytesReserved() != reserved;
        reserved = arena.bytesReserved();
    }
    EXPECT_LT(changes, 30u);
    EXPECT_LT(reserved, 4 * 5 * 2000 * sizeof(uint64_t));
}

TEST(HandleAllocator, TellsAStaleHandleFromTheNextOwnerOfItsIndex) {
    HandleAllocator<struct TestTag> handles;
    const auto first = handles.allocate();
    handles.free(first);
    const auto second = handles.allocate();
    EXPECT_EQ(first.index(), second.index());
    EXPECT_NE(first, second);
    EXPECT_FALSE(handles.isLive(first));
    EXPECT_TRUE(handles.isLive(second));
    EXPECT_EQ(handles.liveCount(), 1u);
}

TEST(HandleAllocator, NeverGivesOutZeroEvenWhenGenerationsWrap) {
    HandleAllocator<struct TestTag> handles;
    for (uint32_t i = 0; i < 2 * Handle<struct TestTag>::kMaxGeneration; ++i) {
        const auto handle = handles.allocate();
        ASSERT_TRUE(handle);
        handles.free(handle);
    }
}

// Files decide how many objects there are: one too many is an error of the load.
TEST(HandleAllocator, RefusesTheHandleAfterTheLastAndGoesOnOnceOneIsFree) {
    HandleAllocator<struct TestTag> handles;
    constexpr uint32_t kMost = Handle<struct TestTag>::kIndexMask + 1;
    for (uint32_t i = 0; i + 1 < kMost; ++i) handles.allocate();
    const auto last = handles.allocate();
    EXPECT_THROW(handles.allocate(), OutOfHandles);
    const Result<int> made = orOutOfMemory("glTF", "a.glb", [&]() -> Result<int> {
        handles.allocate();
        return 1;
    });
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::OutOfMemory);
    EXPECT_EQ(made.error().message,
              "glTF 'a.glb': there are 2^20 objects of one type, as many as can be; destroy some");
    EXPECT_EQ(handles.liveCount(), kMost);
    handles.free(last);
    EXPECT_EQ(handles.allocate().index(), last.index());
}

TEST(HandleAllocatorDeathTest, RefusesToFreeTwice) {
    HandleAllocator<struct TestTag> handles;
    const auto handle = handles.allocate();
    handles.free(handle);
    EXPECT_DEATH(handles.free(handle), "freed once");
}

TEST(HandleAllocator, GivesDistinctHandlesToConcurrentCallers) {
    HandleAllocator<struct TestTag> handles;
    std::array<std::vector<uint32_t>, 4> given;
    {
        std::array<std::jthread, 4> threads;
        for (size_t t = 0; t < threads.size(); ++t) {
            threads[t] = std::jthread([&, t] {
                for (int i = 0; i < 1000; ++i) given[t].push_back(handles.allocate().bits);
            });
        }
    }
    std::set<uint32_t> all;
    for (auto const& one : given) all.insert(one.begin(), one.end());
    EXPECT_EQ(all.size(), 4000u);
}

TEST(Fifo, GivesThingsBackInOrderWhileItGrowsAndWrapsAround) {
    Fifo<int> queue;
    int pushed = 0, popped = 0;
    for (int round = 0; round < 50; ++round) {
        for (int i = 0; i < 1 + round % 7; ++i) queue.push_back(pushed++);
        for (int i = 0; i < 1 + round % 5 && !queue.empty(); ++i) {
            ASSERT_EQ(queue.front(), popped++);
            queue.pop_front();
        }
        if (!queue.empty()) {
            ASSERT_EQ(queue.back(), pushed - 1);
        }
    }
    EXPECT_EQ(queue.size(), static_cast<size_t>(pushed - popped));
}

TEST(Fifo, LetsGoOfWhatWasPopped) {
    Fifo<std::shared_ptr<int>> queue;
    const auto kept = std::make_shared<int>(1);
    queue.push_back(kept);
    queue.pop_front();
    EXPECT_EQ(kept.use_count(), 1);
}

TEST(Hash, DependsOnEveryByteAndOnTheLength) {
    std::array<std::byte, 67> bytes{};
    std::set<uint64_t> hashes;
    for (size_t length = 0; length <= bytes.size(); ++length) hashes.insert(hashBytes(std::span(bytes).first(length)));
    for (std::byte& byte : bytes) {
        byte = std::byte{ 1 };
        hashes.insert(hashBytes(bytes));
        byte = std::byte{ 0 };
    }
    EXPECT_EQ(hashes.size(), bytes.size() + 1 + bytes.size());
}

TEST(Hash, IsTheSameOnEveryRun) {
    // Stored caches and determinism checks rely on these values.
    EXPECT_EQ(hashString("filament"), hashString(std::string("fila") + "ment"));
    EXPECT_NE(hashString("filament", 1), hashString("filament", 2));
    EXPECT_NE(hashCombine(1, 2), hashCombine(2, 1));
}

TEST(Suggest, FindsTheNearestNameAndStaysSilentWhenNothingIsNear) {
    const std::array<std::string_view, 3> known{ "roughness", "metallic", "baseColor" };
    EXPECT_EQ(suggestion("roughnes", known), "; did you mean 'roughness'?");
    EXPECT_EQ(suggestion("basecolour", known), "; did you mean 'baseColor'?");
    EXPECT_EQ(suggestion("transmission", known), "");
    EXPECT_EQ(suggestion("x", {}), "");
}

TEST(Result, CarriesAValueOrTheReasonThatThereIsNone) {
    const Result<int> good = 3;
    const Result<int> bad = fail(ErrorCode::NotFound, "no file '{}'", "a.gltf");
    EXPECT_TRUE(good.ok());
    EXPECT_EQ(*good, 3);
    EXPECT_FALSE(bad);
    EXPECT_EQ(bad.error().message, "no file 'a.gltf'");
    EXPECT_STREQ(toString(bad.error().code), "not found");
}

TEST(Log, GivesWholeLinesToTheSinkAndDropsWhatIsBelowTheThreshold) {
    std::vector<std::string> lines;
    const LogSink before = setLogSink([&](Severity, std::string_view line) { lines.emplace_back(line); });
    log(Severity::Debug, "hidden {}", 1);
    log(Severity::Warning, "seen {}", 2);
    setLogSink(before);
    EXPECT_EQ(lines, std::vector<std::string>{ "seen 2" });
}

TEST(Version, OfTheLibraryIsThatOfItsHeadersAsNumbersAndAsText) {
    EXPECT_EQ(version(), kHeaderVersion);
    std::string dotted = std::to_string(FILAMENT_CORE_VERSION_MAJOR);
    dotted += '.' + std::to_string(FILAMENT_CORE_VERSION_MINOR) + '.' + std::to_string(FILAMENT_CORE_VERSION_PATCH);
    EXPECT_EQ(versionText(), dotted);
}

TEST(Version, NumbersComparePartByPart) {
    static_assert(FILAMENT_CORE_MAKE_VERSION(0, 2, 0) > FILAMENT_CORE_MAKE_VERSION(0, 1, 999));
    static_assert(FILAMENT_CORE_MAKE_VERSION(1, 0, 0) > FILAMENT_CORE_MAKE_VERSION(0, 999, 999));
    static_assert(FILAMENT_CORE_VERSION >= FILAMENT_CORE_MAKE_VERSION(0, 1, 0));
    EXPECT_LT((Version{ 0, 1, 999 }), (Version{ 0, 2, 0 }));
    EXPECT_LT((Version{ 0, 999, 999 }), (Version{ 1, 0, 0 }));
}

} // namespace
} // namespace filament_core
