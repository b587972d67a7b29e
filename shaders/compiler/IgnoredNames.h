// SPDX-License-Identifier: Apache-2.0
/// IgnoredNames: properties and fields that other compilers of the language know and this engine does without. A
/// material that has them is compiled, with a warning that says what they would have done.
///   Thread  any.
#pragma once

#include "shaders/compiler/Jsonish.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::shader {

struct IgnoredName {
    std::string_view of; ///< "property", or what has the field: "parameter", "constant"
    std::string_view name;
    std::optional<JsonValue::Kind> kind; ///< of its value; nothing: any
    std::string_view asItIs;             ///< the value that asks for what the engine does anyway; empty: none does
    std::string_view reason;             ///< why it has no effect, one line of Markdown
};

std::span<const IgnoredName> ignoredNames();

/// Whether the engine does without it: then `warnings` gets a line, unless the value is IgnoredName::asItIs.
///   Fails: InvalidArgument, if its value is of another kind.
Result<bool> ignores(std::string_view of, std::string_view name, JsonValue const& value,
                     std::vector<std::string>& warnings);

/// Why there is no such property although other compilers have it, and what to write instead; empty: they have none.
std::string_view reasonAgainst(std::string_view property);

} // namespace filament_core::shader
