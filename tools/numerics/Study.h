// SPDX-License-Identifier: Apache-2.0
/// runStudy: measures every row in every precision that this machine supports.
///   Out     one measurement per row and column; empty if the row does not support 16 bits, or if no device of that API
///           is installed, which `missing` reports.
///   Thread  the calling one; opens one device of each API. Memory: about 200 MB while it runs.
///   Fails   errors of a compiler or a device. Cost: seconds with a warm shader cache.
#pragma once

#include "base/Result.h"
#include "tools/numerics/table/Measure.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::shader::numerics {

struct RowResult {
    Row const* row = nullptr;
    std::array<std::optional<Measurement>, kColumns.size()> columns; ///< by Column
    /// By Format: number of results in range for which Vulkan and OpenGL ES differ in some bit. None in fp32.
    std::array<uint32_t, 2> differing{};

    std::optional<Measurement> const& of(Column column) const { return columns[static_cast<size_t>(column)]; }
};

struct Study {
    std::array<std::string, 2> devices; ///< Vulkan, OpenGL ES; empty: none
    std::vector<std::string> missing;   ///< why a device is missing
    bool promisesSameBits = false;      ///< in fp32: both are Mesa's CPU drivers
    std::vector<RowResult> rows;
};

/// A defect for the tests: replaces the first `from` by `to` in the text that the devices compile. C++ is not changed.
struct Mutation {
    std::string_view from, to;
};

/// Rows whose function or file contains `only`; all for "". Also fails if the mutation does not apply.
Result<Study> runStudy(std::string_view only = "", std::optional<Mutation> mutation = std::nullopt);

/// Whether the row is measured in this column.
bool isMeasured(Row const& row, Column column);

/// The promises of the row that a measurement breaks, one line each; empty if it keeps them all.
std::vector<std::string> violations(Row const& row, Column column, Measurement const& result);

} // namespace filament_core::shader::numerics
