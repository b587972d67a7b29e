// SPDX-License-Identifier: Apache-2.0
/// Journal: the texels that a bake has finished, in a file that grows, so that a run that was killed continues, and
/// that several machines can each do a part.
///   Format  a header with a hash of all that the texels depend on, then blocks of consecutive texels in binary, each
///           with a hash of its own. Little-endian.
///   Resume  a journal with the same header is continued; what follows its last whole block was being written when its
///           process ended, and is cut off. A file that is no such journal is not touched.
///   Thread  one.
///   Fails   Unreadable with the path; Corrupt for a file that belongs to another bake, or is none.
#pragma once

#include "base/Result.h"
#include "tools/bake/BakeLight.h"

#include <filesystem>
#include <fstream>
#include <vector>

namespace filament_core::bake {

inline constexpr const char* kJournalName = "bake.part"; ///< in the folder of a bake

/// Texels [first, first + count) of all.
struct TexelRange {
    uint64_t first = 0, count = 0;
    friend bool operator==(TexelRange const&, TexelRange const&) = default;
};

/// Part `index` of `count`: consecutive, and as equal as can be.
TexelRange rangeOfPart(uint64_t texels, uint32_t index, uint32_t count);

struct JournalHeader {
    uint64_t bake = 0; ///< hash of model, atlas, scene and settings
    TexelRange range{};
};

class Journal {
public:
    /// Continues or begins `file`.
    static Result<Journal> open(std::filesystem::path const& file, JournalHeader const& header);

    std::vector<TexelLight> const& lights() const { return mLights; } ///< the first of the range
    bool isComplete() const { return mLights.size() == mHeader.range.count; }
    /// The next ones; they are on their way to the disk when this returns.
    Result<void> append(std::span<const TexelLight> lights);

private:
    std::filesystem::path mFile;
    JournalHeader mHeader;
    std::vector<TexelLight> mLights;
    std::ofstream mStream;
};

struct JournalPart {
    JournalHeader header;
    std::vector<TexelLight> lights; ///< the whole blocks of the file
    uint64_t bytes = 0;             ///< of the file, up to their end
};
/// `path`: a journal, or the folder of one.
Result<JournalPart> readJournal(std::filesystem::path const& path);

/// All texels of a bake from the journals of its parts. Fails: InvalidArgument, naming the file or the texels that are
/// missing.
Result<std::vector<TexelLight>> mergeJournals(std::span<const std::filesystem::path> files, uint64_t bake,
                                              uint64_t texels);

} // namespace filament_core::bake
