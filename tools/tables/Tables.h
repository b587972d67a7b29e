// SPDX-License-Identifier: Apache-2.0
/// Tables: what the programs accept, as Markdown made from the tables that they themselves read. In a document a table
/// stands between <!-- begin: NAME --> and <!-- end: NAME -->, each on a line of its own.
///   Thread  any.
///   Fails   withTables(): InvalidArgument in one line that names the document, the line, and what is wrong there.
#pragma once

#include "base/Result.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core::tools {

using NamedTable = std::pair<std::string, std::string>; ///< name, text that ends with a line break

/// All of them: those of the material language (shaders/compiler/LanguageTables.h), choices of quality, effects,
/// grading, other choices of --set, debug views, glTF extensions.
std::vector<NamedTable> documentTables();

/// The document with its tables replaced. `name` is for errors.
Result<std::string> withTables(std::string_view document, std::vector<NamedTable> const& tables, std::string_view name);

} // namespace filament_core::tools
