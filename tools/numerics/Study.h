// SPDX-License-Identifier: Apache-2.0
/// runStudy: every row in every precision that this machine has.
///   Out     one measurement per row and column; an empty one where the row is not meant for 16 bits or where no device
///           of that API is installed, which `missing` says.
///   Thread  the one that calls; opens one device of each API. Memory: about 200 MB while it runs.
///   Fails   what a compiler or a device says. Cost: seconds with a warm shader cache.
#pragma once

#include "base/Result.h"
#include "tools/numerics/table/Measure.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace filament::shader::numerics {

struct RowResult {
    Row const* row = nullptr;
    std::array<std::optional<Measurement>, kColumns.size()> columns; ///< by Column
    /// By Format: results of inputs in range that Vulkan and OpenGL ES do not agree about to the bit. None in fp32.
    std::array<uint32_t, 2> differing{};

    std::optional<Measurement> const& of(Column column) const { return columns[static_cast<size_t>(column)]; }
};

struct Study {
    std::array<std::string, 2> devices; ///< Vulkan, OpenGL ES; empty: none
    std::vector<std::string> missing;   ///< why a device is not there
    bool promisesSameBits = false;      ///< in fp32: both are Mesa's CPU drivers
    std::vector<RowResult> rows;
};

/// A defect for the tests: the first `from` in the text that the devices compile becomes `to`. C++ is not changed.
struct Mutation {
    std::string_view from, to;
};

/// Rows whose function or file contains `only`; all for "". Fails also if the mutation finds nothing to change.
Result<Study> runStudy(std::string_view only = "", std::optional<Mutation> mutation = std::nullopt);

/// Whether the row has something to say in this column.
bool isMeasured(Row const& row, Column column);

/// What a measurement breaks of its row's promises, one line each; empty if it keeps them all.
std::vector<std::string> violations(Row const& row, Column column, Measurement const& result);

} // namespace filament::shader::numerics
