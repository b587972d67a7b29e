// SPDX-License-Identifier: Apache-2.0
/// Shard: a part of a run that several machines divide among them.
///   Fails   parseShard(): InvalidArgument in one line that names the option, the value and what is valid.
///   Thread  any; parseShard() reads the environment.
#pragma once

#include "base/Result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace filament_core::tools {

inline constexpr uint32_t kMaxShards = 100'000;

struct Shard {
    uint32_t index = 0, count = 1; ///< index < count <= kMaxShards
    friend bool operator==(Shard const&, Shard const&) = default;
};

/// "2/8", or "auto": SLURM_ARRAY_TASK_ID and ..._COUNT, or JOB_COMPLETION_INDEX and JOB_COMPLETIONS.
Result<Shard> parseShard(std::string const& word);

/// Checks that `shards` are all the shards of one division, each once. The error names those that are missing, the
/// first that is there twice, one that cannot be, or two numbers of shards that contradict each other.
Result<void> checkComplete(std::vector<Shard> shards);

} // namespace filament_core::tools
