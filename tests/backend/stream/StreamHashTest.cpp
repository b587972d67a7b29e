// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/StreamHash.h"

#include "backend/stream/CommandBuffer.h"
#include "backend/stream/CommandFields.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <set>
#include <string>
#include <vector>

namespace filament_core::backend {
namespace {

template <class... C>
uint64_t hashOf(C const&... command) {
    CommandBuffer commands;
    (commands.record(command), ...);
    return hashStream(commands.view());
}

/// Changes a leaf to another value, whatever its type.
template <class T>
void change(T& value) {
    static constexpr std::array<std::byte, 3> kBytes{ std::byte{ 1 }, std::byte{ 2 }, std::byte{ 3 } };
    if constexpr (std::same_as<T, bool>) {
        value = !value;
    } else if constexpr (std::same_as<T, std::string_view>) {
        value = "changed";
    } else if constexpr (std::same_as<T, std::span<const std::byte>>) {
        value = kBytes;
    } else if constexpr (kIsSpan<T>) {
        static constexpr std::array<std::remove_const_t<typename T::element_type>, 2> kElements{};
        value = kElements;
    } else if constexpr (kIsHandle<T>) {
        value = T::make(5, 3);
    } else if constexpr (std::is_enum_v<T>) {
        value = static_cast<T>(static_cast<uint8_t>(value) + 1);
    } else {
        value += 1;
    }
}

/// Calls changed(path) once for each leaf field of `command`, with only that field changed.
template <class Command, class S, class Changed>
void changeEachField(Command& command, S& part, std::string const& path, Changed const& changed) {
    visitFields(part, [&](const char* name, auto& field) {
        using T = std::remove_reference_t<decltype(field)>;
        const std::string at = path + "." + name;
        if constexpr (std::same_as<T, Ticket>) {
            // counts by its position in the stream: see the tests of tickets
        } else if constexpr (kIsArray<T>) {
            auto& element = field[field.size() - 1];
            using E = std::remove_reference_t<decltype(element)>;
            if constexpr (HasFields<E>) {
                changeEachField(command, element, at + "[last]", changed);
            } else {
                const E before = element;
                change(element);
                changed(at + "[last]");
                element = before;
            }
        } else if constexpr (HasFields<T>) {
            changeEachField(command, field, at, changed);
        } else {
            const T before = field;
            change(field);
            changed(at);
            field = before;
        }
    });
}

template <class... C>
void forEachCommand(TypeList<C...>, auto&& visit) {
    (visit(C{}), ...);
}

TEST(StreamHash, EveryFieldOfEveryCommandCounts) {
    std::set<uint64_t> hashes;
    size_t fields = 0;
    forEachCommand(Commands{}, [&](auto command) {
        EXPECT_TRUE(hashes.insert(hashOf(command)).second) << kFields<decltype(command)>.name << " alone";
        changeEachField(command, command, kFields<decltype(command)>.name, [&](std::string const& path) {
            ++fields;
            EXPECT_TRUE(hashes.insert(hashOf(command)).second) << path << " does not count";
        });
    });
    EXPECT_GT(fields, 150u);
}

TEST(StreamHash, OneBitOfAPayloadCounts) {
    std::vector<std::byte> bytes(100'000);
    const uint64_t before = hashOf(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = bytes });
    EXPECT_EQ(hashOf(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = bytes }), before);
    bytes[70'001] ^= std::byte{ 16 };
    EXPECT_NE(hashOf(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = bytes }), before);
}

TEST(StreamHash, OrderCounts) {
    const CmdDraw a{ .vertexCount = 1 }, b{ .vertexCount = 2 };
    EXPECT_NE(hashOf(a, b), hashOf(b, a));
    EXPECT_NE(hashOf(CmdPushGroup{ "ab" }, CmdPushGroup{ "c" }), hashOf(CmdPushGroup{ "a" }, CmdPushGroup{ "bc" }));
}

// Commands created in memory with other previous contents, so the padding between fields differs.
TEST(StreamHash, PaddingDoesNotCount) {
    const auto hashOver = [](unsigned char rubbish) {
        alignas(CmdBindGroup) std::array<unsigned char, sizeof(CmdBindGroup)> memory;
        memory.fill(rubbish);
        auto* command = new (memory.data()) CmdBindGroup;
        command->group = BindGroupHandle::make(1, 1);
        command->index = 1;
        command->dynamicCount = 0;
        command->dynamicOffsets = {};
        CommandBuffer commands;
        std::memset(commands.allocate(64 * 1024 - 256).data(), rubbish, 64 * 1024 - 256);
        commands.record(*command);
        return hashStream(commands.view());
    };
    EXPECT_EQ(hashOver(0x00), hashOver(0xFF));
}

TEST(StreamHash, ChunksAndAddressesDoNotCount) {
    CommandBuffer whole, head, tail;
    const std::string name = "a name";
    const std::vector<std::byte> bytes(100, std::byte{ 7 });
    for (uint32_t i = 0; i < 5000; ++i) {
        for (CommandBuffer* commands : { &whole, i < 2500 ? &head : &tail }) {
            commands->record(CmdDraw{ .vertexCount = i });
            commands->record(CmdPushGroup{ std::string(name) });
            commands->record(CmdUpdateBuffer{ .buffer = {}, .offset = i, .bytes = bytes });
        }
    }
    head.append(std::move(tail));
    ASSERT_NE(head.view().size(), whole.view().size()) << "other chunks, or this proves nothing";
    EXPECT_EQ(hashStream(head.view()), hashStream(whole.view()));
}

// Rendering the same frame twice in one process uses different tickets.
TEST(StreamHash, TicketsCountByTheirPlaceInTheStream) {
    const auto frame = [](uint64_t first, uint64_t second, uint64_t third) {
        return hashOf(CmdBeginTimer{ Ticket{ first } }, CmdBeginTimer{ Ticket{ second } },
                      CmdEndTimer{ Ticket{ third } });
    };
    EXPECT_EQ(frame(1, 2, 2), frame(77, 1003, 1003));
    EXPECT_NE(frame(1, 2, 2), frame(1, 2, 1)) << "another timer ends";
    EXPECT_NE(frame(1, 2, 2), frame(1, 2, 3));
}

} // namespace
} // namespace filament_core::backend
