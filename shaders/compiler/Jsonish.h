// SPDX-License-Identifier: Apache-2.0
/// The text of a .mat file as values and blocks (materials guide, 4.1): JSON with optional quotes, comments and
/// trailing commas, and blocks of raw GLSL.
///   In      any text. `#include "path"` inside the material block continues with the text of that file.
///   Out     one tree for the material block; the texts of the vertex and fragment blocks with their first line.
///   Thread  any. Memory: a few times the text.
///   Limits  values nest 32 deep, includes 8 deep; 1 MiB of text in all.
///   Fails   InvalidArgument, "file:line: reason". Never crashes, whatever the bytes.
#pragma once

#include "base/Result.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::shader {

/// The text behind a path of an #include; nothing if there is no such file.
using IncludeResolver = std::function<std::optional<std::string>(std::string_view path)>;

/// Where something stands in the user's files.
struct SourcePosition {
    std::shared_ptr<const std::string> file;
    uint32_t line = 0; ///< from 1
};

/// "file:line: message" as an Error.
Error errorAt(SourcePosition const& at, std::string const& message, ErrorCode code = ErrorCode::InvalidArgument);

struct JsonMember;

struct JsonValue {
    enum class Kind : uint8_t { Bool, Number, String, Array, Object };
    Kind kind = Kind::String;
    SourcePosition at;
    std::string text;  ///< as written, without quotes; of scalars
    double number = 0; ///< of Number
    bool boolean = false;
    std::vector<JsonValue> items;    ///< of Array
    std::vector<JsonMember> members; ///< of Object, in the order of the file
};

struct JsonMember {
    std::string name;
    JsonValue value;
};

/// What the kind is called in error messages: "a string", "an array", ...
const char* toString(JsonValue::Kind kind);

struct GlslBlock {
    std::string text;      ///< without the outer braces
    SourcePosition at;     ///< of its first line
    std::string defines{}; ///< whole lines in front of it, from the command line
};

struct MaterialText {
    JsonValue material; ///< an Object
    std::optional<GlslBlock> vertex, fragment;
};

Result<MaterialText> parseMaterialText(std::string_view text, std::string_view fileName,
                                       IncludeResolver const& includes);

} // namespace filament_core::shader
