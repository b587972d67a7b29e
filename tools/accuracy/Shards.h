// SPDX-License-Identifier: Apache-2.0
/// Shards: rows of the accuracy table divided among machines, and their data merged again.
///   File    OUT/results.json of a shard is the data of its rows (Results.h) with "shard": { "index", "count", "rows":
///           the names of all rows of the whole run, in its order }.
///   Merge   the data of one run: the same bytes, except for what was measured elsewhere or at another time, which is
///           what the shards say: the times of a row are those of its shard, "machine" lists all machines, "date" is
///           the last.
///   Fails   Unreadable, Corrupt with the file; InvalidArgument for shards that were measured differently, are missing
///           or are there twice. The message says what to do. Any bytes are safe.
///   Thread  any.
#pragma once

#include "base/Result.h"
#include "toolkit/program/Shard.h"
#include "tools/accuracy/Results.h"

#include <filesystem>

namespace filament_core::accuracy {

/// The rows of the run: `chosen`, or all of `table`. NotFound for a name that is none.
Result<std::vector<std::string>> rowsOf(std::vector<Effect> const& table, std::vector<std::string> const& chosen);

/// Every N-th of `rows` beginning with row I. InvalidArgument if there is none.
Result<std::vector<std::string>> rowsOf(tools::Shard const& shard, std::vector<std::string> const& rows);

/// `rows`: of the whole run.
Result<void> writeShard(Results const& results, tools::Shard const& shard, std::vector<std::string> const& rows,
                        std::filesystem::path const& out);

/// Files, or folders with a results.json, in any order.
Result<tools::Json> mergeShards(std::vector<std::filesystem::path> const& files);

} // namespace filament_core::accuracy
