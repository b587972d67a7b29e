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

constexpr uint64_t kMagic = 0x324B4142'4C4946ull; // "FILBAK2"

struct FileHeader {
    uint64_t magic, bake, first, count, recordBytes;
};
struct Block {
    uint64_t count, hash;
};

/// `at`: the number of its first record.
uint64_t hashOfBlock(std::span<const std::byte> records, uint64_t at) { return hashBytes(records, at + 1); }

/// In the way of a journal.
Error foreign(std::filesystem::path const& file, const char* what) {
    return fail(ErrorCode::Corrupt, "{}: {}; move it away, or give another --out", file.string(), what);
}

constexpr const char* kNoPart = "is no part of a bake";

Result<JournalPart> parse(std::filesystem::path const& file, std::span<const std::byte> bytes) {
    FileHeader header{};
    if (bytes.size() >= sizeof(header)) std::memcpy(&header, bytes.data(), sizeof(header));
    if (header.magic != kMagic || header.recordBytes == 0)
        return fail(ErrorCode::Corrupt, "{}: {}; give files that --shard wrote", file.string(), kNoPart);
    JournalPart part{ { header.bake, { header.first, header.count }, header.recordBytes }, {}, sizeof(header) };
    while (bytes.size() - part.bytes >= sizeof(Block)) {
        Block block{};
        std::memcpy(&block, &bytes[part.bytes], sizeof(block));
        const uint64_t left = bytes.size() - part.bytes - sizeof(Block);
        if (block.count == 0 || block.count > left / header.recordBytes) break;
        if (block.count > header.count - part.count()) break;
        const auto records = bytes.subspan(part.bytes + sizeof(Block), block.count * header.recordBytes);
        if (hashOfBlock(records, part.count()) != block.hash) break;
        part.records.insert(part.records.end(), records.begin(), records.end());
        part.bytes += sizeof(Block) + records.size();
    }
    return part;
}

} // namespace

RecordRange rangeOfPart(uint64_t records, uint32_t index, uint32_t count) {
    const uint64_t first = records * index / count;
    return { first, records * (index + 1) / count - first };
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
        if (!part && part.error().code == ErrorCode::Corrupt) return foreign(file, kNoPart);
        if (!part) return part.error();
        if (part->header != header) return foreign(file, "belongs to a bake with other settings");
        journal.mRecords = std::move(part->records);
        std::error_code error;
        std::filesystem::resize_file(file, part->bytes, error);
        if (error) return fail(ErrorCode::Unreadable, "{}: cannot be continued: {}", file.string(), error.message());
    } else {
        // At once: a run that is killed now leaves no file without a header, which could not be continued.
        const FileHeader words{ kMagic, header.bake, header.range.first, header.range.count, header.recordBytes };
        if (auto done = assets::replaceFile(file, std::as_bytes(std::span(&words, 1))); !done) return done.error();
    }
    journal.mStream.open(file, std::ios::binary | std::ios::app);
    if (!journal.mStream) return fail(ErrorCode::Unreadable, "{}: cannot be written", file.string());
    return journal;
}

Result<void> Journal::append(std::span<const std::byte> records) {
    const Block block{ records.size() / mHeader.recordBytes, hashOfBlock(records, count()) };
    mStream.write(reinterpret_cast<const char*>(&block), sizeof(block));
    mStream.write(reinterpret_cast<const char*>(records.data()), static_cast<std::streamsize>(records.size()));
    mStream.flush();
    if (!mStream) return fail(ErrorCode::Unreadable, "{}: cannot be written; is the disk full?", mFile.string());
    mRecords.insert(mRecords.end(), records.begin(), records.end());
    return {};
}

Result<std::vector<std::byte>> mergeJournals(std::span<const std::filesystem::path> files, JournalHeader const& whole) {
    std::vector<JournalPart> parts;
    for (std::filesystem::path const& file : files) {
        Result<JournalPart> part = readJournal(file);
        if (!part) return part.error();
        if (part->header.bake != whole.bake || part->header.recordBytes != whole.recordBytes)
            return fail(ErrorCode::InvalidArgument,
                        "{}: was baked with another model or other options; give those of the parts", file.string());
        if (part->count() != part->header.range.count)
            return fail(ErrorCode::InvalidArgument, "{}: is not finished; run its --shard again", file.string());
        parts.push_back(std::move(*part));
    }
    std::ranges::sort(parts, {}, [](JournalPart const& part) { return part.header.range.first; });
    std::vector<std::byte> records;
    for (JournalPart const& part : parts) {
        const uint64_t count = records.size() / whole.recordBytes;
        if (part.header.range.first != count)
            return fail(ErrorCode::InvalidArgument, "parts {} between points {} and {}",
                        part.header.range.first > count ? "are missing" : "overlap", count, part.header.range.first);
        records.insert(records.end(), part.records.begin(), part.records.end());
    }
    const uint64_t count = records.size() / whole.recordBytes;
    if (count == whole.range.count) return records;
    return fail(ErrorCode::InvalidArgument, "parts from point {} on are missing", count);
}

} // namespace filament_core::bake
