// SPDX-License-Identifier: Apache-2.0
/// Report: the table on standard output, and everything as JSON.
///   Thread  main thread.
///   Fails   writeJson() says why the file could not be written.
#pragma once

#include "base/Result.h"
#include "bench/threading/Contention.h"
#include "bench/threading/Workload.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::bench {

using MachineDescription = std::vector<std::pair<std::string, std::string>>;

void printMachine(MachineDescription const& machine, Settings const& settings);
/// One row; a new header whenever the columns change.
class Table {
public:
    void print(Measured const& measured);
    void printSummary() const; ///< what was left out; targets met and missed

private:
    std::vector<std::string> mColumns;
    std::vector<std::string> mMissed;
    std::map<std::string, std::vector<std::string>> mLeftOut; // by contender and reason: workloads
    int mTargets = 0;
};

Result<void> writeJson(std::filesystem::path const& path, MachineDescription const& machine, Settings const& settings,
                       std::span<const Measured> results);
Result<void> writeJson(std::filesystem::path const& path, MachineDescription const& machine,
                       std::span<const ContentionRow> rows);

} // namespace filament_core::bench
