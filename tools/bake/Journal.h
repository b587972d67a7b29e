// SPDX-License-Identifier: Apache-2.0
/// Journal: what a bake has finished, in a file that grows, so that a run that was killed continues, and that several
/// machines can each do a part. Records of one size: texels of a lightmap, or probes of a grid.
///   Format  a header with a hash of all that the records depend on, then blocks of consecutive records in binary, each
///           with a hash of its own. Little-endian.
///   Resume  a journal with the same header is continued; what follows its last whole block was being written when its
///           process ended, and is cut off. A file that is no such journal is not touched.
///   Thread  one.
///   Fails   Unreadable with the path; Corrupt for a file that belongs to another bake, or is none.
#pragma once

#include "base/Result.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <type_traits>
#include <vector>

namespace filament_core::bake {

inline constexpr const char* kJournalName = "bake.part"; ///< in the folder of a bake

/// Records [first, first + count) of all.
struct RecordRange {
    uint64_t first = 0, count = 0;
    friend bool operator==(RecordRange const&, RecordRange const&) = default;
};

/// Part `index` of `count`: consecutive, and as equal as can be.
RecordRange rangeOfPart(uint64_t records, uint32_t index, uint32_t count);

/// Values that were stored one after the other.
template <class T>
std::vector<T> valuesOf(std::span<const std::byte> records) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(records.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), records.data(), values.size() * sizeof(T));
    return values;
}

struct JournalHeader {
    uint64_t bake = 0; ///< hash of model, scene and settings
    RecordRange range{};
    uint64_t recordBytes = 1;
    friend bool operator==(JournalHeader const&, JournalHeader const&) = default;
};

class Journal {
public:
    /// Continues or begins `file`.
    static Result<Journal> open(std::filesystem::path const& file, JournalHeader const& header);

    std::span<const std::byte> records() const { return mRecords; } ///< the first of the range
    uint64_t count() const { return mRecords.size() / mHeader.recordBytes; }
    bool isComplete() const { return count() == mHeader.range.count; }
    /// The next ones; they are on their way to the disk when this returns.
    Result<void> append(std::span<const std::byte> records);

private:
    std::filesystem::path mFile;
    JournalHeader mHeader;
    std::vector<std::byte> mRecords;
    std::ofstream mStream;
};

struct JournalPart {
    JournalHeader header;
    std::vector<std::byte> records; ///< the whole blocks of the file
    uint64_t bytes = 0;             ///< of the file, up to their end
    uint64_t count() const { return records.size() / header.recordBytes; }
};
/// `path`: a journal, or the folder of one.
Result<JournalPart> readJournal(std::filesystem::path const& path);

/// All records of a bake, as the header says, from the journals of its parts. Fails: InvalidArgument, naming the file
/// or the records that are missing.
Result<std::vector<std::byte>> mergeJournals(std::span<const std::filesystem::path> files, JournalHeader const& whole);

} // namespace filament_core::bake
