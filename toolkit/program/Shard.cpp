// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/Shard.h"

#include "toolkit/program/CommandLine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <tuple>

namespace filament_core::tools {
namespace {

constexpr size_t kNamedShards = 10; ///< of those that are missing

std::string environmentValue(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// Slurm counts from SLURM_ARRAY_TASK_MIN, Kubernetes from 0.
std::optional<std::pair<std::string, std::string>> shardOfScheduler() {
    std::string index = environmentValue("SLURM_ARRAY_TASK_ID"), count = environmentValue("SLURM_ARRAY_TASK_COUNT");
    if (!index.empty() && !count.empty()) {
        const auto id = wholeNumber(index, 0, UINT32_MAX);
        const auto first = wholeNumber(environmentValue("SLURM_ARRAY_TASK_MIN"), 0, UINT32_MAX);
        if (id && first && *id >= *first) index = std::to_string(*id - *first);
        return std::pair(index, count);
    }
    index = environmentValue("JOB_COMPLETION_INDEX"), count = environmentValue("JOB_COMPLETIONS");
    if (!index.empty() && !count.empty()) return std::pair(index, count);
    return std::nullopt;
}

/// "2/8, 5/8 and 7 more"
std::string namesOf(std::vector<uint32_t> const& missing, uint32_t count) {
    std::string names;
    for (size_t i = 0; i < std::min(missing.size(), kNamedShards); ++i)
        names += fmt::format("{}{}/{}", i == 0 ? "" : ", ", missing[i], count);
    return missing.size() > kNamedShards ? fmt::format("{} and {} more", names, missing.size() - kNamedShards) : names;
}

} // namespace

Result<Shard> parseShard(std::string const& word) {
    const char* const cure = "I/N with 0 <= I < N, or auto in a Slurm array or an indexed Kubernetes job";
    std::string index, count;
    if (word == "auto") {
        const auto scheduled = shardOfScheduler();
        if (!scheduled) return invalidOption("--shard", word, cure);
        std::tie(index, count) = *scheduled;
    } else {
        const size_t slash = word.find('/');
        if (slash == std::string::npos) return invalidOption("--shard", word, cure);
        index = word.substr(0, slash), count = word.substr(slash + 1);
    }
    const auto n = wholeNumber(count, 1, kMaxShards);
    const auto i = n ? wholeNumber(index, 0, *n - 1) : std::nullopt;
    if (!i) return invalidOption("--shard", index + "/" + count, cure);
    return Shard{ *i, *n };
}

Result<void> checkComplete(std::vector<Shard> shards) {
    std::sort(shards.begin(), shards.end(), [](Shard a, Shard b) { return a.index < b.index; });
    std::vector<uint32_t> missing;
    uint32_t next = 0;
    for (Shard const& shard : shards) {
        if (shard.count > kMaxShards || shard.index >= shard.count)
            return fail(ErrorCode::InvalidArgument, "there is no shard {}/{}; run it again", shard.index, shard.count);
        if (shard.count != shards.front().count)
            return fail(ErrorCode::InvalidArgument, "shard {}/{} and shard {}/{} are of two divisions; merge one",
                        shards.front().index, shards.front().count, shard.index, shard.count);
        if (shard.index < next)
            return fail(ErrorCode::InvalidArgument, "shard {}/{} is there twice; merge each shard once", shard.index,
                        shard.count);
        for (; next < shard.index; ++next) missing.push_back(next);
        ++next;
    }
    for (; !shards.empty() && next < shards.front().count; ++next) missing.push_back(next);
    if (missing.empty()) return {};
    return fail(ErrorCode::InvalidArgument, "missing: shard {}; run --shard {}/{} and merge again",
                namesOf(missing, shards.front().count), missing.front(), shards.front().count);
}

} // namespace filament_core::tools
