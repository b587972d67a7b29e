// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Journal.h"

#include "base/Hash.h"
#include "filament_core/assets/files/FileBytes.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace filament_core::bake {
namespace {

static_assert(std::endian::native == std::endian::little, "journals are little-endian");

constexpr uint64_t kMagic = 0x314B4142'4C4946ull; // "FILBAK1"

struct FileHeader {
    uint64_t magic, bake, first, count;
};
struct Block {
    uint64_t count, hash;
};
static_assert(sizeof(TexelLight) == 72 && std::is_trivially_copyable_v<TexelLight>);

uint64_t hashOfLights(std::span<const TexelLight> lights, uint64_t at) {
    return hashBytes(std::as_bytes(lights), at + 1);
}

Error foreign(std::filesystem::path const& file, const char* what) {
    return fail(ErrorCode::Corrupt, "{}: {}; delete it, or give another --out", file.string(), what);
}

Result<JournalPart> parse(std::filesystem::path const& file, std::span<const std::byte> bytes) {
    FileHeader header{};
    if (bytes.size() >= sizeof(header)) std::memcpy(&header, bytes.data(), sizeof(header));
    if (header.magic != kMagic) return foreign(file, "is no part of a bake");
    JournalPart part{ { header.bake, { header.first, header.count } }, {}, sizeof(header) };
    while (bytes.size() - part.bytes >= sizeof(Block)) {
        Block block{};
        std::memcpy(&block, &bytes[part.bytes], sizeof(block));
        const uint64_t left = bytes.size() - part.bytes - sizeof(Block);
        if (block.count == 0 || block.count > left / sizeof(TexelLight)) break;
        if (block.count > header.count - part.lights.size()) break;
        std::vector<TexelLight> lights(block.count);
        std::memcpy(lights.data(), &bytes[part.bytes + sizeof(Block)], block.count * sizeof(TexelLight));
        if (hashOfLights(lights, part.lights.size()) != block.hash) break;
        part.lights.insert(part.lights.end(), lights.begin(), lights.end());
        part.bytes += sizeof(Block) + block.count * sizeof(TexelLight);
    }
    return part;
}

} // namespace

TexelRange rangeOfPart(uint64_t texels, uint32_t index, uint32_t count) {
    const uint64_t first = texels * index / count;
    return { first, texels * (index + 1) / count - first };
}

Result<JournalPart> readJournal(std::filesystem::path const& path) {
    std::error_code ignored;
    const std::filesystem::path file = std::filesystem::is_directory(path, ignored) ? path / kJournalName : path;
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    if (!bytes) return bytes.error();
    return parse(file, *bytes);
}

Result<Journal> Journal::open(std::filesystem::path const& file, JournalHeader const& header) {
    Journal journal;
    journal.mFile = file, journal.mHeader = header;
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) {
        Result<JournalPart> part = readJournal(file);
        if (!part) return part.error();
        if (part->header.bake != header.bake || part->header.range != header.range)
            return foreign(file, "belongs to a bake with other settings");
        journal.mLights = std::move(part->lights);
        std::error_code error;
        std::filesystem::resize_file(file, part->bytes, error);
        if (error) return fail(ErrorCode::Unreadable, "{}: cannot be continued: {}", file.string(), error.message());
        journal.mStream.open(file, std::ios::binary | std::ios::app);
    } else {
        journal.mStream.open(file, std::ios::binary);
        const FileHeader words{ kMagic, header.bake, header.range.first, header.range.count };
        journal.mStream.write(reinterpret_cast<const char*>(&words), sizeof(words));
        journal.mStream.flush();
    }
    if (!journal.mStream) return fail(ErrorCode::Unreadable, "{}: cannot be written", file.string());
    return journal;
}

Result<void> Journal::append(std::span<const TexelLight> lights) {
    const Block block{ lights.size(), hashOfLights(lights, mLights.size()) };
    mStream.write(reinterpret_cast<const char*>(&block), sizeof(block));
    mStream.write(reinterpret_cast<const char*>(lights.data()),
                  static_cast<std::streamsize>(lights.size() * sizeof(TexelLight)));
    mStream.flush();
    if (!mStream) return fail(ErrorCode::Unreadable, "{}: cannot be written; is the disk full?", mFile.string());
    mLights.insert(mLights.end(), lights.begin(), lights.end());
    return {};
}

Result<std::vector<TexelLight>> mergeJournals(std::span<const std::filesystem::path> files, uint64_t bake,
                                              uint64_t texels) {
    std::vector<JournalPart> parts;
    for (std::filesystem::path const& file : files) {
        Result<JournalPart> part = readJournal(file);
        if (!part) return part.error();
        if (part->header.bake != bake)
            return fail(ErrorCode::InvalidArgument,
                        "{}: was baked with another model or other options; give those of the parts", file.string());
        if (part->lights.size() != part->header.range.count)
            return fail(ErrorCode::InvalidArgument, "{}: is not finished; run its --shard again", file.string());
        parts.push_back(std::move(*part));
    }
    std::ranges::sort(parts, {}, [](JournalPart const& part) { return part.header.range.first; });
    std::vector<TexelLight> lights;
    for (JournalPart const& part : parts) {
        if (part.header.range.first != lights.size())
            return fail(ErrorCode::InvalidArgument, "parts {} between texels {} and {}",
                        part.header.range.first > lights.size() ? "are missing" : "overlap", lights.size(),
                        part.header.range.first);
        lights.insert(lights.end(), part.lights.begin(), part.lights.end());
    }
    if (lights.size() == texels) return lights;
    return fail(ErrorCode::InvalidArgument, "parts from texel {} on are missing", lights.size());
}

} // namespace filament_core::bake
